#include "modules/ao/slicemap.h"
#include <assert.h>
#include <stdio.h>

enum { LOCATION_ROWS = 0 /* to 2 */, LOCATION_AXIS = 3, LOCATION_SIDE = 4, LOCATION_ALPHA = 5 };
enum { OPAQUE, MASKED, NEITHER };

nook_result nook_slicemap_fit(nook_slicemap *map, nook_gpu *gpu, uint32_t side)
{
    assert(side >= 1 && side <= NOOK_SLICEMAP_SIDE_MAX);
    if (map->bits.id && map->bits.width >= side)
        return NOOK_OK;
    nook_slicemap_release(map, gpu);
    nook_result result = nook_texture_create_3d(gpu, GL_RGBA32UI, side, side, nook_groups(side, NOOK_SLICEMAP_BITS),
                                                GL_NEAREST, &map->bits);
    if (result == NOOK_OK)
        result = nook_framebuffer_create_slices(gpu, map->bits, &map->target);
    if (result != NOOK_OK)
        nook_slicemap_release(map, gpu);
    return result;
}

void nook_slicemap_release(nook_slicemap *map, nook_gpu *gpu)
{
    nook_framebuffer_destroy(gpu, &map->target);
    nook_texture_destroy(gpu, &map->bits);
}

static nook_result slice_program(const nook_slicemap *map, nook_gpu *gpu, int masked, nook_program *out_program)
{
    char defines[64];
    snprintf(defines, sizeof defines, "#define TEXELS %u\n%s", map->bits.depth, masked ? "#define MASKED\n" : "");
    return nook_program_raster(gpu, "shaders/ao/voxel_slice.vert.glsl", "shaders/ao/voxel_slice.frag.glsl", defines,
                               out_program);
}

nook_result nook_slicemap_shader_version(const nook_slicemap *map, nook_gpu *gpu, uint32_t *out_version)
{
    nook_program programs[2];
    nook_result result = slice_program(map, gpu, OPAQUE, &programs[OPAQUE]);
    if (result == NOOK_OK)
        result = slice_program(map, gpu, MASKED, &programs[MASKED]);
    if (result == NOOK_OK)
        *out_version = nook_program_version(gpu, programs[OPAQUE]) + nook_program_version(gpu, programs[MASKED]);
    return result;
}

static GLuint make_vertex_array(const nook_gl *gl)
{
    GLuint name;
    gl->CreateVertexArrays(1, &name);
    gl->EnableVertexArrayAttrib(name, 0);
    gl->VertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl->VertexArrayAttribBinding(name, 0, 0);
    gl->VertexArrayAttribFormat(name, 1, 2, GL_FLOAT, GL_FALSE, 0);
    gl->VertexArrayAttribBinding(name, 1, 1);
    return name;
}

static GLuint make_mask_sampler(const nook_gl *gl)
{
    GLuint name;
    gl->CreateSamplers(1, &name);
    gl->SamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->SamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return name;
}

void nook_slicer_fit(nook_slicer *slicer, nook_gpu *gpu)
{
    if (!slicer->vertex_array)
        slicer->vertex_array = make_vertex_array(gpu->gl);
    if (!slicer->mask_sampler)
        slicer->mask_sampler = make_mask_sampler(gpu->gl);
}

void nook_slicer_release(nook_slicer *slicer, nook_gpu *gpu)
{
    if (slicer->vertex_array)
        gpu->gl->DeleteVertexArrays(1, &slicer->vertex_array);
    if (slicer->mask_sampler)
        gpu->gl->DeleteSamplers(1, &slicer->mask_sampler);
    *slicer = (nook_slicer){ 0 };
}

void nook_slicing_begin(nook_gpu *gpu, const nook_slicer *slicer, nook_slicing *out_slicing)
{
    const nook_gl *gl = gpu->gl;
    nook_slicing slicing = { .gpu = gpu, .slicer = *slicer };
    nook_draw_state_take(gpu, &slicing.host);
    gl->Enable(GL_COLOR_LOGIC_OP);
    gl->LogicOp(GL_OR);
    gl->BindVertexArray(slicer->vertex_array);
    gl->BindSampler(NOOK_SLICING_UNIT, slicer->mask_sampler);
    *out_slicing = slicing;
}

nook_result nook_slicing_map(nook_slicing *slicing, const nook_slicemap *map, int32_t axis)
{
    nook_gpu *gpu = slicing->gpu;
    const GLuint zero[4] = { 0 };
    nook_result result = slice_program(map, gpu, OPAQUE, &slicing->programs[OPAQUE]);
    if (result == NOOK_OK)
        result = slice_program(map, gpu, MASKED, &slicing->programs[MASKED]);
    if (result != NOOK_OK)
        return result;
    slicing->axis = axis;
    slicing->side = (float)map->bits.width;
    for (GLint i = 0; i < (GLint)map->bits.depth; i++)
        gpu->gl->ClearNamedFramebufferuiv(map->target.id, GL_COLOR, i, zero);
    nook_framebuffer_bind(gpu, map->target);
    return NOOK_OK;
}

void nook_slicing_mesh(nook_slicing *slicing, const nook_slice_mesh *mesh)
{
    const nook_gl *gl = slicing->gpu->gl;
    gl->VertexArrayVertexBuffer(slicing->slicer.vertex_array, 0, mesh->vertex_buffer, 0, (GLsizei)mesh->vertex_stride);
    gl->VertexArrayElementBuffer(slicing->slicer.vertex_array, mesh->index_buffer);
    if (mesh->uv_buffer)
        gl->VertexArrayVertexBuffer(slicing->slicer.vertex_array, 1, mesh->uv_buffer, (GLintptr)mesh->uv_offset,
                                    (GLsizei)mesh->uv_stride);
    slicing->mesh = *mesh;
    slicing->used = NEITHER;
    nook_slicing_mask(slicing, NULL);
}

/* Uniforms are a program's own, and programs may be shared: all are set. */
void nook_slicing_mask(nook_slicing *slicing, const nook_slice_mask *mask)
{
    nook_gpu *gpu = slicing->gpu;
    assert(!mask || slicing->mesh.uv_buffer);
    if (!mask && slicing->used == OPAQUE)
        return;
    slicing->used = mask ? MASKED : OPAQUE;
    nook_program_use(gpu, slicing->programs[mask ? MASKED : OPAQUE]);
    nook_uniform_int(gpu, LOCATION_AXIS, &slicing->axis, 1);
    nook_uniform_float(gpu, LOCATION_SIDE, &slicing->side, 1);
    for (uint32_t row = 0; row < 3; row++)
        nook_uniform_float(gpu, LOCATION_ROWS + row, slicing->mesh.voxel_from_mesh[row], 4);
    if (mask) {
        gpu->gl->EnableVertexArrayAttrib(slicing->slicer.vertex_array, 1);
        nook_uniform_float(gpu, LOCATION_ALPHA, (const float[]){ mask->factor, mask->cutoff }, 2);
        nook_bind_texture(gpu, NOOK_SLICING_UNIT, (nook_texture){ .id = mask->texture });
    } else {
        gpu->gl->DisableVertexArrayAttrib(slicing->slicer.vertex_array, 1);
    }
}

void nook_slicing_draw(const nook_slicing *slicing, uint32_t first_index, uint32_t index_count, uint32_t first_vertex)
{
    slicing->gpu->gl->DrawElementsBaseVertex(GL_TRIANGLES, (GLsizei)index_count, GL_UNSIGNED_INT,
                                             (const void *)((uintptr_t)first_index * sizeof(uint32_t)),
                                             (GLint)first_vertex);
}

void nook_slicing_end(const nook_slicing *slicing)
{
    slicing->gpu->gl->BindSampler(NOOK_SLICING_UNIT, 0);
    nook_draw_state_give_back(slicing->gpu, &slicing->host);
}
