/* Primitives to triangles: which are kept, what their attributes may be, strips and fans expanded. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/gltf_vertex_internal.h"
#include "engine/asset/scene_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/** What was left out, for one warning each instead of one per primitive. */
typedef struct left_out {
    uint32_t points_and_lines, without_position;
} left_out;

static void *grow(const char *path, void *memory, size_t need, uint32_t *capacity, size_t element_size)
{
    if (memory && need <= *capacity)
        return memory;
    size_t wanted = *capacity < 1024 ? 1024 : (size_t)*capacity * 2;
    wanted = wanted < need ? need : wanted;
    void *larger = realloc(memory, wanted * element_size);
    if (!larger) {
        nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu elements of %zu bytes", path, wanted, element_size);
        return NULL;
    }
    *capacity = (uint32_t)wanted; /* at most twice NOOK_GLTF_INDICES_MAX */
    return larger;
}

nook_vertex *nook_gltf_add_vertices(nook_gltf *gltf, size_t count)
{
    nook_scene *scene = gltf->scene;
    if (count > NOOK_GLTF_VERTICES_MAX - scene->vertex_count) {
        nook_fail(NOOK_E_MEMORY, "%s: more than %d vertices; split it", gltf->path, NOOK_GLTF_VERTICES_MAX);
        return NULL;
    }
    nook_vertex *vertices =
        grow(gltf->path, scene->vertices, scene->vertex_count + count, &gltf->vertex_capacity, sizeof *vertices);
    if (!vertices)
        return NULL;
    scene->vertices = vertices;
    scene->vertex_count += count;
    return vertices + scene->vertex_count - count;
}

uint32_t *nook_gltf_add_indices(nook_gltf *gltf, size_t count)
{
    nook_scene *scene = gltf->scene;
    if (count > NOOK_GLTF_INDICES_MAX - scene->index_count) {
        nook_fail(NOOK_E_MEMORY, "%s: more than %d triangles; split it", gltf->path, NOOK_GLTF_INDICES_MAX / 3);
        return NULL;
    }
    uint32_t *indices =
        grow(gltf->path, scene->indices, scene->index_count + count, &gltf->index_capacity, sizeof *indices);
    if (!indices)
        return NULL;
    scene->indices = indices;
    scene->index_count += count;
    return indices + scene->index_count - count;
}

static size_t corner_count(uint32_t mode, size_t source_count)
{
    if (mode == MODE_TRIANGLES)
        return source_count / 3 * 3;
    return source_count < 3 ? 0 : (source_count - 2) * 3;
}

/* Triangle `t` of a strip or fan; every second one of a strip is turned, so that all keep the first one's winding. */
static void expand(uint32_t mode, const uint32_t *source, size_t t, uint32_t out[3])
{
    size_t odd = mode == MODE_STRIP ? t % 2 : 0;
    size_t first = mode == MODE_FAN ? 0 : mode == MODE_STRIP ? t : 3 * t;
    size_t second = mode == MODE_FAN ? t + 1 : first + 1;
    out[0] = source[first];
    out[1] = source[second + odd];
    out[2] = source[second + 1 - odd];
}

static nook_result check_indices(const nook_gltf *gltf, const nook_gltf_primitive *from, const char *place)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[from->indices];
    bool unsigned_integer = a->component_type == 5121 || a->component_type == 5123 || a->component_type == 5125;
    if (a->components != 1 || !unsigned_integer)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: the indices are not single unsigned integers", gltf->path, place);
    if (a->count > NOOK_GLTF_INDICES_MAX)
        return nook_fail(NOOK_E_MEMORY, "%s: %s: %u indices; split it", gltf->path, place, a->count);
    return NOOK_OK;
}

/* The vertices in their order, as listed or counted up. *out_indices: release with free. */
static nook_result read_source_indices(const nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                                       uint32_t **out_indices, size_t *out_count)
{
    uint32_t vertex_count = gltf->model->accessors[from->position].count;
    bool listed = from->indices != NOOK_GLTF_NONE;
    nook_result result = listed ? check_indices(gltf, from, place) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    size_t count = listed ? gltf->model->accessors[from->indices].count : vertex_count;
    uint32_t *indices = nook_scene_allocate(gltf->path, count, sizeof *indices);
    if (!indices)
        return NOOK_E_MEMORY;
    if (listed)
        nook_gltf_read_indices(gltf, from->indices, indices);
    for (size_t i = 0; i < count; i++) {
        if (!listed)
            indices[i] = (uint32_t)i;
        if (indices[i] < vertex_count)
            continue;
        result = nook_fail(NOOK_E_FORMAT, "%s: %s: index %zu is %u, there are %u vertices", gltf->path, place, i,
                           indices[i], vertex_count);
        free(indices);
        return result;
    }
    *out_indices = indices;
    *out_count = count;
    return NOOK_OK;
}

static nook_result read_triangles(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                                  nook_primitive *to)
{
    uint32_t *source = NULL;
    size_t source_count = 0;
    nook_result result = read_source_indices(gltf, from, place, &source, &source_count);
    if (result != NOOK_OK)
        return result;
    size_t count = corner_count(from->mode, source_count);
    if (from->mode == MODE_TRIANGLES && source_count % 3 != 0)
        nook_scene_warn(gltf->scene, "%s: %s: %zu indices do not make whole triangles; the last %zu are ignored",
                        gltf->path, place, source_count, source_count % 3);
    uint32_t *indices = nook_gltf_add_indices(gltf, count);
    for (size_t t = 0; indices && t < count / 3; t++)
        expand(from->mode, source, t, indices + 3 * t);
    free(source);
    if (!indices)
        return NOOK_E_MEMORY;
    to->first_index = (uint32_t)(gltf->scene->index_count - count);
    to->index_count = (uint32_t)count;
    return NOOK_OK;
}

static bool is_skipped(const nook_gltf_primitive *from, left_out *left)
{
    bool has_position = from->position != NOOK_GLTF_NONE;
    left->without_position += !has_position;
    left->points_and_lines += has_position && from->mode < MODE_TRIANGLES;
    return !has_position || from->mode < MODE_TRIANGLES;
}

static nook_result convert_mesh(nook_gltf *gltf, uint32_t index, left_out *left)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_mesh *from = &gltf->model->meshes[index];
    nook_mesh *mesh = &scene->meshes[index];
    nook_gltf_vertex_source previous = { 0 };
    mesh->first_primitive = scene->primitive_count;
    mesh->name = nook_scene_copy_string(from->name);
    if (!mesh->name)
        return NOOK_E_MEMORY;
    if (from->primitive_count == 0)
        nook_scene_warn(scene, "%s: meshes[%u] has no primitives", gltf->path, index);
    for (uint32_t p = 0; p < from->primitive_count; p++) {
        char place[64];
        const nook_gltf_primitive *primitive = &gltf->model->primitives[from->first_primitive + p];
        if (is_skipped(primitive, left))
            continue;
        nook_primitive *to = &scene->primitives[scene->primitive_count];
        snprintf(place, sizeof place, "meshes[%u].primitives[%u]", index, p);
        to->material = primitive->material == NOOK_GLTF_NONE ? scene->material_count - 1 : primitive->material;
        to->flat = primitive->normal == NOOK_GLTF_NONE;
        gltf->origins[scene->primitive_count].primitive = primitive;
        nook_result result = nook_gltf_check_attributes(gltf, primitive, place);
        if (result == NOOK_OK)
            result = nook_gltf_check_deformation(gltf, primitive, place);
        if (result == NOOK_OK)
            result = read_triangles(gltf, primitive, place, to);
        if (result == NOOK_OK)
            result = nook_gltf_read_vertices(gltf, primitive, place, to, &previous);
        if (result != NOOK_OK)
            return result;
        scene->primitive_count++;
        mesh->primitive_count++;
    }
    return NOOK_OK;
}

nook_result nook_gltf_convert_meshes(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    left_out left = { 0 };
    uint32_t count = gltf->model->mesh_count;
    scene->meshes = nook_scene_allocate(gltf->path, count, sizeof *scene->meshes);
    scene->primitives = nook_scene_allocate(gltf->path, gltf->model->primitive_count, sizeof *scene->primitives);
    gltf->origins = nook_scene_allocate(gltf->path, (size_t)gltf->model->primitive_count + 1, sizeof *gltf->origins);
    if (!scene->meshes || !scene->primitives || !gltf->origins)
        return NOOK_E_MEMORY;
    scene->mesh_count = count;
    for (uint32_t i = 0; i < count; i++) {
        nook_result result = convert_mesh(gltf, i, &left);
        if (result != NOOK_OK)
            return result;
    }
    if (left.points_and_lines)
        nook_scene_warn(scene, "%s: %u primitives of points or lines are left out", gltf->path, left.points_and_lines);
    if (left.without_position)
        nook_scene_warn(scene, "%s: %u primitives without POSITION are left out", gltf->path, left.without_position);
    return NOOK_OK;
}
