/* What of a scene darkens its surroundings: bodies, their triangles, and how fine each is to be. */
#include "game/volumes.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/material_alpha.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_CAPACITY = 64 };

/* ---- Collecting triangles --------------------------------------------------------------------------------------- */

/* A volume that is being made, and how much room its arrays have. */
typedef struct builder {
    nook_scene_volume *volume;
    size_t vertex_capacity, index_capacity, part_capacity;
} builder;

/* In the order in which a volume has its triangles: each kind holds the first ones. */
typedef enum layer { LAYER_SOLID, LAYER_BLENDED, LAYER_CLEAR, LAYERS } layer;

/* A scene, and the layer of each material. */
typedef struct source {
    const nook_scene *scene;
    layer *layers;
} source;

static layer layer_of(const nook_scene *scene, const nook_material *material)
{
    nook_alpha_part part;
    if (!nook_material_alpha(scene, material, &part))
        return LAYER_SOLID;
    if (nook_alpha_most(&part) < NOOK_DISTANCE_LEAST_ALPHA)
        return LAYER_CLEAR;
    return part.masked ? LAYER_SOLID : LAYER_BLENDED;
}

/* @return false: no memory */
static bool sort_materials(const nook_scene *scene, source *out)
{
    *out = (source){ scene, malloc((scene->material_count + (size_t)1) * sizeof *out->layers) };
    for (uint32_t i = 0; out->layers && i < scene->material_count; i++)
        out->layers[i] = layer_of(scene, &scene->materials[i]);
    return out->layers != NULL;
}

static void count_mesh(const nook_scene *scene, const nook_mesh *mesh, builder *b)
{
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + i];
        b->vertex_capacity += primitive->vertex_count;
        b->index_capacity += primitive->index_count;
        b->part_capacity++;
    }
}

static nook_result reserve(builder *b, const char *name)
{
    nook_scene_volume *volume = b->volume;
    volume->name = malloc(strlen(name) + 1);
    if (b->vertex_capacity <= UINT32_MAX) {
        volume->positions = malloc((b->vertex_capacity + 1) * 3 * sizeof(float));
        volume->indices = malloc((b->index_capacity + 1) * sizeof(uint32_t));
        volume->uvs = malloc((b->vertex_capacity + 1) * 2 * sizeof(float));
        volume->parts = malloc((b->part_capacity + 1) * sizeof *volume->parts);
    }
    if (!volume->name || !volume->positions || !volume->indices || !volume->uvs || !volume->parts)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu vertices", name, b->vertex_capacity);
    memcpy(volume->name, name, strlen(name) + 1);
    return NOOK_OK;
}

static bool finite3(const float p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

/* What is not opaque of the last `count` indices. */
static void append_part(const nook_scene *scene, const nook_material *material, size_t count, nook_scene_volume *volume)
{
    nook_alpha_part part;
    if (count == 0 || !nook_material_alpha(scene, material, &part))
        return;
    part.first_index = volume->index_count + volume->blended_index_count - count;
    part.index_count = count;
    volume->parts[volume->part_count++] = part;
}

static void append_primitive(const source *from, const nook_primitive *primitive, const nook_matrix *space,
                             nook_scene_volume *volume)
{
    const nook_scene *scene = from->scene;
    const layer of = from->layers[primitive->material];
    uint32_t base = volume->vertex_count + volume->blended_vertex_count;
    bool blended = of != LAYER_SOLID;
    size_t *count = blended ? &volume->blended_index_count : &volume->index_count, before = *count;
    float *positions = volume->positions + (size_t)base * 3;
    for (uint32_t i = 0; i < primitive->vertex_count; i++) {
        const float *p = scene->vertices[primitive->first_vertex + i].position;
        double moved[3] = { p[0], p[1], p[2] };
        nook_matrix_apply_point(space, moved, moved);
        for (int axis = 0; axis < 3; axis++)
            positions[i * 3u + (uint32_t)axis] = (float)moved[axis];
        memcpy(volume->uvs + 2 * ((size_t)base + i), scene->vertices[primitive->first_vertex + i].uv,
               2 * sizeof(float));
    }
    *(blended ? &volume->blended_vertex_count : &volume->vertex_count) += primitive->vertex_count;
    const uint32_t *indices = scene->indices + primitive->first_index;
    for (uint32_t i = 0; i + 2 < primitive->index_count; i += 3) {
        bool finite = true;
        for (uint32_t k = 0; k < 3; k++)
            finite = finite && finite3(positions + (size_t)indices[i + k] * 3);
        for (uint32_t k = 0; finite && k < 3; k++, ++*count)
            volume->indices[volume->index_count + volume->blended_index_count] = base + indices[i + k];
    }
    if (of == LAYER_CLEAR) {
        volume->clear_vertex_count += primitive->vertex_count;
        volume->clear_index_count += *count - before;
    }
    append_part(scene, &scene->materials[primitive->material], *count - before, volume);
}

/* Its primitives of a layer: after all of the layers before. Appends what of it came to `parts`, as one each, unless that is NULL. @return
   how many */
static uint32_t append_mesh(const source *from, const nook_mesh *mesh, const nook_matrix *space, layer of,
                            nook_scene_volume *volume, nook_volumes_part *parts)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const nook_primitive *primitive = &from->scene->primitives[mesh->first_primitive + i];
        size_t first = volume->index_count;
        if (from->layers[primitive->material] != of)
            continue;
        append_primitive(from, primitive, space, volume);
        if (parts && volume->index_count > first)
            parts[count++] = (nook_volumes_part){ first, volume->index_count - first };
    }
    return count;
}

void nook_scene_volume_release(nook_scene_volume *volume)
{
    free(volume->positions);
    free(volume->indices);
    free(volume->uvs);
    free(volume->parts);
    volume->positions = NULL;
    volume->indices = NULL;
    volume->uvs = NULL;
    volume->parts = NULL;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        free(volume->bakes[kind].bytes);
        volume->bakes[kind].bytes = NULL;
    }
    for (uint32_t i = 0; i < volume->level_count; i++)
        free(volume->levels[i].path);
    free(volume->levels);
    volume->levels = NULL;
    volume->level_count = 0;
}

size_t nook_scene_volume_index_count(const nook_scene_volume *volume)
{
    return volume->index_count + volume->blended_index_count;
}

static void free_volume(nook_scene_volume *volume)
{
    nook_scene_volume_release(volume);
    free(volume->name);
    *volume = (nook_scene_volume){ 0 };
}

/* ---- Resolution ------------------------------------------------------------------------------------------------- */

double nook_volumes_default_r_max(const nook_scene *scene)
{
    double squared = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double side = scene->bounds_max[axis] - scene->bounds_min[axis];
        if (!(side >= 0.0))
            return 0.0;
        squared += side * side;
    }
    return NOOK_VOLUMES_R_MAX_DEFAULT * sqrt(squared);
}

uint32_t nook_volumes_body_resolution(double longest, double r_max, uint32_t resolution)
{
    double high = resolution > 2 ? resolution / 2 : 1;
    double low = fmin(NOOK_VOLUMES_BODY_RESOLUTION_MIN, high);
    double wanted = r_max > 0.0 ? ceil(longest * NOOK_VOLUMES_VOXELS_PER_R_MAX / r_max) : low;
    return (uint32_t)fmin(fmax(wanted, low), high);
}

static double longest_side(const nook_scene_volume *volume)
{
    vec3 box[2];
    double longest = 0.0;
    size_t count = volume->index_count > 0 ? volume->index_count : volume->blended_index_count;
    glm_aabb_invalidate(box);
    for (size_t i = 0; i < count; i++) {
        float *position = volume->positions + (size_t)volume->indices[i] * 3;
        glm_vec3_minv(box[0], position, box[0]);
        glm_vec3_maxv(box[1], position, box[1]);
    }
    for (int axis = 0; axis < 3; axis++)
        longest = fmax(longest, (double)box[1][axis] - box[0][axis]);
    return longest;
}

/* ---- Bodies ----------------------------------------------------------------------------------------------------- */

static bool usable_matrix(const nook_matrix *matrix)
{
    nook_matrix inverse;
    return nook_matrix_inverse_affine(matrix, &inverse) != 0;
}

/* In a scene that plays: what stands still has no deformables any more. */
static bool deforms(const nook_scene *scene, const nook_node *node)
{
    return nook_scene_deformable_of_node(scene, (uint32_t)(node - scene->nodes)) != NOOK_NONE;
}

static bool is_body(const nook_scene *scene, const nook_node *node)
{
    return node->mesh != NOOK_NONE && (node->moving || node->animated) && !deforms(scene, node) &&
           scene->meshes[node->mesh].primitive_count > 0;
}

static bool is_static(const nook_scene *scene, const nook_node *node)
{
    return node->mesh != NOOK_NONE && !node->moving && !node->animated && scene->meshes[node->mesh].primitive_count > 0;
}

static void name_mesh(const nook_scene *scene, const nook_node *node, char out[NAME_CAPACITY])
{
    const char *name = scene->meshes[node->mesh].name;
    if (name[0])
        snprintf(out, NAME_CAPACITY, "%s", name);
    else if (node->name[0])
        snprintf(out, NAME_CAPACITY, "%s", node->name);
    else
        snprintf(out, NAME_CAPACITY, "mesh %u", node->mesh);
}

static void add_occluder(nook_scene_volumes *out, uint32_t volume, uint32_t node, const nook_matrix *world_from_mesh)
{
    out->volumes[volume].instances++;
    out->occluders[out->occluder_count++] = (nook_scene_occluder){ volume, node, *world_from_mesh, false };
}

/* Whether any of these triangles can be seen: lines and points darken nothing that anyone sees. */
static bool has_area(const nook_scene_volume *volume, size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i += 3) {
        const float *corner = volume->positions + (size_t)volume->indices[i] * 3;
        double u[3], v[3], normal[3];
        nook_vector_between(corner, volume->positions + (size_t)volume->indices[i + 1] * 3, u);
        nook_vector_between(corner, volume->positions + (size_t)volume->indices[i + 2] * 3, v);
        nook_vector_cross(u, v, normal);
        if (normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0)
            return true;
    }
    return false;
}

/* Keeps the volume that was built in the next place of `out`, unless nothing came together. */
static bool keep_volume(nook_scene_volumes *out)
{
    nook_scene_volume *volume = &out->volumes[out->volume_count];
    bool solid = has_area(volume, 0, volume->index_count);
    if (!solid && !has_area(volume, volume->index_count, volume->blended_index_count)) {
        free_volume(volume);
        return false;
    }
    if (!solid) { /* what there is of it stands among the blended ones */
        volume->blended_vertex_count += volume->vertex_count;
        volume->blended_index_count += volume->index_count;
        volume->vertex_count = 0;
        volume->index_count = 0;
        if (!has_area(volume, 0, volume->blended_index_count - volume->clear_index_count)) {
            volume->clear_vertex_count = volume->blended_vertex_count;
            volume->clear_index_count = volume->blended_index_count;
        }
    }
    volume->longest = longest_side(volume);
    out->volume_count++;
    return true;
}

static nook_result collect_static(const source *from, nook_scene_volumes *out)
{
    const nook_scene *scene = from->scene;
    builder b = { .volume = &out->volumes[out->volume_count] };
    size_t primitives = 0;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i];
        if (!is_static(scene, node))
            continue;
        count_mesh(scene, &scene->meshes[node->mesh], &b);
        primitives += scene->meshes[node->mesh].primitive_count;
    }
    if (b.index_capacity == 0)
        return NOOK_OK;
    nook_result result = reserve(&b, "static");
    out->parts = calloc(primitives + 1, sizeof *out->parts);
    if (result == NOOK_OK && !out->parts)
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu parts", scene->path, primitives);
    if (result != NOOK_OK) {
        free_volume(b.volume);
        return result;
    }
    double centre[3];
    for (int axis = 0; axis < 3; axis++)
        centre[axis] = scene->bounds_min[axis] * 0.5 + scene->bounds_max[axis] * 0.5;
    nook_matrix mesh_from_world = nook_matrix_translation(-centre[0], -centre[1], -centre[2]);
    for (size_t i = 0; i < (size_t)LAYERS * scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i % scene->node_count];
        if (!is_static(scene, node))
            continue;
        nook_matrix mesh_from_local = nook_matrix_multiply(&mesh_from_world, &node->world_from_local);
        out->part_count += append_mesh(from, &scene->meshes[node->mesh], &mesh_from_local,
                                       (layer)(i / scene->node_count), b.volume, out->parts + out->part_count);
    }
    nook_matrix world_from_mesh = nook_matrix_translation(centre[0], centre[1], centre[2]);
    if (b.volume->blended_index_count > 0)
        out->part_count = 0; /* what is split is split by opaque parts, and would lose its glass */
    if (keep_volume(out))
        add_occluder(out, out->volume_count - 1, NOOK_NONE, &world_from_mesh);
    return NOOK_OK;
}

static nook_result collect_body(const source *from, uint32_t node_index, uint32_t *volume_of_mesh,
                                nook_scene_volumes *out)
{
    const nook_scene *scene = from->scene;
    const nook_node *node = &scene->nodes[node_index];
    const nook_mesh *mesh = &scene->meshes[node->mesh];
    char name[NAME_CAPACITY];
    name_mesh(scene, node, name);
    builder b = { .volume = &out->volumes[out->volume_count] };
    count_mesh(scene, mesh, &b);
    nook_result result = reserve(&b, name);
    if (result != NOOK_OK) {
        free_volume(b.volume);
        return result;
    }
    nook_matrix identity = nook_matrix_identity();
    for (int i = 0; i < LAYERS; i++)
        append_mesh(from, mesh, &identity, (layer)i, b.volume, NULL);
    if (keep_volume(out))
        volume_of_mesh[node->mesh] = out->volume_count - 1;
    return NOOK_OK;
}

/* volume_of_mesh: NOOK_NONE everywhere at first. */
static nook_result collect_bodies(const source *from, uint32_t *volume_of_mesh, nook_scene_volumes *out)
{
    const nook_scene *scene = from->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i];
        if (!is_body(scene, node))
            continue;
        if (!usable_matrix(&node->world_from_local)) {
            nook_log_warning("%s: node '%s' is flattened to nothing by its scale; it darkens nothing", scene->path,
                             node->name);
            continue;
        }
        if (volume_of_mesh[node->mesh] == NOOK_NONE) {
            nook_result result = collect_body(from, i, volume_of_mesh, out);
            if (result != NOOK_OK)
                return result;
        }
        if (volume_of_mesh[node->mesh] != NOOK_NONE)
            add_occluder(out, volume_of_mesh[node->mesh], i, &node->world_from_local);
    }
    return NOOK_OK;
}

/* The static body takes all of `resolution`; a mesh takes what its largest instance needs. */
static void choose_resolutions(nook_scene_volumes *volumes, uint32_t resolution)
{
    for (uint32_t i = 0; i < volumes->occluder_count; i++) {
        const nook_scene_occluder *occluder = &volumes->occluders[i];
        nook_scene_volume *volume = &volumes->volumes[occluder->volume];
        uint32_t needed = resolution;
        if (occluder->node != NOOK_NONE) {
            double longest = volume->longest * nook_matrix_longest_axis(&occluder->world_from_mesh);
            needed = nook_volumes_body_resolution(longest, volumes->r_max, resolution);
        }
        if (needed > volume->resolution)
            volume->resolution = needed;
    }
}

static nook_result collect(const nook_scene *scene, nook_scene_volumes *out)
{
    /* At most one volume per mesh and one for the static body, one occluder per node and one. */
    out->volumes = calloc((size_t)scene->mesh_count + 1, sizeof *out->volumes);
    out->occluders = calloc((size_t)scene->node_count + 1, sizeof *out->occluders);
    uint32_t *volume_of_mesh = malloc(((size_t)scene->mesh_count + 1) * sizeof *volume_of_mesh);
    nook_result result = NOOK_OK;
    source from;
    if (!sort_materials(scene, &from) || !out->volumes || !out->occluders || !volume_of_mesh)
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory for %u volumes", scene->path, scene->mesh_count);
    for (uint32_t i = 0; volume_of_mesh && i < scene->mesh_count; i++)
        volume_of_mesh[i] = NOOK_NONE;
    if (result == NOOK_OK)
        result = collect_static(&from, out);
    if (result == NOOK_OK)
        result = collect_bodies(&from, volume_of_mesh, out);
    free(volume_of_mesh);
    free(from.layers);
    return result;
}

nook_result nook_volumes_collect(const nook_scene *scene, const nook_volumes_desc *desc, nook_scene_volumes *out)
{
    uint32_t resolution = desc->resolution ? desc->resolution : NOOK_VOLUMES_RESOLUTION_DEFAULT;
    if (resolution > NOOK_VOXELIZE_RESOLUTION_MAX)
        return nook_fail(NOOK_E_RANGE, "bake: resolution %u; choose 1 to %u", resolution, NOOK_VOXELIZE_RESOLUTION_MAX);
    if (!isfinite(desc->r_max) || desc->r_max < 0.0)
        return nook_fail(NOOK_E_RANGE, "bake: r_max %g; choose a length in metres above 0", desc->r_max);
    nook_scene_volumes volumes = { .r_max = desc->r_max > 0.0 ? desc->r_max : nook_volumes_default_r_max(scene),
                                   .kinds = desc->kinds ? desc->kinds : NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY),
                                   .plan = desc->plan };
    nook_result result = collect(scene, &volumes);
    if (result != NOOK_OK) {
        nook_volumes_free(&volumes);
        return result;
    }
    choose_resolutions(&volumes, resolution);
    *out = volumes;
    return NOOK_OK;
}

nook_result nook_volumes_reserve(nook_scene_volumes *volumes, uint32_t more)
{
    const size_t volume_count = (size_t)volumes->volume_count + more;
    const size_t occluder_count = (size_t)volumes->occluder_count + more;
    if (more == 0)
        return NOOK_OK;
    nook_scene_volume *grown = realloc(volumes->volumes, volume_count * sizeof *grown);
    if (grown)
        volumes->volumes = grown;
    nook_scene_occluder *occluders = realloc(volumes->occluders, occluder_count * sizeof *occluders);
    if (occluders)
        volumes->occluders = occluders;
    return grown && occluders ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "no memory for %u more volumes", more);
}

void nook_volumes_free(nook_scene_volumes *volumes)
{
    if (!volumes)
        return;
    for (uint32_t i = 0; i < volumes->volume_count; i++)
        free_volume(&volumes->volumes[i]);
    free(volumes->volumes);
    free(volumes->occluders);
    free(volumes->parts);
    *volumes = (nook_scene_volumes){ 0 };
}
