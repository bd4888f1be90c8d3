/* Volumes that are made anew on the GPU: three slicemaps, ORed (Papaioannou et al. 2010, section 4.2). What is marked is what
   modules/bake/voxelize.h marks, but for crumbs that cover no centre along any axis, and for rounding of floats. */
#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = NOOK_AO_LIVE_SIDE_MAX,
    LOCATION_GRID = 0,
    LOCATION_AXIS = 1,
    LOCATION_SIDE = 2,
    LOCATION_ORIGIN = 0,
    LOCATION_SIZE = 1,
    GROUP = 4,
};

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static nook_result make_voxelizer(nook_ao *ao)
{
    ao_voxelizer *v = &ao->voxelizer;
    const nook_gl *gl = ao->gpu->gl;
    nook_result result = NOOK_OK;
    for (int axis = 0; axis < 3 && result == NOOK_OK; axis++) {
        if (v->slices[axis].id)
            continue;
        result = nook_texture_create_2d(ao->gpu, GL_RGBA32UI, SIDE, SIDE, GL_NEAREST, &v->slices[axis]);
        if (result == NOOK_OK)
            result = nook_framebuffer_create(ao->gpu, &v->slices[axis], 1, (nook_texture){ 0 }, &v->targets[axis]);
    }
    if (result != NOOK_OK || v->vertex_array)
        return result;
    gl->CreateVertexArrays(1, &v->vertex_array);
    gl->EnableVertexArrayAttrib(v->vertex_array, 0);
    gl->VertexArrayAttribFormat(v->vertex_array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl->VertexArrayAttribBinding(v->vertex_array, 0, 0);
    return NOOK_OK;
}

void ao_voxelizer_release(nook_ao *ao)
{
    ao_voxelizer *v = &ao->voxelizer;
    for (int axis = 0; axis < 3; axis++) {
        nook_framebuffer_destroy(ao->gpu, &v->targets[axis]);
        nook_texture_destroy(ao->gpu, &v->slices[axis]);
    }
    if (v->vertex_array)
        ao->gpu->gl->DeleteVertexArrays(1, &v->vertex_array);
    *v = (ao_voxelizer){ .vertex_array = 0 };
}

nook_result nook_ao_add_live_volume(nook_ao *ao, const char *name, const uint32_t size[3], nook_ao_volume *out_volume)
{
    nook_volume volume = { .info = { .width = size[0], .height = size[1], .depth = size[2], .voxel_size = 1.0 } };
    for (int axis = 0; axis < 3; axis++)
        if (size[axis] < 3 || size[axis] > SIDE)
            return nook_fail(NOOK_E_RANGE, "%s: a live volume of %ux%ux%u voxels; each side must have 3 to %d", name,
                             size[0], size[1], size[2], SIDE);
    nook_result result = make_voxelizer(ao);
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
    if (result == NOOK_OK)
        *out_volume = made;
    else
        nook_ao_remove_volume(ao, made);
    return result;
}

/* ---- Voxelising -------------------------------------------------------------------------------------------------- */

/* GL's state that rasterising needs otherwise than a host may have it. */
typedef struct kept_state {
    GLint framebuffer, viewport[4];
    GLboolean enabled[5];
} kept_state;

static const GLenum switches[5] = { GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_BLEND, GL_STENCIL_TEST };

static kept_state begin_raster(const nook_gl *gl)
{
    kept_state kept;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &kept.framebuffer);
    gl->GetIntegerv(GL_VIEWPORT, kept.viewport);
    for (int i = 0; i < 5; i++) {
        kept.enabled[i] = gl->IsEnabled(switches[i]);
        gl->Disable(switches[i]);
    }
    gl->Enable(GL_COLOR_LOGIC_OP);
    gl->LogicOp(GL_OR);
    return kept;
}

static void end_raster(const nook_gl *gl, const kept_state *kept)
{
    gl->Disable(GL_COLOR_LOGIC_OP);
    gl->LogicOp(GL_COPY);
    for (int i = 0; i < 5; i++)
        if (kept->enabled[i])
            gl->Enable(switches[i]);
    gl->BindVertexArray(0);
    gl->BindFramebuffer(GL_FRAMEBUFFER, (GLuint)kept->framebuffer);
    gl->Viewport(kept->viewport[0], kept->viewport[1], kept->viewport[2], kept->viewport[3]);
}

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

static void draw_slices(nook_ao *ao, const nook_volume_info *info, const nook_ao_live_mesh *mesh, nook_program program)
{
    const nook_gl *gl = ao->gpu->gl;
    const ao_voxelizer *v = &ao->voxelizer;
    const GLuint zero[4] = { 0 };
    const float side = SIDE, grid[4] = { (float)info->origin[0], (float)info->origin[1], (float)info->origin[2],
                                         (float)(1.0 / info->voxel_size) };
    gl->VertexArrayVertexBuffer(v->vertex_array, 0, mesh->vertex_buffer, 0, (GLsizei)mesh->vertex_stride);
    gl->VertexArrayElementBuffer(v->vertex_array, mesh->index_buffer);
    gl->BindVertexArray(v->vertex_array);
    nook_program_use(ao->gpu, program);
    nook_uniform_float(ao->gpu, LOCATION_GRID, grid, 4);
    nook_uniform_float(ao->gpu, LOCATION_SIDE, &side, 1);
    for (int32_t axis = 0; axis < 3; axis++) {
        gl->ClearNamedFramebufferuiv(v->targets[axis].id, GL_COLOR, 0, zero);
        nook_framebuffer_bind(ao->gpu, v->targets[axis]);
        nook_uniform_int(ao->gpu, LOCATION_AXIS, &axis, 1);
        for (uint32_t i = 0; i < mesh->range_count; i++) {
            const nook_ao_triangle_range *part = &mesh->ranges[i];
            gl->DrawElementsBaseVertex(GL_TRIANGLES, (GLsizei)part->index_count, GL_UNSIGNED_INT,
                                       (const void *)((uintptr_t)part->first_index * sizeof(uint32_t)),
                                       (GLint)part->first_vertex);
        }
    }
}

static void merge_slices(nook_ao *ao, const atlas_entry *entry, nook_program program)
{
    const nook_volume_info *info = &entry->info;
    const int32_t size[3] = { (int32_t)info->width, (int32_t)info->height, (int32_t)info->depth };
    const int32_t origin[3] = { (int32_t)entry->box.origin[0], (int32_t)entry->box.origin[1],
                                (int32_t)entry->box.origin[2] };
    for (uint32_t axis = 0; axis < 3; axis++)
        nook_bind_texture(ao->gpu, axis, ao->voxelizer.slices[axis]);
    nook_bind_image(ao->gpu, 0, ao->atlases[NOOK_VOLUME_BINARY].texture, GL_WRITE_ONLY);
    nook_program_use(ao->gpu, program);
    nook_uniform_int(ao->gpu, LOCATION_ORIGIN, origin, 3);
    nook_uniform_int(ao->gpu, LOCATION_SIZE, size, 3);
    nook_dispatch(ao->gpu, program, nook_groups(info->width, GROUP), nook_groups(info->height, GROUP),
                  nook_groups(info->depth, GROUP));
}

nook_result nook_ao_voxelize(nook_ao *ao, nook_ao_volume volume, const nook_ao_live_mesh *mesh)
{
    nook_program slice, merge;
    const atlas_entry *entry = volume_atlas_find(&ao->atlases[NOOK_VOLUME_BINARY], volume.id);
    if (!entry)
        return nook_fail(NOOK_E_ARG, "volume %u is not there to be made anew", volume.id);
    if (!(mesh->voxel_size > 0.0) || !isfinite(mesh->voxel_size))
        return nook_fail(NOOK_E_ARG, "voxels of %g m; their side must be above 0", mesh->voxel_size);
    nook_result result = nook_program_raster(ao->gpu, "shaders/ao/voxel_slice.vert.glsl",
                                             "shaders/ao/voxel_slice.frag.glsl", "", &slice);
    if (result == NOOK_OK)
        result = nook_program_compute(ao->gpu, "shaders/ao/voxel_merge.comp.glsl", "", &merge);
    if (result == NOOK_OK)
        result = volume_atlas_flush(&ao->atlases[NOOK_VOLUME_BINARY]);
    if (result != NOOK_OK)
        return result;
    nook_volume_info info = entry->info;
    fit_grid(mesh, &entry->box, &info);
    volume_atlas_set_info(&ao->atlases[NOOK_VOLUME_BINARY], volume.id, &info);
    kept_state kept = begin_raster(ao->gpu->gl);
    draw_slices(ao, &info, mesh, slice);
    end_raster(ao->gpu->gl, &kept);
    merge_slices(ao, entry, merge);
    return NOOK_OK;
}
