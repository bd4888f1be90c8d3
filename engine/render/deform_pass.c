/* Deformables in the pose of the frame: computed once, into the buffers of vertices and triangle normals that all passes read. */
#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static_assert(sizeof(nook_vertex) == 64 && sizeof(nook_influence) == 24 && sizeof(nook_morph_delta) == 24 &&
                  sizeof(nook_joint_matrix) == 48,
              "shaders/render/deform.comp.glsl reads them as numbers");

enum {
    STORAGE_REST = 0,
    STORAGE_POSED = 1,
    STORAGE_INFLUENCES = 2,
    STORAGE_DELTAS = 3,
    STORAGE_JOINTS = 4,
    STORAGE_WEIGHTS = 5,
    STORAGE_NORMALS = 2,
    STORAGE_INDICES = 3,
    LOCATION_MESH = 0,
    LOCATION_TARGETS = 1,
    LOCATION_PRIMITIVE = 0,
    GROUP = 64,
    BLOCK_MAX = 1 << 27, /* bytes that every device lets a shader see at once */
};

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static nook_result upload(nook_render_scene *s, const void *data, size_t size, nook_buffer *out)
{
    static const uint32_t nothing[4] = { 0 };
    if (size > BLOCK_MAX)
        return nook_fail(NOOK_E_RANGE, "%s: what deforms its meshes takes %zu bytes, at most %d can be read at once",
                         s->scene->path, size, BLOCK_MAX);
    nook_result result = nook_buffer_create(s->gpu, size ? data : nothing, size ? size : sizeof nothing, out);
    if (result == NOOK_OK)
        s->bytes += out->size;
    return result;
}

/* The vertices of all deformables, one after the other, in the order of the deformables. */
static nook_result upload_vertices(nook_render_scene *s)
{
    const nook_scene *scene = s->scene;
    size_t count = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++)
        count += scene->deformables[i].vertex_count;
    nook_vertex *rest = malloc((count + 1) * sizeof *rest);
    if (rest == NULL)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu vertices", scene->path, count);
    size_t at = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_deformable *d = &scene->deformables[i];
        const nook_vertex *from =
            scene->rest_vertices ? scene->rest_vertices + d->first_rest : scene->vertices + d->first_vertex;
        memcpy(rest + at, from, d->vertex_count * sizeof *rest);
        at += d->vertex_count;
    }
    nook_result result = upload(s, rest, count * sizeof *rest, &s->deform.rest);
    if (result == NOOK_OK)
        result = upload(s, rest, count * sizeof *rest, &s->deform.posed);
    free(rest);
    return result;
}

static size_t count_indices(const nook_scene *scene)
{
    size_t count = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_mesh *mesh = &scene->meshes[scene->deformables[i].mesh];
        for (uint32_t p = 0; p < mesh->primitive_count; p++)
            count += scene->primitives[mesh->first_primitive + p].index_count;
    }
    return count;
}

static nook_result upload_indices(nook_render_scene *s)
{
    const nook_scene *scene = s->scene;
    size_t count = count_indices(scene), at = 0;
    uint32_t *indices = malloc((count + 1) * sizeof *indices);
    if (indices == NULL)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu indices", scene->path, count);
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_mesh *mesh = &scene->meshes[scene->deformables[i].mesh];
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
            memcpy(indices + at, scene->indices + primitive->first_index, primitive->index_count * sizeof *indices);
            at += primitive->index_count;
        }
    }
    nook_result result = upload(s, indices, count * sizeof *indices, &s->deform.indices);
    if (result == NOOK_OK) /* three numbers a triangle, as many as indices */
        result = upload(s, indices, count * sizeof(float), &s->deform.normals);
    free(indices);
    return result;
}

/* Of every skinned deformable its own, in the order of the deformables. */
static size_t count_joints(const nook_scene *scene)
{
    size_t count = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++)
        if (scene->deformables[i].skin != NOOK_NONE)
            count += scene->skins[scene->deformables[i].skin].joint_count;
    return count;
}

static nook_result upload_numbers(nook_render_scene *s)
{
    const nook_scene *scene = s->scene;
    size_t joint_size = (count_joints(scene) + 1) * sizeof(nook_joint_matrix);
    size_t weight_size = (scene->morph_weight_count + (size_t)1) * sizeof(float);
    void *zeros = calloc(1, joint_size + weight_size);
    nook_result result = zeros ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "%s: no memory for its joints", scene->path);
    if (result == NOOK_OK)
        result =
            upload(s, scene->influences, scene->influence_count * sizeof *scene->influences, &s->deform.influences);
    if (result == NOOK_OK)
        result =
            upload(s, scene->morph_deltas, scene->morph_delta_count * sizeof *scene->morph_deltas, &s->deform.deltas);
    if (result == NOOK_OK)
        result = upload(s, zeros, joint_size, &s->deform.joints);
    if (result == NOOK_OK)
        result = upload(s, zeros, weight_size, &s->deform.weights);
    free(zeros);
    return result;
}

nook_result nook_deform_create(nook_render_scene *s)
{
    if (s->scene->deformable_count == 0)
        return NOOK_OK;
    nook_result result = nook_program_compute(s->gpu, "shaders/render/deform.comp.glsl", "", &s->deform.program);
    if (result == NOOK_OK)
        result =
            nook_program_compute(s->gpu, "shaders/render/deform_normals.comp.glsl", "", &s->deform.normals_program);
    if (result == NOOK_OK)
        result = upload_vertices(s);
    if (result == NOOK_OK)
        result = upload_indices(s);
    return result == NOOK_OK ? upload_numbers(s) : result;
}

void nook_deform_destroy(nook_render_scene *s)
{
    nook_buffer *buffers[] = { &s->deform.rest,   &s->deform.posed,   &s->deform.influences, &s->deform.deltas,
                               &s->deform.joints, &s->deform.weights, &s->deform.indices,    &s->deform.normals };
    for (size_t i = 0; i < NOOK_COUNT(buffers); i++)
        nook_buffer_destroy(s->gpu, buffers[i]);
}

/* ---- A frame ----------------------------------------------------------------------------------------------------- */

static void update_numbers(const nook_render_scene *s, const nook_mesh_pose *poses)
{
    size_t joint = 0;
    for (uint32_t i = 0; i < s->scene->deformable_count; i++) {
        const nook_deformable *d = &s->scene->deformables[i];
        if (d->target_count > 0)
            nook_buffer_update(s->gpu, s->deform.weights, d->first_weight * sizeof(float), poses[i].weights,
                               d->target_count * sizeof(float));
        if (d->skin == NOOK_NONE)
            continue;
        uint32_t count = s->scene->skins[d->skin].joint_count;
        nook_buffer_update(s->gpu, s->deform.joints, joint * sizeof(nook_joint_matrix), poses[i].joints,
                           count * sizeof(nook_joint_matrix));
        joint += count;
    }
}

static void compute_vertices(const nook_render_scene *s)
{
    uint32_t first_vertex = 0, first_joint = 0;
    nook_bind_storage(s->gpu, STORAGE_REST, s->deform.rest);
    nook_bind_storage(s->gpu, STORAGE_POSED, s->deform.posed);
    nook_bind_storage(s->gpu, STORAGE_INFLUENCES, s->deform.influences);
    nook_bind_storage(s->gpu, STORAGE_DELTAS, s->deform.deltas);
    nook_bind_storage(s->gpu, STORAGE_JOINTS, s->deform.joints);
    nook_bind_storage(s->gpu, STORAGE_WEIGHTS, s->deform.weights);
    nook_program_use(s->gpu, s->deform.program);
    for (uint32_t i = 0; i < s->scene->deformable_count; i++) {
        const nook_deformable *d = &s->scene->deformables[i];
        const uint32_t mesh[4] = { first_vertex, d->vertex_count, d->first_influence, first_joint };
        const uint32_t targets[4] = { d->target_count, d->first_weight, (uint32_t)d->first_delta, 0 };
        nook_uniform_uint(s->gpu, LOCATION_MESH, mesh, 4);
        nook_uniform_uint(s->gpu, LOCATION_TARGETS, targets, 4);
        nook_dispatch(s->gpu, s->deform.program, nook_groups(d->vertex_count, GROUP), 1, 1);
        first_vertex += d->vertex_count;
        first_joint += d->skin == NOOK_NONE ? 0 : s->scene->skins[d->skin].joint_count;
    }
}

static void compute_normals(const nook_render_scene *s)
{
    uint32_t first_vertex = 0, first_triangle = 0;
    nook_bind_storage(s->gpu, STORAGE_NORMALS, s->deform.normals);
    nook_bind_storage(s->gpu, STORAGE_INDICES, s->deform.indices);
    nook_program_use(s->gpu, s->deform.normals_program);
    for (uint32_t i = 0; i < s->scene->deformable_count; i++) {
        const nook_deformable *d = &s->scene->deformables[i];
        const nook_mesh *mesh = &s->scene->meshes[d->mesh];
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            const nook_primitive *primitive = &s->scene->primitives[mesh->first_primitive + p];
            uint32_t triangles = primitive->index_count / 3;
            const uint32_t numbers[4] = { first_triangle, triangles,
                                          first_vertex + (primitive->first_vertex - d->first_vertex),
                                          primitive->flat ? 1u : 0u };
            nook_uniform_uint(s->gpu, LOCATION_PRIMITIVE, numbers, 4);
            if (triangles > 0)
                nook_dispatch(s->gpu, s->deform.normals_program, nook_groups(triangles, GROUP), 1, 1);
            first_triangle += triangles;
        }
        first_vertex += d->vertex_count;
    }
}

/* Into the buffers of the whole scene, which may be larger than a shader can see. */
static void copy_results(const nook_render_scene *s)
{
    const nook_gl *gl = s->gpu->gl;
    size_t vertex = 0, triangle = 0;
    for (uint32_t i = 0; i < s->scene->deformable_count; i++) {
        const nook_deformable *d = &s->scene->deformables[i];
        const nook_mesh *mesh = &s->scene->meshes[d->mesh];
        gl->CopyNamedBufferSubData(s->deform.posed.id, s->vertices.id, (GLintptr)(vertex * sizeof(nook_vertex)),
                                   (GLintptr)(d->first_vertex * sizeof(nook_vertex)),
                                   (GLsizeiptr)(d->vertex_count * sizeof(nook_vertex)));
        vertex += d->vertex_count;
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            const render_primitive *primitive = &s->primitives[mesh->first_primitive + p];
            size_t count = primitive->index_count / 3, size = 3 * sizeof(float);
            if (count > 0)
                gl->CopyNamedBufferSubData(s->deform.normals.id, s->triangle_normals.id, (GLintptr)(triangle * size),
                                           (GLintptr)(primitive->first_triangle * size), (GLsizeiptr)(count * size));
            triangle += count;
        }
    }
}

void nook_render_scene_pose(nook_render_scene *s, const nook_mesh_pose *poses, uint32_t version)
{
    if (poses == NULL || s->scene->deformable_count == 0 || s->deform.version == version)
        return;
    update_numbers(s, poses);
    compute_vertices(s);
    compute_normals(s);
    copy_results(s);
    s->deform.version = version;
}

nook_buffer nook_render_scene_vertices(const nook_render_scene *scene)
{
    return scene->vertices;
}

nook_buffer nook_render_scene_indices(const nook_render_scene *scene)
{
    return scene->indices;
}

nook_texture nook_render_scene_base_colour(const nook_render_scene *scene, uint32_t material)
{
    return scene->material_images[material].images[UNIT_BASE_COLOUR_IMAGE];
}
