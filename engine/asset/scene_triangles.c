/* Scenes made by code. */
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static nook_result check_input(const char *name, const float *positions, uint32_t vertex_count, const uint32_t *indices,
                               uint32_t index_count)
{
    if (index_count % 3 != 0)
        return nook_fail(NOOK_E_ARG, "%s: %u indices are not whole triangles", name, index_count);
    for (uint32_t i = 0; i < index_count; i++)
        if (indices[i] >= vertex_count)
            return nook_fail(NOOK_E_ARG, "%s: index %u is %u, there are %u vertices", name, i, indices[i],
                             vertex_count);
    for (size_t i = 0; i < (size_t)vertex_count * 3; i++)
        if (!isfinite(positions[i]))
            return nook_fail(NOOK_E_ARG, "%s: the position of vertex %zu is not finite", name, i / 3);
    return NOOK_OK;
}

static nook_result allocate(nook_scene *scene, const char *name, uint32_t index_count)
{
    scene->path = nook_scene_copy_string(name);
    scene->vertices = nook_scene_allocate(name, index_count, sizeof *scene->vertices);
    scene->indices = nook_scene_allocate(name, index_count, sizeof *scene->indices);
    scene->primitives = nook_scene_allocate(name, 1, sizeof *scene->primitives);
    scene->meshes = nook_scene_allocate(name, 1, sizeof *scene->meshes);
    scene->materials = nook_scene_allocate(name, 1, sizeof *scene->materials);
    scene->nodes = nook_scene_allocate(name, 1, sizeof *scene->nodes);
    bool arrays = scene->path && scene->vertices && scene->indices && scene->primitives && scene->meshes &&
                  scene->materials && scene->nodes;
    if (!arrays)
        return NOOK_E_MEMORY;
    nook_scene_default_material(&scene->materials[0]);
    scene->nodes[0] = (nook_node){ .parent = NOOK_NONE,
                                   .camera = NOOK_NONE,
                                   .light = NOOK_NONE,
                                   .skin = NOOK_NONE,
                                   .world_from_local = nook_matrix_identity() };
    scene->primitive_count = scene->mesh_count = scene->material_count = scene->node_count = 1;
    scene->file_node_count = 1;
    scene->meshes[0].name = nook_scene_copy_string(name);
    scene->materials[0].name = nook_scene_copy_string("default");
    scene->nodes[0].name = nook_scene_copy_string(name);
    return scene->meshes[0].name && scene->materials[0].name && scene->nodes[0].name ? NOOK_OK : NOOK_E_MEMORY;
}

static void fill(nook_scene *scene, const float *positions, const uint32_t *indices, uint32_t index_count)
{
    scene->vertex_count = scene->index_count = index_count;
    for (uint32_t i = 0; i < index_count; i++) {
        scene->vertices[i] = (nook_vertex){ .colour = { 1.0f, 1.0f, 1.0f, 1.0f } };
        memcpy(scene->vertices[i].position, positions + (size_t)indices[i] * 3, sizeof scene->vertices[i].position);
        scene->indices[i] = i;
    }
    nook_scene_make_flat_normals(scene->vertices, index_count);
    scene->primitives[0] = (nook_primitive){ .vertex_count = index_count, .index_count = index_count };
    scene->meshes[0].primitive_count = 1;
}

nook_result nook_scene_from_triangles(const char *name, const float *positions, uint32_t vertex_count,
                                      const uint32_t *indices, uint32_t index_count, nook_scene **out_scene)
{
    *out_scene = NULL;
    nook_result result = check_input(name, positions, vertex_count, indices, index_count);
    if (result != NOOK_OK)
        return result;
    nook_scene *scene = nook_scene_allocate(name, 1, sizeof *scene);
    if (!scene)
        return NOOK_E_MEMORY;
    result = allocate(scene, name, index_count);
    if (result == NOOK_OK) {
        fill(scene, positions, indices, index_count);
        result = nook_scene_finish(scene);
    }
    if (result != NOOK_OK) {
        nook_scene_destroy(scene);
        return result;
    }
    *out_scene = scene;
    return NOOK_OK;
}
