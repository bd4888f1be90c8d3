#include "game/animation.h"
#include "engine/core/log.h"
#include "engine/ecs/system.h"
#include "engine/ecs/transform.h"
#include "game/components.h"
#include <stdlib.h>
#include <string.h>

/* ---- Systems ----------------------------------------------------------------------------------------------------- */

static void advance(const nook_rows *rows)
{
    nook_animation *animations = rows->columns[0];
    const nook_animated_scene *scene = rows->resources[0];
    for (uint32_t i = 0; i < rows->count; i++)
        animations[i].time += animations[i].speed * scene->step;
}

static void begin_pose(const nook_rows *rows)
{
    nook_animated_scene *scene = rows->resources[0];
    scene->changes = scene->step != 0.0 || scene->version == 0;
    scene->step = 0.0;
    if (!scene->changes)
        return;
    scene->version = scene->version == UINT32_MAX ? 1 : scene->version + 1;
    nook_scene_pose_rest(scene->pose);
}

static void apply_clips(const nook_rows *rows)
{
    const nook_animation *animations = rows->columns[0];
    const nook_animated_scene *scene = rows->resources[0];
    for (uint32_t i = 0; i < rows->count && scene->changes; i++) {
        const nook_animation *a = &animations[i];
        double duration = scene->pose->scene->clips[a->clip].duration;
        nook_scene_pose_apply(scene->pose, a->clip, nook_clip_time(duration, a->time, a->loop));
    }
}

static void finish_pose(const nook_rows *rows)
{
    const nook_animated_scene *scene = rows->resources[0];
    if (scene->changes)
        nook_scene_pose_finish(scene->pose);
}

static void place_nodes(const nook_rows *rows)
{
    const nook_renderable *renderables = rows->columns[0];
    nook_transform *transforms = rows->columns[1];
    const nook_animated_scene *scene = rows->resources[0];
    for (uint32_t i = 0; i < rows->count && scene->changes; i++) {
        uint32_t node = renderables[i].node;
        if (scene->pose->scene->nodes[node].animated)
            memcpy(transforms[i].world_from_local, scene->pose->world_from_local[node].m,
                   sizeof transforms[i].world_from_local);
    }
}

static const nook_system advance_system = {
    .name = "animation.advance",
    .phase = NOOK_PHASE_UPDATE,
    .writes = { NOOK_TYPE(nook_animation) },
    .resources_read = { NOOK_TYPE(nook_animated_scene) },
    .run = advance,
};

static const nook_system begin_pose_system = {
    .name = "animation.begin_pose",
    .phase = NOOK_PHASE_PRE_RENDER,
    .resources = { NOOK_TYPE(nook_animated_scene) },
    .run = begin_pose,
};

static const nook_system apply_clips_system = {
    .name = "animation.apply_clips",
    .phase = NOOK_PHASE_PRE_RENDER,
    .reads = { NOOK_TYPE(nook_animation) },
    .resources = { NOOK_TYPE(nook_animated_scene) },
    .run = apply_clips,
};

static const nook_system finish_pose_system = {
    .name = "animation.finish_pose",
    .phase = NOOK_PHASE_PRE_RENDER,
    .resources = { NOOK_TYPE(nook_animated_scene) },
    .run = finish_pose,
};

static const nook_system place_nodes_system = {
    .name = "animation.place_nodes",
    .phase = NOOK_PHASE_PRE_RENDER,
    .reads = { NOOK_TYPE(nook_renderable) },
    .writes = { NOOK_TYPE(nook_transform) },
    .resources_read = { NOOK_TYPE(nook_animated_scene) },
    .run = place_nodes,
};

/* In their order. */
static const nook_system *const systems[] = { &advance_system, &begin_pose_system, &apply_clips_system,
                                              &finish_pose_system, &place_nodes_system };

/* ---- Entities ---------------------------------------------------------------------------------------------------- */

static uint32_t root_of(const nook_scene *scene, uint32_t node)
{
    while (scene->nodes[node].parent != NOOK_NONE)
        node = scene->nodes[node].parent;
    return node;
}

/* The hierarchy that a clip moves: that of the first node that it names. */
static uint32_t root_of_clip(const nook_scene *scene, const nook_clip *clip)
{
    return root_of(scene, scene->tracks[clip->first_track].node);
}

static nook_result make_actors(nook_world *world, const nook_scene *scene, nook_component animation)
{
    bool *taken = calloc(scene->node_count + 1u, sizeof *taken);
    nook_result result = taken ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "%s: no memory for its clips", scene->path);
    for (uint32_t i = 0; i < scene->clip_count && result == NOOK_OK; i++) {
        const nook_animation plays = { .clip = i, .loop = true, .speed = 1.0 };
        nook_entity entity;
        if (scene->clips[i].track_count == 0 || taken[root_of_clip(scene, &scene->clips[i])])
            continue;
        taken[root_of_clip(scene, &scene->clips[i])] = true;
        result = nook_entity_create(world, &animation, 1, 1, &entity);
        if (result == NOOK_OK)
            result = nook_entity_add(world, entity, animation, &plays);
    }
    free(taken);
    return result;
}

nook_result nook_animations_set_up(nook_world *world, nook_scene_pose *pose)
{
    const nook_animated_scene scene = { .pose = pose };
    const nook_type type = NOOK_TYPE(nook_animated_scene);
    nook_component animation;
    nook_result result = nook_world_component(world, NOOK_TYPE_OF(nook_animation), &animation);
    if (result == NOOK_OK)
        result = nook_world_set_resource(world, &type, &scene);
    for (size_t i = 0; i < NOOK_COUNT(systems) && result == NOOK_OK; i++)
        result = nook_world_add_system(world, systems[i]);
    return result == NOOK_OK ? make_actors(world, pose->scene, animation) : result;
}

nook_result nook_animations_renew(nook_world *world)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < NOOK_COUNT(systems) && result == NOOK_OK; i++)
        result = nook_world_replace_system(world, systems[i]);
    return result;
}

nook_animated_scene *nook_animations_of(nook_world *world)
{
    const nook_type type = NOOK_TYPE(nook_animated_scene);
    return nook_world_resource(world, &type);
}
