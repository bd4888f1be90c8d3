/** corners.h - the atlas of binary volumes as one byte for every cell between eight voxels; of the technique "volume". */
#pragma once
#include "modules/ao/technique.h"

/** Zero before the first use. */
typedef struct volume_corners {
    nook_texture
        texture; /**< Texture buffer R8UI, cells in the order of the atlas' voxels: shaders/ao/corners.comp.glsl. */
    nook_buffer buffer;
    uint32_t version; /**< Of the atlas that it was made of. */
} volume_corners;

/**
 * Makes it fit the pass' atlas; does nothing when it does. Uses image unit 0 and texture unit 2.
 * @return NOOK_E_RANGE the atlas has more voxels than a texture buffer of this device can have; NOOK_E_MEMORY, NOOK_E_NOT_FOUND
 */
nook_result volume_corners_fit(volume_corners *corners, const nook_ao_pass *pass);
void volume_corners_release(volume_corners *corners, nook_gpu *gpu);
