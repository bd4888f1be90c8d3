/* Volumes that are made anew on the GPU: three slicemaps, ORed (Papaioannou et al. 2010, section 4.2). What is marked is what
   modules/bake/voxelize.h marks, but for crumbs that cover no centre along any axis, and for rounding of floats. */
#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = NOOK_AO_LIVE_SIDE_MAX, LOCATION_ORIGIN = 0, LOCATION_SIZE = 1, GROUP = 8, RUN = 32 /* layers */ };

_Static_assert((int)SIDE <= (int)NOOK_SLICEMAP_SIDE_MAX, "a slicemap has a bit for each layer");

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static uint32_t most(const uint32_t size[3])
{
    uint32_t side = size[0] > size[1] ? size[0] : size[1];
    return side > size[2] ? side : size[2];
}

/* For grids of `side` voxels. */
static nook_result make_voxelizer(nook_ao *ao, uint32_t side)
{
    ao_voxelizer *v = &ao->voxelizer;
    nook_result result = NOOK_OK;
    for (int axis = 0; axis < 3 && result == NOOK_OK; axis++)
        result = nook_slicemap_fit(&v->slices[axis], ao->gpu, side);
    if (result == NOOK_OK)
        nook_slicer_fit(&v->slicer, ao->gpu);
    return result;
}

void ao_voxelizer_release(nook_ao *ao)
{
    ao_voxelizer *v = &ao->voxelizer;
    for (int axis = 0; axis < 3; axis++)
        nook_slicemap_release(&v->slices[axis], ao->gpu);
    nook_slicer_release(&v->slicer, ao->gpu);
}

nook_result nook_ao_add_live_volume(nook_ao *ao, const char *name, const uint32_t size[3], nook_ao_volume *out_volume)
{
    nook_volume volume = { .info = { .width = size[0], .height = size[1], .depth = size[2], .voxel_size = 1.0 } };
    for (int axis = 0; axis < 3; axis++)
        if (size[axis] < 3 || size[axis] > SIDE)
            return nook_fail(NOOK_E_RANGE, "%s: a live volume of %ux%ux%u voxels; each side must have 3 to %d", name,
                             size[0], size[1], size[2], SIDE);
    nook_result result = make_voxelizer(ao, most(size));
    if (result != NOOK_OK)
        return result;
    nook_ao_volume made;
    result = nook_ao_reserve_volume(ao, &made);
    if (result != NOOK_OK)
        return result;
    volume.voxels = calloc((size_t)size[0] * size[1] * size[2], 1);
    result = volume.voxels ? volume_atlas_add(&ao->atlases[NOOK_VOLUME_BINARY], made.id, &volume)
                           : nook_fail(NOOK_E_MEMORY, "%s: no memory for a live volume", name);
    nook_volume_free(&volume);
    if (result != NOOK_OK) {
        nook_ao_remove_volume(ao, made);
        return result;
    }
    volume_atlas_set_live(&ao->atlases[NOOK_VOLUME_BINARY], made.id);
    *out_volume = made;
    return NOOK_OK;
}

/* ---- Voxelising -------------------------------------------------------------------------------------------------- */

/* The grid stands still while the box moves in it: its corner is a whole number of voxels from the mesh's origin. */
static void fit_grid(const nook_ao_live_mesh *mesh, const atlas_box *room, nook_volume_info *info)
{
    uint32_t *sizes[3] = { &info->width, &info->height, &info->depth };
    info->voxel_size = mesh->voxel_size;
    for (int axis = 0; axis < 3; axis++) {
        double low = floor((double)mesh->box_min[axis] / mesh->voxel_size);
        double high = floor((double)mesh->box_max[axis] / mesh->voxel_size + 0.001); /* ties take the upper layer */
        double wanted = high - low + 3.0;                                            /* an empty voxel on both sides */
        *sizes[axis] = wanted < room->size[axis] ? (uint32_t)wanted : room->size[axis];
        info->origin[axis] = (low - 1.0) * mesh->voxel_size;
    }
}

/* Rows of voxel_from_part, in double until they are whole. */
static void place_part(const nook_volume_info *info, const nook_ao_live_part *part, nook_slice_mesh *out)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int column = 0; column < 3; column++)
            out->voxel_from_mesh[axis][column] = (float)(part->volume_from_part[column * 4 + axis] / info->voxel_size);
        out->voxel_from_mesh[axis][3] =
            (float)((part->volume_from_part[12 + axis] - info->origin[axis]) / info->voxel_size);
    }
}

static void draw_range(nook_slicing *slicing, const nook_ao_live_mesh *mesh, const nook_ao_triangle_range *triangles)
{
    const nook_ao_live_mask *mask = triangles->mask && mesh->masks ? &mesh->masks[triangles->mask - 1] : NULL;
    if (mask && mask->texture)
        nook_slicing_mask(slicing, &(nook_slice_mask){ mask->texture, mask->factor, mask->cutoff });
    else
        nook_slicing_mask(slicing, NULL);
    nook_slicing_draw(slicing, triangles->first_index, triangles->index_count, triangles->first_vertex);
}

static nook_result draw_slices(nook_ao *ao, const nook_volume_info *info, const nook_ao_live_mesh *mesh)
{
    nook_slice_mesh triangles = { .vertex_buffer = mesh->vertex_buffer,
                                  .vertex_stride = mesh->vertex_stride,
                                  .index_buffer = mesh->index_buffer,
                                  .uv_buffer = mesh->masks ? mesh->vertex_buffer : 0,
                                  .uv_offset = mesh->uv_offset,
                                  .uv_stride = mesh->vertex_stride };
    nook_slicing slicing;
    nook_result result = NOOK_OK;
    nook_slicing_begin(ao->gpu, &ao->voxelizer.slicer, &slicing);
    for (int32_t axis = 0; axis < 3 && result == NOOK_OK; axis++) {
        result = nook_slicing_map(&slicing, &ao->voxelizer.slices[axis], axis);
        for (uint32_t i = 0; i < mesh->part_count && result == NOOK_OK; i++) {
            const nook_ao_live_part *part = &mesh->parts[i];
            place_part(info, part, &triangles);
            nook_slicing_mesh(&slicing, &triangles);
            for (uint32_t r = 0; r < part->range_count; r++)
                draw_range(&slicing, mesh, &part->ranges[r]);
        }
    }
    nook_slicing_end(&slicing);
    return result;
}

static void merge_slices(nook_ao *ao, const atlas_entry *entry, nook_program program)
{
    const nook_volume_info *info = &entry->info;
    const int32_t size[3] = { (int32_t)info->width, (int32_t)info->height, (int32_t)info->depth };
    const int32_t origin[3] = { (int32_t)entry->box.origin[0], (int32_t)entry->box.origin[1],
                                (int32_t)entry->box.origin[2] };
    for (uint32_t axis = 0; axis < 3; axis++) {
        ao->gpu->gl->BindSampler(axis, 0); /* no whole numbers can be read through a host's that filters */
        nook_bind_texture(ao->gpu, axis, ao->voxelizer.slices[axis].bits);
    }
    nook_bind_image(ao->gpu, 0, ao->atlases[NOOK_VOLUME_BINARY].texture, GL_WRITE_ONLY);
    nook_program_use(ao->gpu, program);
    nook_uniform_int(ao->gpu, LOCATION_ORIGIN, origin, 3);
    nook_uniform_int(ao->gpu, LOCATION_SIZE, size, 3);
    nook_dispatch(ao->gpu, program, nook_groups(info->width, GROUP), nook_groups(info->height, GROUP),
                  nook_groups(info->depth, RUN));
}

static nook_result check_mesh(const nook_ao_live_mesh *mesh)
{
    if (!(mesh->voxel_size > 0.0) || !isfinite(mesh->voxel_size))
        return nook_fail(NOOK_E_ARG, "voxels of %g m; their side must be above 0", mesh->voxel_size);
    for (int axis = 0; axis < 3; axis++)
        if (mesh->box_max[axis] < mesh->box_min[axis])
            return nook_fail(NOOK_E_ARG, "a live mesh whose box goes from %g down to %g m: it has no vertices",
                             (double)mesh->box_min[axis], (double)mesh->box_max[axis]);
    return NOOK_OK;
}

nook_result nook_ao_voxelize(nook_ao *ao, nook_ao_volume volume, const nook_ao_live_mesh *mesh)
{
    nook_program merge;
    const atlas_entry *entry = volume_atlas_find(&ao->atlases[NOOK_VOLUME_BINARY], volume.id);
    if (!entry || !entry->live)
        return nook_fail(NOOK_E_ARG, "volume %u is %s", volume.id,
                         entry ? "not a live one, to be made anew" : "not there to be made anew");
    nook_result result = check_mesh(mesh);
    if (result == NOOK_OK)
        result = nook_program_compute(ao->gpu, "shaders/ao/voxel_merge.comp.glsl", "", &merge);
    if (result == NOOK_OK)
        result = volume_atlas_flush(&ao->atlases[NOOK_VOLUME_BINARY]);
    if (result != NOOK_OK)
        return result;
    nook_volume_info info = entry->info;
    fit_grid(mesh, &entry->box, &info);
    volume_atlas_set_info(&ao->atlases[NOOK_VOLUME_BINARY], volume.id, &info);
    result = draw_slices(ao, &info, mesh);
    if (result != NOOK_OK)
        return result;
    merge_slices(ao, entry, merge);
    volume_atlas_note(&ao->atlases[NOOK_VOLUME_BINARY], &entry->box);
    return NOOK_OK;
}
