#include "modules/ao_volume/corners.h"
#include "engine/core/log.h"
#include <stdbool.h>

enum { TILE_SIZE = 8, CELLS_PER_INVOCATION = 4, BINDING_ATLAS = 2, LOCATION_BEGIN = 0, LOCATION_END = 1 };

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

/* Of a box: its own cells, and those before it, which read its first voxels. */
static void make(volume_corners *corners, nook_gpu *gpu, nook_program program, const nook_ao_box *box)
{
    int32_t begin[3], end[3];
    for (int axis = 0; axis < 3; axis++) {
        begin[axis] = box->origin[axis] > 0 ? (int32_t)box->origin[axis] - 1 : 0;
        end[axis] = (int32_t)(box->origin[axis] + box->size[axis]);
    }
    nook_bind_image(gpu, 0, corners->texture, GL_WRITE_ONLY);
    nook_program_use(gpu, program);
    nook_uniform_int(gpu, LOCATION_BEGIN, begin, 3);
    nook_uniform_int(gpu, LOCATION_END, end, 3);
    nook_dispatch(gpu, program,
                  nook_groups(nook_groups((uint32_t)(end[0] - begin[0]), CELLS_PER_INVOCATION), TILE_SIZE),
                  nook_groups((uint32_t)(end[1] - begin[1]), TILE_SIZE), (uint32_t)(end[2] - begin[2]));
}

nook_result volume_corners_fit(volume_corners *corners, const nook_ao_pass *pass)
{
    nook_gpu *gpu = pass->gpu;
    const nook_texture *atlas = &pass->volume_atlas;
    nook_program program;
    if (corners->texture.id != 0 && corners->version == pass->volume_atlas_version)
        return NOOK_OK;
    /* Nobody reads between the boxes of volumes. The first version has changed wherever there is something. */
    bool follows =
        corners->version + 1 == pass->volume_atlas_version && pass->volume_atlas_change_count != NOOK_AO_CHANGED_ALL;
    nook_result result = make_room(corners, pass);
    if (result == NOOK_OK)
        result = nook_program_compute(gpu, "shaders/ao/corners.comp.glsl", "", &program);
    if (result != NOOK_OK) {
        volume_corners_release(corners, gpu);
        return result;
    }
    nook_bind_texture(gpu, BINDING_ATLAS, *atlas);
    if (!follows)
        make(corners, gpu, program, &(nook_ao_box){ { 0, 0, 0 }, { atlas->width, atlas->height, atlas->depth } });
    for (uint32_t i = 0; follows && i < pass->volume_atlas_change_count; i++)
        make(corners, gpu, program, &pass->volume_atlas_changes[i]);
    corners->version = pass->volume_atlas_version;
    return NOOK_OK;
}
