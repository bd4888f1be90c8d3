#include "game/world.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/animation.h"
#include "game/draw_list.h"
#include "game/progress.h"
#include "game/settings/setting.h"
#include "game/stream_volumes.h"
#include "game/volumes.h"
#include "modules/ao/residency.h"
#include "modules/bake/medium_bake.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct nook_game_world {
    const nook_scene *scene;
    nook_ao *ao;         /* NULL until volumes are baked */
    nook_stream *stream; /* NULL: volumes stay */
    nook_world *entities;
    nook_entity *of_node; /* scene->node_count of them */
    nook_components components;
    nook_scene_pose *pose;        /* NULL when nothing is animated */
    uint32_t *deformable_of_mesh; /* NOOK_NONE for most; with a pose */
    nook_live_volumes live;       /* of deformables, once volumes are baked */
    nook_live_scene live_scene;   /* of all that is rigid, instead of what was baked */
    bool traced;                  /* the reference sees their poses */
    nook_draw *draws;
    nook_ao_occluder *occluders;
    nook_world_volume *volumes;
    uint32_t volume_count;
    uint32_t kinds;         /* that the volumes are there in */
    nook_volumes_plan plan; /* that they were baked by */
};

static void show_bake(void *user, const nook_scene_volume *done, uint32_t index, uint32_t count)
{
    (void)done;
    nook_progress_update(user, (index + 1.0) / count);
}

/* Parts of a room that share no volume would darken less then than they do. */
bool nook_game_world_multiplies(const nook_ao *ao)
{
    double combine, path;
    return nook_ao_get_param(ao, "volume.combine", &combine) != NOOK_OK ||
           nook_ao_get_param(ao, "volume.path", &path) != NOOK_OK || nook_setting_values_multiply(combine, path);
}

static nook_result bake(const nook_game_world *world, const nook_game_world_desc *desc, uint32_t kinds,
                        const nook_volumes_plan *plan, nook_scene_volumes *out_volumes)
{
    nook_progress progress = nook_progress_begin("baking volumes");
    const nook_volumes_desc volumes = { .resolution = desc->resolution,
                                        .r_max = desc->r_max,
                                        .cache_dir = desc->cache,
                                        .kinds = kinds,
                                        .plan = *plan,
                                        .streams = world->stream != NULL,
                                        .progress = show_bake,
                                        .user = &progress };
    nook_result result = nook_volumes_bake(world->scene, &volumes, out_volumes);
    nook_progress_end(&progress);
    return result;
}

static void describe_bake(const nook_bake *bake, nook_world_volume *out)
{
    const nook_volume_info *info = &bake->info;
    out->bakes[info->kind] = (nook_world_bake){ true, bake->cache_hit, nook_volume_gpu_bytes(info), bake->ms };
    if (out->width > 0)
        return;
    out->width = info->width;
    out->height = info->height;
    out->depth = info->depth;
    out->voxel_size = info->voxel_size;
}

nook_world_bake nook_world_volume_sum(const nook_world_volume *volume, uint32_t kinds)
{
    nook_world_bake sum = { .cached = true };
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        const nook_world_bake *bake = &volume->bakes[kind];
        if (!(kinds & NOOK_VOLUME_BIT(kind)) || !bake->there)
            continue;
        sum.there = true;
        sum.cached = sum.cached && bake->cached;
        sum.bytes += bake->bytes;
        sum.ms += bake->ms;
    }
    return sum;
}

/* Uploads the kinds that a volume was baked in, or says where they are. */
static nook_result extend(nook_game_world *world, const nook_scene_volume *baked, nook_world_volume *volume)
{
    nook_result result = NOOK_OK;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && result == NOOK_OK; kind++) {
        const nook_bake *bake = &baked->bakes[kind];
        if (!bake->bytes || volume->bakes[kind].there)
            continue;
        result = volume->streamed && nook_volume_can_stream(baked)
                     ? nook_volume_stream(world->stream, baked, (nook_volume_kind)kind, &volume->occluder.volume)
                     : nook_ao_extend_volume(world->ao, volume->occluder.volume, baked->name, bake->bytes, bake->size);
        if (result == NOOK_OK)
            describe_bake(bake, volume);
    }
    return result;
}

/* Bakes a medium and uploads it, for those who march densities and for the reference. */
static nook_result upload_medium(nook_game_world *world, const nook_scene_volume *medium, nook_world_volume *volume)
{
    nook_bake bake = { .ms = 0.0 };
    nook_volume densities;
    if (!(nook_ao_volume_kinds(world->ao) & NOOK_VOLUME_BIT(NOOK_VOLUME_DENSITY)))
        nook_log_warning("%s: a density is seen by the reference, and by volume with volume.kind=density; not as "
                         "techniques are set now",
                         medium->name);
    double start = nook_clock_ms();
    nook_result result = nook_medium_bake(medium->medium, medium->resolution, 0, &densities);
    if (result != NOOK_OK)
        return result;
    bake.info = densities.info;
    result = nook_ao_reserve_volume(world->ao, &volume->occluder.volume);
    if (result == NOOK_OK)
        result = nook_ao_keep_volume(world->ao, volume->occluder.volume, &densities); /* no stream brings it again */
    nook_volume_free(&densities);
    bake.ms = nook_clock_ms() - start;
    if (result != NOOK_OK)
        return result;
    describe_bake(&bake, volume);
    return nook_ao_add_medium(world->ao, medium->medium, &volume->occluder.mesh);
}

/* Uploads a volume and its triangles. */
static nook_result upload(nook_game_world *world, const nook_scene_volume *baked, nook_world_volume *volume)
{
    nook_result result = NOOK_OK;
    if (baked->medium)
        return upload_medium(world, baked, volume);
    volume->streamed = world->stream && nook_volume_can_stream(baked);
    if (!volume->streamed)
        result = nook_ao_reserve_volume(world->ao, &volume->occluder.volume);
    if (result == NOOK_OK)
        result = extend(world, baked, volume);
    if (result != NOOK_OK)
        return result;
    const nook_alphas alphas = { baked->parts, baked->part_count, baked->uvs };
    return nook_ao_add_mesh_with_alphas(world->ao, baked->positions, baked->vertex_count + baked->blended_vertex_count,
                                        baked->indices, (uint32_t)nook_scene_volume_index_count(baked), &alphas,
                                        &volume->occluder.mesh);
}

static nook_result add_transform(nook_game_world *world, nook_entity entity, const nook_matrix *matrix)
{
    nook_transform transform;
    memcpy(transform.world_from_local, matrix->m, sizeof transform.world_from_local);
    return nook_entity_add(world->entities, entity, world->components.transform, &transform);
}

/* An entity that stands somewhere, with nothing to show for it yet. */
static nook_result make_body(nook_game_world *world, const nook_matrix *world_from_local, bool moving,
                             nook_entity *out_entity)
{
    const nook_components *ids = &world->components;
    const nook_component kinds[] = { ids->transform, ids->rigid_body };
    nook_result result = nook_entity_create(world->entities, kinds, NOOK_COUNT(kinds), 1, out_entity);
    if (result != NOOK_OK)
        return result;
    const nook_rigid_body body = { moving ? NOOK_MOTION_DYNAMIC : NOOK_MOTION_STATIC };
    result = nook_entity_add(world->entities, *out_entity, ids->rigid_body, &body);
    return result == NOOK_OK ? add_transform(world, *out_entity, world_from_local) : result;
}

/* One entity for each node with a mesh. */
static nook_result make_nodes(nook_game_world *world)
{
    for (uint32_t i = 0; i < world->scene->node_count; i++) {
        const nook_node *node = &world->scene->nodes[i];
        if (node->mesh == NOOK_NONE)
            continue;
        nook_result result =
            make_body(world, &node->world_from_local, node->moving || node->animated, &world->of_node[i]);
        const nook_renderable renderable = { node->mesh, i };
        if (result == NOOK_OK)
            result = nook_entity_add(world->entities, world->of_node[i], world->components.renderable, &renderable);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

static nook_result make_occluders(nook_game_world *world, const nook_scene_volumes *baked)
{
    for (uint32_t i = 0; i < baked->occluder_count; i++) {
        const nook_scene_occluder *occluder = &baked->occluders[i];
        nook_entity entity;
        nook_result result = NOOK_OK;
        if (occluder->node == NOOK_NONE)
            result = make_body(world, &occluder->world_from_mesh, false, &entity);
        else
            entity = world->of_node[occluder->node];
        nook_volume_occluder component = world->volumes[occluder->volume].occluder;
        if (occluder->left_out || world->live_scene.volume.id)
            component.volume = (nook_ao_volume){ 0 };
        if (result == NOOK_OK)
            result = nook_entity_add(world->entities, entity, world->components.volume_occluder, &component);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

/* Entities of deformables know their volume, and the triangles that the reference has of them. */
static nook_result tell_entities(nook_game_world *world)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < world->live.count && result == NOOK_OK; i++) {
        const nook_live_volume *volume = &world->live.items[i];
        uint32_t node = world->scene->deformables[volume->deformable].node;
        result = nook_entity_add(world->entities, world->of_node[node], world->components.volume_occluder,
                                 &volume->occluder);
    }
    return result;
}

static nook_result make_live_volumes(nook_game_world *world, double r_max)
{
    if (!world->pose)
        return NOOK_OK;
    nook_result result = nook_live_volumes_create(world->ao, world->pose, r_max, &world->live);
    return result == NOOK_OK ? tell_entities(world) : result;
}

/* An entity for what all rigid bodies are voxelised into. */
static nook_result make_live_scene(nook_game_world *world, uint32_t resolution)
{
    nook_entity entity;
    nook_result result = nook_live_scene_create(world->ao, world->scene, resolution, &world->live_scene);
    if (result == NOOK_OK)
        result = make_body(world, &world->live_scene.world_from_volume, false, &entity);
    const nook_volume_occluder component = { .volume = world->live_scene.volume };
    return result == NOOK_OK ? nook_entity_add(world->entities, entity, world->components.volume_occluder, &component)
                             : result;
}

static nook_result fill(nook_game_world *world, nook_scene_volumes *baked, uint32_t live)
{
    uint32_t occluder_max = baked->occluder_count + world->scene->deformable_count + (live > 0);
    world->volumes = calloc(baked->volume_count + 1, sizeof *world->volumes);
    world->occluders = calloc(occluder_max + 1u, sizeof *world->occluders);
    if (!world->volumes || !world->occluders)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its volumes", world->scene->path);
    world->volume_count = baked->volume_count;
    world->kinds = live ? NOOK_WORLD_EVERY_KIND : baked->kinds; /* nothing is to be supplied */
    world->plan = baked->plan;
    nook_result result = live ? make_live_scene(world, live) : NOOK_OK;
    for (uint32_t i = 0; i < baked->volume_count && result == NOOK_OK; i++) {
        nook_world_volume *volume = &world->volumes[i];
        snprintf(volume->name, sizeof volume->name, "%s", baked->volumes[i].name);
        volume->instances = baked->volumes[i].instances;
        result = upload(world, &baked->volumes[i], volume);
        nook_scene_volume_release(&baked->volumes[i]); /* the AO has its own copy; two of all are much memory */
    }
    if (result == NOOK_OK)
        result = make_occluders(world, baked);
    if (result == NOOK_OK)
        result = make_live_volumes(world, baked->r_max);
    if (result == NOOK_OK)
        result = nook_occluders_set_up(world->entities, world->occluders, occluder_max);
    return result;
}

/* Clips run from here on, if there are any. */
static nook_result set_up_animation(nook_game_world *world)
{
    const nook_scene *scene = world->scene;
    if (!scene->rest || (scene->clip_count == 0 && scene->deformable_count == 0))
        return NOOK_OK;
    nook_result result = nook_scene_pose_create(scene, &world->pose);
    if (result != NOOK_OK)
        return result;
    world->deformable_of_mesh = malloc((scene->mesh_count + (size_t)1) * sizeof *world->deformable_of_mesh);
    if (!world->deformable_of_mesh)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for what it deforms", scene->path);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        world->deformable_of_mesh[i] = NOOK_NONE;
    for (uint32_t i = 0; i < scene->deformable_count; i++)
        world->deformable_of_mesh[scene->deformables[i].mesh] = i;
    return nook_animations_set_up(world->entities, world->pose);
}

/* The ECS world with its components, and what is drawn of it. */
static nook_result set_up(nook_game_world *world)
{
    uint32_t count = world->scene->node_count;
    nook_result result = nook_world_create(NULL, &world->entities);
    if (result != NOOK_OK)
        return result;
    world->draws = calloc(count + 1, sizeof *world->draws);
    world->of_node = calloc(count + 1, sizeof *world->of_node);
    if (!world->draws || !world->of_node)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its entities", world->scene->path);
    result = nook_components_register(world->entities, &world->components);
    if (result == NOOK_OK)
        result = set_up_animation(world);
    if (result == NOOK_OK)
        result = nook_draw_list_set_up(world->entities, world->draws, count);
    return result == NOOK_OK ? make_nodes(world) : result;
}

nook_result nook_game_world_create(const nook_scene *scene, nook_game_world **out_world)
{
    *out_world = NULL;
    nook_game_world *world = calloc(1, sizeof *world);
    if (!world)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its world", scene->path);
    world->scene = scene;
    nook_result result = set_up(world);
    if (result != NOOK_OK) {
        nook_game_world_destroy(world);
        return result;
    }
    *out_world = world;
    return NOOK_OK;
}

void nook_game_world_set_stream(nook_game_world *world, nook_stream *stream)
{
    world->stream = stream;
}

nook_result nook_game_world_bake(nook_game_world *world, nook_ao *ao, const nook_game_world_desc *desc,
                                 const nook_volumes_plan *plan)
{
    nook_scene_volumes baked = { 0 };
    const nook_volumes_plan nothing = { .moves = false };
    nook_result result = bake(world, desc, nook_ao_volume_kinds(ao), plan ? plan : &nothing, &baked);
    return result == NOOK_OK ? nook_game_world_take_volumes(world, ao, &baked, 0) : result;
}

nook_result nook_game_world_take_volumes(nook_game_world *world, nook_ao *ao, nook_scene_volumes *baked, uint32_t live)
{
    assert(!world->ao);
    world->ao = ao;
    nook_result result = fill(world, baked, live);
    nook_volumes_free(baked);
    return result;
}

nook_result nook_game_world_supply(nook_game_world *world, uint32_t kinds, const nook_game_world_desc *desc)
{
    nook_scene_volumes baked = { 0 };
    uint32_t missing = kinds & ~world->kinds;
    if (!missing)
        return NOOK_OK;
    nook_result result = bake(world, desc, missing, &world->plan, &baked);
    assert(result != NOOK_OK || baked.volume_count == world->volume_count); /* of the same scene */
    for (uint32_t i = 0; i < baked.volume_count && result == NOOK_OK; i++)
        result = extend(world, &baked.volumes[i], &world->volumes[i]);
    if (result == NOOK_OK)
        world->kinds |= missing;
    nook_volumes_free(&baked);
    return result;
}

uint32_t nook_game_world_kinds(const nook_game_world *world)
{
    return world->kinds;
}

void nook_game_world_destroy(nook_game_world *world)
{
    if (!world)
        return;
    for (uint32_t i = 0; i < world->volume_count; i++) { /* those that were not reached have no ids */
        if (world->volumes[i].streamed)
            nook_stream_remove(world->stream, world->volumes[i].occluder.volume);
        else
            nook_ao_remove_volume(world->ao, world->volumes[i].occluder.volume);
        nook_ao_remove_mesh(world->ao, world->volumes[i].occluder.mesh);
    }
    nook_world_destroy(world->entities);
    nook_live_volumes_destroy(world->ao, &world->live);
    nook_live_scene_destroy(world->ao, &world->live_scene);
    nook_scene_pose_destroy(world->pose);
    free(world->deformable_of_mesh);
    free(world->of_node);
    free(world->draws);
    free(world->occluders);
    free(world->volumes);
    free(world);
}

nook_world *nook_game_world_entities(nook_game_world *world)
{
    return world->entities;
}

const nook_components *nook_game_world_components(const nook_game_world *world)
{
    return &world->components;
}

nook_entity nook_game_world_entity_of_node(const nook_game_world *world, uint32_t node)
{
    assert(node < world->scene->node_count);
    return world->of_node[node];
}

nook_result nook_game_world_renew(nook_game_world *world)
{
    nook_result result = nook_draw_list_renew(world->entities);
    if (result == NOOK_OK && world->pose)
        result = nook_animations_renew(world->entities);
    if (result == NOOK_OK && world->ao)
        result = nook_occluders_renew(world->entities);
    return result;
}

/* Draws of deformables are told their pose, and the box that follows from it. */
static void pose_draws(nook_game_world *world)
{
    size_t count;
    const nook_animated_scene *animated = nook_animations_of(world->entities);
    nook_game_world_draws(world, &count);
    for (size_t i = 0; i < count; i++) {
        nook_draw *draw = &world->draws[i];
        uint32_t deformable = world->deformable_of_mesh[draw->mesh];
        if (deformable == NOOK_NONE)
            continue;
        draw->pose_version = animated->version;
        draw->box = world->pose->meshes[deformable].box;
    }
}

/* New triangles have new ids: components learn them, and so do the occluders that were collected with the old ones. */
static nook_result trace_poses(nook_game_world *world)
{
    uint32_t version;
    const nook_type type = NOOK_TYPE(nook_occluder_list);
    nook_occluder_list *list = nook_world_resource(world->entities, &type);
    nook_game_world_poses(world, &version);
    nook_result result = nook_live_volumes_trace(&world->live, world->ao, world->pose, version);
    if (result == NOOK_OK)
        result = tell_entities(world);
    for (uint32_t i = 0; i < world->live.count && result == NOOK_OK; i++)
        for (uint32_t k = 0; k < list->count; k++)
            if (list->items[k].volume.id == world->live.items[i].occluder.volume.id)
                list->items[k].mesh = world->live.items[i].occluder.mesh;
    return result;
}

void nook_game_world_set_traced(nook_game_world *world, bool traced)
{
    world->traced = traced;
}

nook_result nook_game_world_voxelize(nook_game_world *world, nook_render_scene *scene, const nook_camera *camera,
                                     double aspect)
{
    uint32_t version;
    size_t draw_count;
    const nook_mesh_pose *poses = nook_game_world_poses(world, &version);
    const nook_draw *draws = nook_game_world_draws(world, &draw_count);
    nook_result result = NOOK_OK;
    if (world->live_scene.volume.id)
        result = nook_live_scene_voxelize(&world->live_scene, world->ao, scene, draws, draw_count);
    if (result != NOOK_OK || world->live.count == 0 || !poses)
        return result;
    nook_render_scene_pose(scene, poses, version);
    return nook_live_volumes_voxelize(&world->live, world->ao, world->pose, version, scene, camera, aspect);
}

const nook_live_scene *nook_game_world_live_scene(const nook_game_world *world)
{
    return &world->live_scene;
}

const nook_live_volumes *nook_game_world_live_volumes(const nook_game_world *world)
{
    return &world->live;
}

void nook_game_world_advance(nook_game_world *world, double seconds)
{
    if (world->pose)
        nook_animations_of(world->entities)->step += seconds;
}

const nook_mesh_pose *nook_game_world_poses(const nook_game_world *world, uint32_t *out_version)
{
    *out_version = world->pose ? nook_animations_of(world->entities)->version : 0;
    return world->pose ? world->pose->meshes : NULL;
}

nook_result nook_game_world_update(nook_game_world *world, nook_ao *ao)
{
    nook_result result = nook_world_run_phase(world->entities, NOOK_PHASE_UPDATE);
    if (result == NOOK_OK)
        result = nook_world_run_phase(world->entities, NOOK_PHASE_PRE_RENDER);
    if (result == NOOK_OK && world->traced && world->live.count > 0)
        result = trace_poses(world);
    if (result != NOOK_OK)
        return result;
    if (world->pose)
        pose_draws(world);
    const nook_type type = NOOK_TYPE(nook_occluder_list);
    const nook_occluder_list *list = nook_world_resource(world->entities, &type);
    if (!list)
        return nook_ao_submit_occluders(ao, NULL, 0); /* nothing was baked */
    if (list->dropped > 0)
        return nook_fail(NOOK_E_MEMORY, "%u bodies more than the %u that the scene came with: no room for them",
                         list->dropped, list->capacity);
    return nook_ao_submit_occluders(ao, list->items, list->count);
}

const nook_draw *nook_game_world_draws(const nook_game_world *world, size_t *out_count)
{
    const nook_type type = NOOK_TYPE(nook_draw_list);
    const nook_draw_list *list = nook_world_resource(world->entities, &type);
    *out_count = list->count;
    return list->items;
}

const nook_ao_occluder *nook_game_world_occluders(const nook_game_world *world, uint32_t *out_count)
{
    const nook_type type = NOOK_TYPE(nook_occluder_list);
    const nook_occluder_list *list = nook_world_resource(world->entities, &type);
    *out_count = list ? list->count : 0;
    return list ? list->items : NULL;
}

const nook_world_volume *nook_game_world_volumes(const nook_game_world *world, uint32_t *out_count)
{
    *out_count = world->volume_count;
    return world->volumes;
}
