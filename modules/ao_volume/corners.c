#include "modules/ao_volume/corners.h"
#include "engine/core/log.h"

enum { TILE_SIZE = 8, CELLS_PER_INVOCATION = 4, BINDING_ATLAS = 2 };

void volume_corners_release(volume_corners *corners, nook_gpu *gpu)
{
    nook_texture_destroy(gpu, &corners->texture);
    nook_buffer_destroy(gpu, &corners->buffer);
    *corners = (volume_corners){ 0 };
}

static nook_result make_room(volume_corners *corners, const nook_ao_pass *pass)
{
    nook_gpu *gpu = pass->gpu;
    const nook_texture *atlas = &pass->volume_atlas;
    size_t voxels = (size_t)atlas->width * atlas->height * atlas->depth;
    if (corners->buffer.size == voxels)
        return NOOK_OK;
    volume_corners_release(corners, gpu);
    if (voxels > gpu->max_texture_buffer_size)
        return nook_fail(NOOK_E_RANGE, "volume.sampling: corners of %zu voxels; this device takes %u: set it to filter",
                         voxels, gpu->max_texture_buffer_size);
    nook_result result = nook_buffer_create(gpu, NULL, voxels, &corners->buffer);
    return result == NOOK_OK ? nook_texture_create_buffer(gpu, GL_R8UI, corners->buffer, &corners->texture) : result;
}

nook_result volume_corners_fit(volume_corners *corners, const nook_ao_pass *pass)
{
    nook_gpu *gpu = pass->gpu;
    const nook_texture *atlas = &pass->volume_atlas;
    nook_program program;
    if (corners->texture.id != 0 && corners->version == pass->volume_atlas_version)
        return NOOK_OK;
    nook_result result = make_room(corners, pass);
    if (result == NOOK_OK)
        result = nook_program_compute(gpu, "shaders/ao/corners.comp.glsl", "", &program);
    if (result != NOOK_OK) {
        volume_corners_release(corners, gpu);
        return result;
    }
    nook_bind_texture(gpu, BINDING_ATLAS, *atlas);
    nook_bind_image(gpu, 0, corners->texture, GL_WRITE_ONLY);
    nook_dispatch(gpu, program, nook_groups(nook_groups(atlas->width, CELLS_PER_INVOCATION), TILE_SIZE),
                  nook_groups(atlas->height, TILE_SIZE), atlas->depth);
    corners->version = pass->volume_atlas_version;
    return NOOK_OK;
}
