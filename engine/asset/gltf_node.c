/* The node tree, flattened with parents first. Iterative: chains of 100,000 nodes exist to break recursion. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/** A node that is still to be visited. */
typedef struct pending {
    uint32_t node, parent; /**< In the file; in the scene. */
} pending;

typedef struct traversal {
    nook_gltf *gltf;
    pending *stack;
    uint32_t stack_count;
    uint32_t *parents;    /**< Per node of the file, how many nodes name it as a child. */
    bool *visited;        /**< Per node of the file. */
    nook_matrix *worlds;  /**< Per node of the scene. */
    int *bodies;          /**< Per node of the scene: the nearest nook_body, -1 when there is none. */
    uint32_t *mesh_users; /**< Per mesh, how many nodes draw it. */
    uint32_t singular;
} traversal;

static nook_matrix local_matrix(nook_gltf *gltf, uint32_t index, nook_node_rest *rest)
{
    const nook_gltf_node *node = &gltf->model->nodes[index];
    if (node->has_matrix) {
        nook_matrix matrix;
        memcpy(matrix.m, node->matrix, sizeof matrix.m);
        if (matrix.m[3] != 0.0 || matrix.m[7] != 0.0 || matrix.m[11] != 0.0 || matrix.m[15] != 1.0)
            nook_scene_warn(gltf->scene, "%s: nodes[%u].matrix has a bottom row other than 0 0 0 1; ignored",
                            gltf->path, index);
        matrix.m[3] = matrix.m[7] = matrix.m[11] = 0.0;
        matrix.m[15] = 1.0;
        *rest = (nook_node_rest){ .is_matrix = true, .parent_from_local = matrix };
        return matrix;
    }
    const double *q = node->rotation;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double unit[4] = { 0.0, 0.0, 0.0, 1.0 };
    if (length > 0.0 && isfinite(length))
        for (int i = 0; i < 4; i++)
            unit[i] = q[i] / length;
    if (!(fabs(length - 1.0) < 0.01))
        nook_scene_warn(gltf->scene, "%s: nodes[%u].rotation has length %g; normalised", gltf->path, index, length);
    memcpy(rest->translation, node->translation, sizeof rest->translation);
    memcpy(rest->rotation, unit, sizeof rest->rotation);
    memcpy(rest->scale, node->scale, sizeof rest->scale);
    rest->parent_from_local = nook_matrix_compose(node->translation, unit, node->scale);
    return rest->parent_from_local;
}

static nook_result place_node(traversal *t, uint32_t index, uint32_t parent, uint32_t at)
{
    nook_gltf *gltf = t->gltf;
    const nook_gltf_node *from = &gltf->model->nodes[index];
    nook_matrix local = local_matrix(gltf, index, &gltf->scene->rest[at]);
    t->worlds[at] = parent == NOOK_NONE ? local : nook_matrix_multiply(&t->worlds[parent], &local);
    for (int i = 0; i < 16; i++)
        if (!isfinite(t->worlds[at].m[i]))
            return nook_fail(NOOK_E_FORMAT, "%s: the transform of nodes[%u] is not finite", gltf->path, index);
    t->bodies[at] = from->body >= 0 || parent == NOOK_NONE ? from->body : t->bodies[parent];
    return NOOK_OK;
}

static bool is_singular(const nook_matrix *matrix)
{
    nook_matrix inverse;
    return !nook_matrix_inverse_affine(matrix, &inverse);
}

/* A reference of a mesh that has no joints: the skin cannot apply. */
static void check_skin(nook_gltf *gltf, uint32_t index, const nook_gltf_node *node)
{
    const nook_gltf_mesh *mesh = &gltf->model->meshes[node->mesh];
    for (uint32_t p = 0; p < mesh->primitive_count; p++)
        if (gltf->model->primitives[mesh->first_primitive + p].joints == NOOK_GLTF_NONE) {
            nook_scene_warn(gltf->scene, "%s: nodes[%u] has a skin, its mesh has no JOINTS_0", gltf->path, index);
            return;
        }
}

static nook_result convert_node(traversal *t, uint32_t index, uint32_t parent)
{
    nook_scene *scene = t->gltf->scene;
    const nook_gltf_node *from = &t->gltf->model->nodes[index];
    uint32_t at = scene->node_count;
    nook_result result = place_node(t, index, parent, at);
    if (result != NOOK_OK)
        return result;
    nook_node *to = &scene->nodes[at];
    *to = (nook_node){ .parent = parent,
                       .mesh = from->mesh,
                       .camera = NOOK_NONE,
                       .light = NOOK_NONE,
                       .skin = from->mesh == NOOK_GLTF_NONE ? NOOK_NONE : from->skin,
                       .world_from_local = t->worlds[at],
                       .mass = from->mass > 0.0 && isfinite(from->mass) ? from->mass : 0.0,
                       .hung = from->hung };
    to->name = nook_scene_copy_string(from->name);
    if (!to->name)
        return NOOK_E_MEMORY;
    t->gltf->scene_nodes[index] = at;
    t->gltf->file_nodes[at] = index;
    scene->node_count++;
    if (to->skin != NOOK_NONE) {
        to->world_from_local = nook_matrix_identity();
        check_skin(t->gltf, index, from);
    }
    if (to->mesh != NOOK_NONE) {
        t->mesh_users[to->mesh]++;
        t->singular += is_singular(&to->world_from_local);
    }
    return nook_gltf_attach(t->gltf, from, &t->worlds[at], to);
}

static nook_result push_children(traversal *t, uint32_t first, uint32_t count, uint32_t parent)
{
    /* Backwards, so that they are visited in the file's order. */
    for (uint32_t i = count; i-- > 0;) {
        uint32_t node = t->gltf->model->children[first + i];
        if (t->visited[node])
            return nook_fail(NOOK_E_FORMAT, "%s: nodes[%u] is reached twice: its hierarchy is not a tree",
                             t->gltf->path, node);
        t->visited[node] = true;
        t->stack[t->stack_count++] = (pending){ node, parent };
    }
    return NOOK_OK;
}

static nook_result push_roots(traversal *t)
{
    const nook_gltf_model *model = t->gltf->model;
    if (model->scene_count > 0) {
        const nook_gltf_scene *scene =
            &model->scenes[model->default_scene == NOOK_GLTF_NONE ? 0 : model->default_scene];
        return push_children(t, scene->first_root, scene->root_count, NOOK_NONE);
    }
    for (uint32_t i = model->node_count; i-- > 0;)
        if (t->parents[i] == 0) {
            t->visited[i] = true;
            t->stack[t->stack_count++] = (pending){ i, NOOK_NONE };
        }
    return NOOK_OK;
}

/* With at most one parent each, nodes form trees and rings, and no walk is longer than their number. */
static nook_result count_parents(traversal *t)
{
    const nook_gltf_model *model = t->gltf->model;
    for (uint32_t i = 0; i < model->node_count; i++)
        for (uint32_t c = 0; c < model->nodes[i].child_count; c++) {
            uint32_t child = model->children[model->nodes[i].first_child + c];
            if (++t->parents[child] > 1)
                return nook_fail(NOOK_E_FORMAT, "%s: nodes[%u] has two parents: the hierarchy is not a tree",
                                 t->gltf->path, child);
        }
    return NOOK_OK;
}

static nook_result walk(traversal *t)
{
    nook_result result = count_parents(t);
    if (result == NOOK_OK)
        result = push_roots(t);
    while (result == NOOK_OK && t->stack_count > 0) {
        pending next = t->stack[--t->stack_count];
        const nook_gltf_node *from = &t->gltf->model->nodes[next.node];
        uint32_t at = t->gltf->scene->node_count;
        result = convert_node(t, next.node, next.parent);
        if (result == NOOK_OK)
            result = push_children(t, from->first_child, from->child_count, at);
    }
    return result;
}

static void choose_bodies(traversal *t)
{
    nook_scene *scene = t->gltf->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        nook_node *node = &scene->nodes[i];
        bool shared = node->mesh != NOOK_NONE && t->mesh_users[node->mesh] > 1;
        node->moving = t->bodies[i] >= 0 ? t->bodies[i] == 1 : shared;
    }
    if (t->singular)
        nook_scene_warn(scene, "%s: %u nodes draw with a scale of zero: what they draw is flat", t->gltf->path,
                        t->singular);
}

static void free_traversal(traversal *t)
{
    void *arrays[] = { t->stack, t->parents, t->visited, t->worlds, t->bodies, t->mesh_users };
    for (size_t i = 0; i < NOOK_COUNT(arrays); i++)
        free(arrays[i]);
}

static size_t count_with(const nook_gltf *gltf, bool camera)
{
    size_t count = 0;
    for (uint32_t i = 0; i < gltf->model->node_count; i++)
        count += (camera ? gltf->model->nodes[i].camera : gltf->model->nodes[i].light) != NOOK_GLTF_NONE;
    return count;
}

nook_result nook_gltf_convert_nodes(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    size_t count = gltf->model->node_count;
    traversal t = { .gltf = gltf };
    scene->file_node_count = gltf->model->node_count;
    scene->nodes = nook_scene_allocate(gltf->path, count, sizeof *scene->nodes);
    scene->cameras = nook_scene_allocate(gltf->path, count_with(gltf, true), sizeof *scene->cameras);
    scene->lights = nook_scene_allocate(gltf->path, count_with(gltf, false), sizeof *scene->lights);
    t.stack = nook_scene_allocate(gltf->path, count, sizeof *t.stack);
    t.parents = nook_scene_allocate(gltf->path, count, sizeof *t.parents);
    t.visited = nook_scene_allocate(gltf->path, count, sizeof *t.visited);
    t.worlds = nook_scene_allocate(gltf->path, count, sizeof *t.worlds);
    t.bodies = nook_scene_allocate(gltf->path, count, sizeof *t.bodies);
    t.mesh_users = nook_scene_allocate(gltf->path, gltf->model->mesh_count, sizeof *t.mesh_users);
    scene->rest = nook_scene_allocate(gltf->path, count, sizeof *scene->rest);
    gltf->scene_nodes = nook_scene_allocate(gltf->path, count, sizeof *gltf->scene_nodes);
    gltf->file_nodes = nook_scene_allocate(gltf->path, count, sizeof *gltf->file_nodes);
    for (size_t i = 0; gltf->scene_nodes && i < count; i++)
        gltf->scene_nodes[i] = NOOK_NONE;
    bool ready = scene->rest && gltf->scene_nodes && gltf->file_nodes && scene->nodes && scene->cameras &&
                 scene->lights && t.stack && t.parents && t.visited && t.worlds && t.bodies && t.mesh_users;
    nook_result result = ready ? walk(&t) : NOOK_E_MEMORY;
    if (result == NOOK_OK)
        choose_bodies(&t);
    free_traversal(&t);
    return result;
}
