#include "modules/ao/ao_internal.h"

void ao_targets_release(nook_gpu *gpu, ao_targets *targets)
{
    nook_texture *all[] = { &targets->depth,       &targets->normal,       &targets->visibility,
                            &targets->trace_depth, &targets->trace_normal, &targets->trace_visibility };
    for (size_t i = 0; i < NOOK_COUNT(all); i++)
        nook_texture_destroy(gpu, all[i]);
    *targets = (ao_targets){ 0 };
}

static nook_result create_set(nook_gpu *gpu, uint32_t width, uint32_t height, nook_texture *depth, nook_texture *normal)
{
    nook_result result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, depth);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_RG16, width, height, GL_NEAREST, normal);
    return result;
}

nook_result ao_targets_fit(nook_gpu *gpu, ao_targets *targets, uint32_t width, uint32_t height, uint32_t scale)
{
    if (targets->width == width && targets->height == height && targets->scale == scale)
        return NOOK_OK;
    ao_targets_release(gpu, targets);
    uint32_t trace_width = nook_groups(width, scale), trace_height = nook_groups(height, scale);
    nook_result result = create_set(gpu, width, height, &targets->depth, &targets->normal);
    if (result == NOOK_OK && scale > 1)
        result = create_set(gpu, trace_width, trace_height, &targets->trace_depth, &targets->trace_normal);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &targets->visibility);
    if (result == NOOK_OK)
        result =
            nook_texture_create_2d(gpu, GL_R32F, trace_width, trace_height, GL_NEAREST, &targets->trace_visibility);
    if (result != NOOK_OK) {
        ao_targets_release(gpu, targets);
        return result;
    }
    targets->width = width, targets->height = height, targets->scale = scale;
    return NOOK_OK;
}
