#include "modules/ao/ao_internal.h"

static void destroy_trace(nook_gpu *gpu, ao_targets *targets)
{
    nook_texture_destroy(gpu, &targets->trace_depth);
    nook_texture_destroy(gpu, &targets->trace_normal);
    nook_texture_destroy(gpu, &targets->trace_visibility);
    nook_texture_destroy(gpu, &targets->trace_filtered);
    targets->scale = 0;
}

void ao_targets_release(nook_gpu *gpu, ao_targets *targets)
{
    destroy_trace(gpu, targets);
    nook_texture_destroy(gpu, &targets->depth);
    nook_texture_destroy(gpu, &targets->normal);
    nook_texture_destroy(gpu, &targets->visibility);
    *targets = (ao_targets){ 0 };
}

static nook_result create_inputs(nook_gpu *gpu, uint32_t width, uint32_t height, nook_texture *depth,
                                 nook_texture *normal)
{
    nook_result result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, depth);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_RG16, width, height, GL_NEAREST, normal);
    return result;
}

static nook_result fit_full(nook_gpu *gpu, ao_targets *targets, uint32_t width, uint32_t height)
{
    if (targets->width == width && targets->height == height)
        return NOOK_OK;
    ao_targets_release(gpu, targets);
    nook_result result = create_inputs(gpu, width, height, &targets->depth, &targets->normal);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &targets->visibility);
    targets->width = width, targets->height = height;
    return result;
}

/** Apart from the full-size ones, so that the host's visibility keeps its name when only the scale changes. */
static nook_result fit_trace(nook_gpu *gpu, ao_targets *targets, uint32_t scale)
{
    if (targets->scale == scale)
        return NOOK_OK;
    destroy_trace(gpu, targets);
    uint32_t width = nook_groups(targets->width, scale), height = nook_groups(targets->height, scale);
    nook_result result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &targets->trace_visibility);
    if (result == NOOK_OK && scale > 1)
        result = create_inputs(gpu, width, height, &targets->trace_depth, &targets->trace_normal);
    targets->scale = scale;
    return result;
}

nook_result ao_targets_fit(nook_gpu *gpu, ao_targets *targets, uint32_t width, uint32_t height, uint32_t scale)
{
    nook_result result = fit_full(gpu, targets, width, height);
    if (result == NOOK_OK)
        result = fit_trace(gpu, targets, scale);
    if (result != NOOK_OK)
        ao_targets_release(gpu, targets);
    return result;
}

nook_result ao_targets_fit_filtered(nook_gpu *gpu, ao_targets *targets)
{
    if (targets->trace_filtered.id)
        return NOOK_OK;
    const nook_texture *like = &targets->trace_visibility;
    return nook_texture_create_2d(gpu, GL_R32F, like->width, like->height, GL_NEAREST, &targets->trace_filtered);
}

static uint64_t pixels(const nook_texture *texture)
{
    return (uint64_t)texture->width * texture->height; /* 0 for those that are not there */
}

uint64_t ao_targets_bytes(const ao_targets *targets)
{
    enum { DEPTH_BYTES = 4, NORMAL_BYTES = 4, VISIBILITY_BYTES = 4 }; /* R32F, RG16, R32F */
    return DEPTH_BYTES * (pixels(&targets->depth) + pixels(&targets->trace_depth)) +
           NORMAL_BYTES * (pixels(&targets->normal) + pixels(&targets->trace_normal)) +
           VISIBILITY_BYTES *
               (pixels(&targets->visibility) + pixels(&targets->trace_visibility) + pixels(&targets->trace_filtered));
}
