/* The bodies of a session: their shapes, masses, and where they begin. */
#include "engine/core/log.h"
#include "engine/core/rotation.h"
#include "game/level/body.h"
#include "game/level/shape_fit.h"
#include "game/play/session_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Shapes ------------------------------------------------------------------------------------------------------ */

/* Triangles of a node in the space of its body. */
typedef struct triangles {
    float *positions;
    uint32_t *indices;
} triangles;

static void free_triangles(triangles *t)
{
    free(t->positions);
    free(t->indices);
}

static void count_mesh(const nook_scene *scene, const nook_mesh *mesh, nook_shape *out)
{
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        out->vertex_count += scene->primitives[mesh->first_primitive + p].vertex_count;
        out->index_count += scene->primitives[mesh->first_primitive + p].index_count;
    }
}

static void copy_primitive(const nook_scene *scene, const nook_primitive *primitive, const nook_matrix *body_from_node,
                           float *positions, uint32_t *indices, uint32_t first)
{
    for (uint32_t v = 0; v < primitive->vertex_count; v++) {
        const float *from = scene->vertices[primitive->first_vertex + v].position;
        double p[3] = { (double)from[0], (double)from[1], (double)from[2] };
        nook_matrix_apply_point(body_from_node, p, p);
        for (int k = 0; k < 3; k++)
            positions[3 * v + (uint32_t)k] = (float)p[k];
    }
    for (uint32_t i = 0; i < primitive->index_count; i++)
        indices[i] = scene->indices[primitive->first_index + i] + first;
}

static nook_result make_mesh_shape(const nook_scene *scene, const session_thing *thing, triangles *buffer,
                                   nook_shape *out)
{
    const nook_mesh *mesh = &scene->meshes[scene->nodes[thing->node].mesh];
    *out = (nook_shape){ .kind = NOOK_SHAPE_MESH, .body_from_shape = nook_pose_identity() };
    count_mesh(scene, mesh, out);
    buffer->positions = malloc(((size_t)out->vertex_count + 1) * 3 * sizeof(float));
    buffer->indices = malloc(((size_t)out->index_count + 1) * sizeof(uint32_t));
    if (!buffer->positions || !buffer->indices)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for the body of %s", scene->path,
                         scene->nodes[thing->node].name);
    uint32_t vertex = 0, index = 0;
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        copy_primitive(scene, primitive, &thing->body_from_node, buffer->positions + 3 * (size_t)vertex,
                       buffer->indices + index, vertex);
        vertex += primitive->vertex_count;
        index += primitive->index_count;
    }
    out->positions = buffer->positions;
    out->indices = buffer->indices;
    return NOOK_OK;
}

/* What stands still or is moved by rules collides by its triangles unless the level says otherwise. */
static nook_result make_shape(const nook_session *s, const session_thing *thing, triangles *buffer, nook_shape *out)
{
    const nook_level_entity *entity = session_entity_of(s, thing);
    nook_level_shape wanted = entity ? entity->shape : NOOK_LEVEL_SHAPE_AUTO;
    if (thing->motion != NOOK_BODY_DYNAMIC && wanted == NOOK_LEVEL_SHAPE_AUTO)
        wanted = NOOK_LEVEL_SHAPE_MESH;
    if (wanted == NOOK_LEVEL_SHAPE_MESH)
        return make_mesh_shape(s->desc.scene, thing, buffer, out);
    double rotation[4], scale[3];
    const nook_node *node = &s->desc.scene->nodes[thing->node];
    nook_rotation_from_matrix(&node->world_from_local, rotation, scale);
    nook_level_shape_fit(s->desc.scene, node->mesh, scale, wanted, out);
    return NOOK_OK;
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

static double mass_of(const nook_session *s, const session_thing *thing, const nook_body_defaults *defaults)
{
    const nook_level_entity *entity = session_entity_of(s, thing);
    const nook_node *node = &s->desc.scene->nodes[thing->node];
    if (entity && entity->mass > 0.0)
        return entity->mass;
    if (node->mass > 0.0)
        return node->mass;
    double volume = 8.0 * thing->half[0] * thing->half[1] * thing->half[2];
    return fmax(volume * (double)defaults->density, 1e-3);
}

/* Two numbers in [-1, 1] of a seed and a body (SplitMix64, Steele, Lea and Flood 2014). */
static void scatter(uint32_t seed, uint32_t index, double out[2])
{
    uint64_t state = ((uint64_t)seed << 32) + index;
    for (int i = 0; i < 2; i++) {
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        out[i] = (double)((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0;
    }
}

/* Where a try begins: a seed moves what lies loose by half a millimetre, so that no two go quite alike. */
static nook_pose first_pose(const nook_session *s, const session_thing *thing)
{
    const double most = 0.0005;
    nook_pose pose = thing->start;
    double by[2];
    if (thing->motion != NOOK_BODY_DYNAMIC)
        return pose;
    scatter(s->desc.seed, thing->node, by);
    pose.position[0] += most * by[0];
    pose.position[2] += most * by[1];
    return pose;
}

static nook_result make_body(nook_session *s, session_thing *thing, const nook_body_defaults *defaults)
{
    const nook_level_entity *entity = session_entity_of(s, thing);
    triangles buffer = { NULL, NULL };
    nook_shape shape;
    nook_result result = make_shape(s, thing, &buffer, &shape);
    const nook_body_desc desc = { .motion = thing->motion,
                                  .shapes = &shape,
                                  .shape_count = 1,
                                  .mass = mass_of(s, thing, defaults),
                                  .pose = first_pose(s, thing),
                                  .friction = entity ? entity->friction : (double)defaults->friction,
                                  .restitution = entity ? entity->restitution : (double)defaults->restitution,
                                  .ghost =
                                      !entity && s->desc.scene->nodes[thing->node].hung, /* it overlaps its bearing */
                                  .user = (uint64_t)(thing - s->things) + 1 };
    if (result == NOOK_OK)
        result = nook_physics_add(s->physics, &desc, &thing->body);
    free_triangles(&buffer);
    return result;
}

/* The entity of a node learns which body moves it. */
static nook_result tell_entity(const nook_session *s, const session_thing *thing)
{
    const nook_type type = NOOK_TYPE(nook_played);
    nook_world *world = nook_game_world_entities(s->desc.world);
    nook_component component;
    nook_result result = nook_world_component(world, &type, &component);
    const nook_played played = { thing->body, thing->entity };
    if (result == NOOK_OK)
        result = nook_entity_add(world, nook_game_world_entity_of_node(s->desc.world, thing->node), component, &played);
    return result;
}

static void note_touched(void *user, nook_body body)
{
    nook_body *self_and_other = user;
    if (body.id != self_and_other[0].id)
        self_and_other[1] = body;
}

static void grow(double low[3], double high[3], const double p[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = fmin(low[k], p[k]);
        high[k] = fmax(high[k], p[k]);
    }
}

/* Calls for every corner of what a thing draws, in the world. */
static void each_vertex(const nook_session *s, const session_thing *thing, const nook_pose *pose,
                        void (*visit)(void *user, const double at[3]), void *user)
{
    const nook_scene *scene = s->desc.scene;
    const nook_mesh *mesh = &scene->meshes[scene->nodes[thing->node].mesh];
    nook_matrix world_from_body = nook_pose_matrix(pose);
    nook_matrix m = nook_matrix_multiply(&world_from_body, &thing->body_from_node);
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + i];
        for (uint32_t v = 0; v < primitive->vertex_count; v++) {
            const float *from = scene->vertices[primitive->first_vertex + v].position;
            double p[3] = { (double)from[0], (double)from[1], (double)from[2] };
            nook_matrix_apply_point(&m, p, p);
            visit(user, p);
        }
    }
}

/* The bottom of a thing: how low it reaches, and the box around what is as low. */
typedef struct bottom {
    double lowest, thickness;
    double low[3], high[3];
} bottom;

static void find_lowest(void *user, const double at[3])
{
    bottom *b = user;
    b->lowest = fmin(b->lowest, at[1]);
}

static void find_extent(void *user, const double at[3])
{
    bottom *b = user;
    if (at[1] < b->lowest + b->thickness)
        grow(b->low, b->high, at);
}

/* Whether something is right below a body: a file that says it lies there is believed, and what hangs in the air falls. */
static bool is_carried(nook_session *s, const session_thing *thing)
{
    const double gap = 0.004, around = 0.002;
    nook_pose pose = nook_physics_pose(s->physics, thing->body, 1.0);
    bottom b = { .lowest = INFINITY,
                 .thickness = gap,
                 .low = { INFINITY, INFINITY, INFINITY },
                 .high = { -INFINITY, -INFINITY, -INFINITY } };
    each_vertex(s, thing, &pose, find_lowest, &b);
    each_vertex(s, thing, &pose, find_extent, &b);
    b.low[1] = b.lowest - gap;
    b.high[1] = b.lowest;
    for (int k = 0; k < 3; k++) {
        b.low[k] -= around;
        b.high[k] += around;
    }
    nook_body self_and_other[2] = { thing->body, { 0 } };
    nook_physics_overlap(s->physics, b.low, b.high, note_touched, self_and_other);
    return self_and_other[1].id != 0;
}

nook_result session_make_bodies(nook_session *s)
{
    const nook_body_defaults defaults = nook_body_defaults_initial();
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < s->thing_count && result == NOOK_OK; i++) {
        result = make_body(s, &s->things[i], &defaults);
        if (result == NOOK_OK)
            result = tell_entity(s, &s->things[i]);
    }
    for (uint32_t i = 0; i < s->thing_count && result == NOOK_OK; i++) {
        if (s->things[i].motion == NOOK_BODY_DYNAMIC && is_carried(s, &s->things[i]))
            nook_physics_sleep(s->physics, s->things[i].body);
    }
    return result;
}
