/* Meshes that change their shape: one for each node that deforms one, with room for all that moves their vertices. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const nook_box empty_box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

/* ---- Which ------------------------------------------------------------------------------------------------------- */

static bool has_joints(const nook_gltf *gltf, const nook_mesh *mesh)
{
    for (uint32_t p = 0; p < mesh->primitive_count; p++)
        if (gltf->origins[mesh->first_primitive + p].primitive->joints != NOOK_GLTF_NONE)
            return true;
    return false;
}

static uint32_t target_count(const nook_gltf *gltf, const nook_mesh *mesh)
{
    return mesh->primitive_count > 0 ? gltf->origins[mesh->first_primitive].primitive->target_count : 0;
}

static bool deforms(const nook_gltf *gltf, const nook_node *node)
{
    if (node->mesh == NOOK_NONE)
        return false;
    const nook_mesh *mesh = &gltf->scene->meshes[node->mesh];
    return target_count(gltf, mesh) > 0 || (node->skin != NOOK_NONE && has_joints(gltf, mesh));
}

static nook_result check_targets(const nook_gltf *gltf)
{
    for (uint32_t m = 0; m < gltf->scene->mesh_count; m++) {
        const nook_mesh *mesh = &gltf->scene->meshes[m];
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            uint32_t count = gltf->origins[mesh->first_primitive + p].primitive->target_count;
            if (count != target_count(gltf, mesh))
                return nook_fail(NOOK_E_FORMAT, "%s: meshes[%u] has primitives of %u and of %u morph targets",
                                 gltf->path, m, target_count(gltf, mesh), count);
        }
    }
    return NOOK_OK;
}

/* ---- A mesh for each --------------------------------------------------------------------------------------------- */

static void find_vertices(const nook_scene *scene, const nook_mesh *mesh, uint32_t *out_first, uint32_t *out_count)
{
    uint32_t first = UINT32_MAX, end = 0; /* primitives of a mesh follow one another, and may share their vertices */
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        first = primitive->first_vertex < first ? primitive->first_vertex : first;
        end = primitive->first_vertex + primitive->vertex_count > end
                  ? primitive->first_vertex + primitive->vertex_count
                  : end;
    }
    *out_first = first;
    *out_count = end - first;
}

static nook_result copy_primitives(nook_gltf *gltf, const nook_mesh *from, nook_mesh *to, uint32_t vertices_by)
{
    nook_scene *scene = gltf->scene;
    to->first_primitive = scene->primitive_count;
    for (uint32_t p = 0; p < from->primitive_count; p++) {
        const nook_gltf_origin *origin = &gltf->origins[from->first_primitive + p];
        nook_gltf_origin *copy = &gltf->origins[scene->primitive_count];
        nook_primitive *primitive = &scene->primitives[scene->primitive_count++];
        *primitive = scene->primitives[from->first_primitive + p];
        *copy = (nook_gltf_origin){ .primitive = origin->primitive };
        if (origin->source_vertices) {
            copy->source_vertices = nook_scene_allocate(gltf->path, primitive->vertex_count, sizeof(uint32_t));
            if (!copy->source_vertices)
                return NOOK_E_MEMORY;
            memcpy(copy->source_vertices, origin->source_vertices, primitive->vertex_count * sizeof(uint32_t));
        }
        primitive->first_vertex += vertices_by;
    }
    return NOOK_OK;
}

/* A copy with vertices of its own, for one node; there is room for it among meshes and primitives. */
static nook_result copy_mesh(nook_gltf *gltf, uint32_t mesh, uint32_t *out_mesh)
{
    nook_scene *scene = gltf->scene;
    const nook_mesh *from = &scene->meshes[mesh];
    nook_mesh *to = &scene->meshes[scene->mesh_count];
    uint32_t first, count;
    *to = *from;
    to->name = nook_scene_copy_string(from->name);
    if (!to->name)
        return NOOK_E_MEMORY;
    *out_mesh = scene->mesh_count++;
    find_vertices(scene, from, &first, &count);
    uint32_t vertices_by = (uint32_t)scene->vertex_count - first;
    nook_vertex *vertices = nook_gltf_add_vertices(gltf, count);
    if (!vertices)
        return NOOK_E_MEMORY;
    memcpy(vertices, scene->vertices + first, count * sizeof *vertices);
    return copy_primitives(gltf, from, to, vertices_by);
}

static bool make_room(nook_gltf *gltf, size_t meshes, size_t primitives)
{
    nook_scene *scene = gltf->scene;
    size_t mesh_total = scene->mesh_count + meshes, primitive_total = scene->primitive_count + primitives;
    if (meshes == 0)
        return true;
    nook_mesh *more_meshes = realloc(scene->meshes, mesh_total * sizeof *more_meshes);
    scene->meshes = more_meshes ? more_meshes : scene->meshes;
    nook_primitive *more_primitives = realloc(scene->primitives, (primitive_total + 1) * sizeof *more_primitives);
    scene->primitives = more_primitives ? more_primitives : scene->primitives;
    nook_gltf_origin *more_origins = realloc(gltf->origins, (primitive_total + 1) * sizeof *more_origins);
    gltf->origins = more_origins ? more_origins : gltf->origins;
    for (size_t i = scene->primitive_count; more_origins && i <= primitive_total; i++)
        more_origins[i] = (nook_gltf_origin){ .primitive = NULL };
    if (more_meshes && more_primitives && more_origins)
        return true;
    nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu more meshes", gltf->path, meshes);
    return false;
}

/* Every node that deforms a mesh gets one that no other node draws. @param users per mesh, nodes that draw it */
static nook_result part_meshes(nook_gltf *gltf, uint32_t *users)
{
    nook_scene *scene = gltf->scene;
    size_t meshes = 0, primitives = 0;
    for (uint32_t n = 0; n < scene->node_count; n++) {
        if (!deforms(gltf, &scene->nodes[n]) || users[scene->nodes[n].mesh] < 2)
            continue;
        meshes++; /* one more than needed where all that draw it deform it */
        primitives += scene->meshes[scene->nodes[n].mesh].primitive_count;
    }
    if (!make_room(gltf, meshes, primitives))
        return NOOK_E_MEMORY;
    for (uint32_t n = 0; n < scene->node_count; n++) {
        nook_node *node = &scene->nodes[n];
        if (!deforms(gltf, node))
            continue;
        scene->deformable_count++;
        if (users[node->mesh] < 2)
            continue;
        users[node->mesh]--;
        nook_result result = copy_mesh(gltf, node->mesh, &node->mesh);
        if (result != NOOK_OK)
            return result;
        /* a copy has one user and its number is beyond those that `users` counts; its node is not looked at again */
    }
    return NOOK_OK;
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

/* Where each one's tables are, and how large all are together. */
static nook_result lay_out(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    uint32_t next = 0;
    for (uint32_t n = 0; n < scene->node_count; n++) {
        nook_node *node = &scene->nodes[n];
        if (!deforms(gltf, node))
            continue;
        const nook_mesh *mesh = &scene->meshes[node->mesh];
        nook_deformable *d = &scene->deformables[next++];
        bool skinned = node->skin != NOOK_NONE && has_joints(gltf, mesh);
        *d = (nook_deformable){ .mesh = node->mesh,
                                .node = n,
                                .skin = skinned ? node->skin : NOOK_NONE,
                                .first_influence = skinned ? (uint32_t)scene->influence_count : NOOK_NONE,
                                .target_count = target_count(gltf, mesh),
                                .first_delta = scene->morph_delta_count,
                                .first_weight = scene->morph_weight_count,
                                .first_box = scene->joint_box_count,
                                .first_target_box = scene->target_box_count };
        find_vertices(scene, mesh, &d->first_vertex, &d->vertex_count);
        node->animated = true;
        scene->influence_count += skinned ? d->vertex_count : 0;
        scene->morph_delta_count += (size_t)d->target_count * d->vertex_count;
        scene->morph_weight_count += d->target_count;
        scene->joint_box_count += skinned ? scene->skins[d->skin].joint_count : 1;
        scene->target_box_count += d->target_count;
        if (scene->morph_delta_count > NOOK_GLTF_DELTAS_MAX || scene->influence_count > NOOK_GLTF_VERTICES_MAX)
            return nook_fail(NOOK_E_MEMORY, "%s: more than %d differences of morph targets; split it", gltf->path,
                             NOOK_GLTF_DELTAS_MAX);
    }
    return NOOK_OK;
}

static nook_result allocate(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    const char *path = gltf->path;
    scene->influences = nook_scene_allocate(path, scene->influence_count, sizeof *scene->influences);
    scene->morph_deltas = nook_scene_allocate(path, scene->morph_delta_count, sizeof *scene->morph_deltas);
    scene->morph_weights = nook_scene_allocate(path, scene->morph_weight_count, sizeof *scene->morph_weights);
    scene->joint_boxes = nook_scene_allocate(path, scene->joint_box_count, sizeof *scene->joint_boxes);
    scene->target_boxes = nook_scene_allocate(path, scene->target_box_count, sizeof *scene->target_boxes);
    if (!scene->influences || !scene->morph_deltas || !scene->morph_weights || !scene->joint_boxes ||
        !scene->target_boxes)
        return NOOK_E_MEMORY;
    for (uint32_t i = 0; i < scene->joint_box_count; i++)
        scene->joint_boxes[i] = empty_box;
    for (uint32_t i = 0; i < scene->target_box_count; i++)
        scene->target_boxes[i] = empty_box;
    return NOOK_OK;
}

/* The node's weights come before the mesh's; 0 where neither has any. */
static void read_weights(nook_gltf *gltf, const nook_deformable *d)
{
    const nook_gltf_node *node = &gltf->model->nodes[gltf->file_nodes[d->node]];
    const nook_gltf_mesh *mesh = &gltf->model->meshes[node->mesh];
    const double *weights = node->weight_count ? node->weights : mesh->weights;
    uint32_t count = node->weight_count ? node->weight_count : mesh->weight_count;
    if (count != 0 && count != d->target_count)
        nook_scene_warn(gltf->scene, "%s: nodes[%u]: %u weights for %u morph targets", gltf->path,
                        gltf->file_nodes[d->node], count, d->target_count);
    for (uint32_t t = 0; t < d->target_count && t < count; t++)
        gltf->scene->morph_weights[d->first_weight + t] = weights[t];
}

static void find_box(nook_scene *scene, const nook_deformable *d)
{
    nook_box *box = &scene->joint_boxes[d->first_box];
    for (uint32_t v = 0; v < d->vertex_count; v++)
        for (int k = 0; k < 3; k++) {
            box->min[k] = fminf(box->min[k], scene->vertices[d->first_vertex + v].position[k]);
            box->max[k] = fmaxf(box->max[k], scene->vertices[d->first_vertex + v].position[k]);
        }
}

static nook_result read_tables(nook_gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->scene->deformable_count; i++) {
        const nook_deformable *d = &gltf->scene->deformables[i];
        nook_result result = NOOK_OK;
        read_weights(gltf, d);
        if (d->skin != NOOK_NONE)
            result = nook_gltf_read_influences(gltf, d);
        else
            find_box(gltf->scene, d);
        if (result == NOOK_OK)
            result = nook_gltf_read_targets(gltf, d);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result nook_gltf_convert_deformables(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    uint32_t *users = nook_scene_allocate(gltf->path, scene->mesh_count, sizeof *users);
    nook_result result = users ? check_targets(gltf) : NOOK_E_MEMORY;
    for (uint32_t n = 0; users && n < scene->node_count; n++)
        if (scene->nodes[n].mesh != NOOK_NONE)
            users[scene->nodes[n].mesh]++;
    if (result == NOOK_OK)
        result = part_meshes(gltf, users);
    free(users);
    if (result != NOOK_OK)
        return result;
    scene->deformables = nook_scene_allocate(gltf->path, scene->deformable_count, sizeof *scene->deformables);
    result = scene->deformables ? lay_out(gltf) : NOOK_E_MEMORY;
    if (result == NOOK_OK)
        result = allocate(gltf);
    return result == NOOK_OK ? read_tables(gltf) : result;
}
