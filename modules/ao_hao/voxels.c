#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "modules/ao_hao/voxels_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ALONG_Z = 2 };

void hao_voxels_release(hao_voxels *voxels, nook_gpu *gpu)
{
    for (int axis = 0; axis < 3; axis++)
        nook_slicemap_release(&voxels->maps[axis], gpu);
    nook_slicer_release(&voxels->slicer, gpu);
    free(voxels->drawn);
    *voxels = (hao_voxels){ .holds = false };
}

/* ---- is it what is wanted? ---- */

static hao_view view_of(const nook_ao_pass *pass, uint32_t map_count, double far)
{
    hao_view view = { .r_max = pass->r_max, .far = far };
    nook_matrix world_from_view, axes = map_count == 1 ? hao_diagonal_axes() : nook_matrix_identity();
    nook_matrix_inverse_affine(&pass->view_from_world, &world_from_view);
    view.grid_from_view = nook_matrix_multiply(&axes, &world_from_view);
    memcpy(view.ray_scale, pass->ray_scale, sizeof view.ray_scale);
    memcpy(view.ray_offset, pass->ray_offset, sizeof view.ray_offset);
    return view;
}

static bool same_view(const hao_view *a, const hao_view *b)
{
    return memcmp(&a->grid_from_view, &b->grid_from_view, sizeof a->grid_from_view) == 0 &&
           memcmp(a->ray_scale, b->ray_scale, sizeof a->ray_scale) == 0 &&
           memcmp(a->ray_offset, b->ray_offset, sizeof a->ray_offset) == 0 && a->r_max == b->r_max && a->far == b->far;
}

static bool is_made_of(const hao_voxels *voxels, const hao_source *source, const nook_ao_pass *pass)
{
    const hao_source *old = &voxels->source;
    if (!voxels->holds || old->resolution != source->resolution || old->map_count != source->map_count ||
        old->shader_version != source->shader_version || old->instance_count != source->instance_count ||
        !same_view(&old->view, &source->view))
        return false;
    for (uint32_t i = 0; i < source->instance_count; i++) {
        const nook_ao_mesh_instance *instance = &pass->instances[i];
        if (voxels->drawn[i].id != pass->meshes[instance->mesh].id ||
            memcmp(&voxels->drawn[i].view_from_mesh, &instance->view_from_mesh, sizeof(nook_matrix)) != 0)
            return false;
    }
    return true;
}

static nook_result remember(hao_voxels *voxels, const hao_source *source, const nook_ao_pass *pass)
{
    if (voxels->drawn_capacity < source->instance_count) {
        uint32_t capacity = source->instance_count + source->instance_count / 2;
        hao_drawn *drawn = realloc(voxels->drawn, capacity * sizeof *drawn);
        if (!drawn)
            return nook_fail(NOOK_E_MEMORY, "hao: no memory for %u instances", source->instance_count);
        voxels->drawn = drawn;
        voxels->drawn_capacity = capacity;
    }
    for (uint32_t i = 0; i < source->instance_count; i++)
        voxels->drawn[i] = (hao_drawn){ pass->meshes[pass->instances[i].mesh].id, pass->instances[i].view_from_mesh };
    voxels->source = *source;
    return NOOK_OK;
}

/* ---- making it ---- */

static hao_box box_of_instance(const hao_view *view, const hao_meshes *meshes, const nook_ao_mesh_instance *instance)
{
    nook_matrix grid_from_mesh = nook_matrix_multiply(&view->grid_from_view, &instance->view_from_mesh);
    return hao_box_transform(&meshes->items[instance->mesh].box, &grid_from_mesh);
}

/* What covers less than a pixel with all its reach occludes nothing that is seen; far off it would make the grid vast for nothing. */
static bool is_seen_to_occlude(const hao_box *box, const hao_view *view, const nook_ao_pass *pass)
{
    const double origin[3] = { 0 };
    double eye[3], centre[3], half[3], footprint = 2.0 * fabs(view->ray_scale[1]) / pass->height;
    nook_matrix_apply_point(&view->grid_from_view, origin, eye);
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = 0.5 * (box->min[axis] + box->max[axis]) - eye[axis];
        half[axis] = 0.5 * (box->max[axis] - box->min[axis]);
    }
    return 2.0 * (nook_vector_length(half) + view->r_max) >= footprint * nook_vector_length(centre);
}

static hao_box box_of_scene(const hao_view *view, const hao_meshes *meshes, const nook_ao_pass *pass)
{
    hao_box scene = hao_nothing;
    for (uint32_t i = 0; i < pass->instance_count; i++) {
        hao_box box = box_of_instance(view, meshes, &pass->instances[i]);
        if (is_seen_to_occlude(&box, view, pass))
            hao_box_add(&scene, &box);
    }
    return scene;
}

static void draw_instance(nook_slicing *slicing, const hao_grid *grid, const hao_mesh *mesh,
                          const nook_matrix *view_from_mesh)
{
    nook_slice_mesh triangles = { .vertex_buffer = mesh->vertices.id,
                                  .vertex_stride = 3 * sizeof(float),
                                  .index_buffer = mesh->indices.id,
                                  .uv_buffer = mesh->uvs.id,
                                  .uv_stride = 2 * sizeof(float) };
    nook_matrix voxel_from_mesh = nook_matrix_multiply(&grid->voxel_from_view, view_from_mesh);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            triangles.voxel_from_mesh[row][column] = (float)voxel_from_mesh.m[column * 4 + row];
    nook_slicing_mesh(slicing, &triangles);
    for (uint32_t i = 0; i < mesh->range_count; i++) {
        const hao_range *range = &mesh->ranges[i];
        const nook_slice_mask mask = { range->texture ? range->texture->id : 0, range->factor, range->cutoff };
        nook_slicing_mask(slicing, range->texture ? &mask : NULL);
        nook_slicing_draw(slicing, range->first_index, range->index_count, 0);
    }
}

static nook_result draw_map(const hao_voxels *voxels, nook_slicing *slicing, int axis, const nook_ao_pass *pass,
                            const hao_meshes *meshes)
{
    nook_result result = nook_slicing_map(slicing, &voxels->maps[axis], axis);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < pass->instance_count; i++) {
        const nook_ao_mesh_instance *instance = &pass->instances[i];
        hao_box box = box_of_instance(&voxels->source.view, meshes, instance);
        hao_box_cut(&box, &voxels->grid.box);
        if (!hao_box_is_empty(&box))
            draw_instance(slicing, &voxels->grid, &meshes->items[instance->mesh], &instance->view_from_mesh);
    }
    return NOOK_OK;
}

static nook_result make_room(hao_voxels *voxels, nook_gpu *gpu, const hao_source *source)
{
    nook_result result = NOOK_OK;
    for (int axis = source->map_count == 1 ? ALONG_Z : 0; axis < 3 && result == NOOK_OK; axis++)
        result = nook_slicemap_fit(&voxels->maps[axis], gpu, source->resolution);
    if (result == NOOK_OK)
        nook_slicer_fit(&voxels->slicer, gpu);
    return result;
}

static nook_result draw(const hao_voxels *voxels, const nook_ao_pass *pass, const hao_meshes *meshes)
{
    nook_slicing slicing;
    nook_result result = NOOK_OK;
    nook_slicing_begin(pass->gpu, &voxels->slicer, &slicing);
    for (int axis = voxels->source.map_count == 1 ? ALONG_Z : 0; axis < 3 && result == NOOK_OK; axis++)
        result = draw_map(voxels, &slicing, axis, pass, meshes);
    nook_slicing_end(&slicing);
    return result;
}

nook_result hao_voxels_update(hao_voxels *voxels, const nook_ao_pass *pass, const hao_meshes *meshes,
                              uint32_t resolution, uint32_t map_count, double far)
{
    hao_source source = { .view = view_of(pass, map_count, far),
                          .resolution = resolution,
                          .map_count = map_count,
                          .instance_count = pass->instance_count };
    nook_result result = make_room(voxels, pass->gpu, &source);
    if (result == NOOK_OK)
        result = nook_slicemap_shader_version(&voxels->maps[ALONG_Z], pass->gpu, &source.shader_version);
    if (result != NOOK_OK || is_made_of(voxels, &source, pass))
        return result;
    voxels->holds = false;
    result = remember(voxels, &source, pass);
    if (result != NOOK_OK)
        return result;
    hao_box scene = box_of_scene(&source.view, meshes, pass);
    hao_grid_place(&source.view, &scene, resolution, &voxels->grid);
    if (voxels->grid.size[0] > 0)
        result = draw(voxels, pass, meshes);
    voxels->holds = result == NOOK_OK;
    return result;
}
