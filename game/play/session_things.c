/* The nodes that have bodies. */
#include "engine/core/log.h"
#include "engine/core/rotation.h"
#include "game/play/session_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- What has a body --------------------------------------------------------------------------------------------- */

const nook_level_entity *session_entity_of(const nook_session *s, const session_thing *thing)
{
    return thing->entity == NOOK_NONE ? NULL : &s->desc.level->entities[thing->entity];
}

/* The entity that says what a node is: those of libraries gave it their name, the others are found by theirs. */
static uint32_t entity_of_node(const nook_level *level, const char *name)
{
    const nook_level_entity *found = nook_level_find(level, name);
    if (!found || found->kind == NOOK_LEVEL_GOAL || (!strchr(found->node, ':') && strcmp(found->node, name) != 0))
        found = nook_level_find_node(level, name);
    return found ? (uint32_t)(found - level->entities) : NOOK_NONE;
}

static nook_body_motion motion_of(const nook_node *node, const nook_level_entity *entity)
{
    if (!entity) /* what hangs on another would need a joint to fall with; it stays where it hangs */
        return node->moving && !node->hung && !node->animated ? NOOK_BODY_DYNAMIC : NOOK_BODY_STATIC;
    if (entity->kind == NOOK_LEVEL_BODY)
        return NOOK_BODY_DYNAMIC;
    return entity->kind == NOOK_LEVEL_MOVER || entity->kind == NOOK_LEVEL_SPINNER ? NOOK_BODY_KINEMATIC
                                                                                  : NOOK_BODY_STATIC;
}

/* Parts a node's transform into a pose and what is left of it. @return false: it is flat and has no body */
static bool part_transform(const nook_node *node, session_thing *out, double out_scale[3])
{
    if (!nook_rotation_from_matrix(&node->world_from_local, out->start.rotation, out_scale))
        return false;
    memcpy(out->start.position, node->world_from_local.m + 12, sizeof out->start.position);
    nook_pose body_from_world = nook_pose_inverse(&out->start);
    nook_matrix matrix = nook_pose_matrix(&body_from_world);
    out->body_from_node = nook_matrix_multiply(&matrix, &node->world_from_local);
    return true;
}

static void find_box(const nook_mesh *mesh, const double scale[3], session_thing *out)
{
    for (int k = 0; k < 3; k++) {
        double low = (double)mesh->bounds_min[k] * scale[k], high = (double)mesh->bounds_max[k] * scale[k];
        out->middle[k] = 0.5 * (low + high);
        out->half[k] = 0.5 * fabs(high - low);
    }
}

static const nook_vertex *vertex_of(const nook_scene *scene, const nook_primitive *primitive, uint32_t index)
{
    return &scene->vertices[primitive->first_vertex + scene->indices[primitive->first_index + index]];
}

/* Whether a mesh has a triangle that something can touch. */
static bool has_surface(const nook_scene *scene, const nook_mesh *mesh)
{
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        for (uint32_t i = 0; i + 2 < primitive->index_count; i += 3) {
            const uint32_t corners[3] = { 0, 1, 2 };
            float positions[9];
            for (int k = 0; k < 3; k++)
                memcpy(positions + 3 * k, vertex_of(scene, primitive, i + (uint32_t)k)->position, 3 * sizeof(float));
            if (nook_physics_has_area(positions, corners))
                return true;
        }
    }
    return false;
}

/* @return false: it draws nothing, is flat, or the level wants it without a body */
static bool describe_node(const nook_session *s, uint32_t index, session_thing *out)
{
    const nook_scene *scene = s->desc.scene;
    const nook_node *node = &scene->nodes[index];
    double scale[3];
    *out = (session_thing){ .node = index, .entity = entity_of_node(s->desc.level, node->name) };
    const nook_level_entity *entity = session_entity_of(s, out);
    if (node->mesh == NOOK_NONE || (entity && entity->shape == NOOK_LEVEL_SHAPE_NONE))
        return false;
    const nook_mesh *mesh = &scene->meshes[node->mesh];
    if (!has_surface(scene, mesh) || !part_transform(node, out, scale))
        return false;
    out->motion = motion_of(node, entity);
    find_box(mesh, scale, out);
    return true;
}

nook_result session_make_things(nook_session *s)
{
    const nook_scene *scene = s->desc.scene;
    s->things = calloc(scene->node_count + 1, sizeof *s->things);
    if (!s->things)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its bodies", s->desc.level->path);
    for (uint32_t i = 0; i < scene->node_count; i++)
        s->thing_count += describe_node(s, i, &s->things[s->thing_count]);
    return NOOK_OK;
}

/* ---- Asking ------------------------------------------------------------------------------------------------------ */

uint32_t session_thing_of_body(const nook_session *s, nook_body body)
{
    uint64_t user = nook_physics_user(s->physics, body);
    return user > 0 && user <= s->thing_count ? (uint32_t)user - 1 : NOOK_NONE;
}

const char *session_thing_name(const nook_session *s, uint32_t thing)
{
    return thing == NOOK_NONE ? "" : s->desc.scene->nodes[s->things[thing].node].name;
}

void session_thing_middle(const nook_session *s, const session_thing *thing, double out[3])
{
    nook_pose pose = nook_physics_pose(s->physics, thing->body, 1.0);
    nook_pose_apply_point(&pose, thing->middle, out);
}

/* ---- Coming back ------------------------------------------------------------------------------------------------- */

bool session_is_outside(const nook_scene *scene, const double at[3])
{
    const double margin = 20.0;
    bool outside = false;
    for (int k = 0; k < 3; k++)
        outside = outside || at[k] < scene->bounds_min[k] - margin || at[k] > scene->bounds_max[k] + margin;
    return outside;
}

static void note_return(session_return *returned, const double at[3])
{
    returned->count++;
    memcpy(returned->left_at, at, sizeof returned->left_at);
}

static void return_player(nook_session *s)
{
    session_player *player = &s->player;
    nook_pose start = nook_pose_identity();
    if (!session_is_outside(s->desc.scene, player->feet))
        return;
    note_return(&player->returned, player->feet);
    memcpy(start.position, s->desc.level->start, sizeof start.position);
    nook_physics_set_pose(s->physics, player->body, &start);
    memcpy(player->feet, start.position, sizeof player->feet);
    memcpy(player->was_feet, start.position, sizeof player->was_feet);
}

void session_return_bodies(nook_session *s)
{
    for (uint32_t i = 0; i < s->thing_count; i++) {
        session_thing *thing = &s->things[i];
        if (thing->motion != NOOK_BODY_DYNAMIC || nook_physics_asleep(s->physics, thing->body))
            continue;
        nook_pose pose = nook_physics_pose(s->physics, thing->body, 1.0);
        if (!session_is_outside(s->desc.scene, pose.position))
            continue;
        if (s->carry.thing == i)
            session_carry_drop(s);
        note_return(&thing->returned, pose.position);
        nook_physics_set_pose(s->physics, thing->body, &thing->start);
    }
    return_player(s);
}
