#include "modules/ao/ao_internal.h"

static void destroy_trace(nook_gpu *gpu, ao_trace *trace)
{
    nook_texture_destroy(gpu, &trace->depth);
    nook_texture_destroy(gpu, &trace->normal);
    nook_texture_destroy(gpu, &trace->visibility);
    nook_texture_destroy(gpu, &trace->filtered);
    *trace = (ao_trace){ 0 };
}

void ao_targets_release(nook_gpu *gpu, ao_targets *targets)
{
    for (int i = 0; i < AO_SCALES; i++)
        destroy_trace(gpu, &targets->traces[i]);
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
    ao_trace *trace = &targets->traces[scale];
    if (trace->visibility.id)
        return NOOK_OK;
    uint32_t width = nook_groups(targets->width, 1u << scale), height = nook_groups(targets->height, 1u << scale);
    nook_result result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &trace->visibility);
    if (result == NOOK_OK && scale > 0)
        result = create_inputs(gpu, width, height, &trace->depth, &trace->normal);
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

nook_result ao_trace_fit_filtered(nook_gpu *gpu, ao_trace *trace)
{
    if (trace->filtered.id)
        return NOOK_OK;
    return nook_texture_create_2d(gpu, GL_RGBA32F, trace->visibility.width, trace->visibility.height, GL_NEAREST,
                                  &trace->filtered);
}

static uint64_t pixels(const nook_texture *texture)
{
    return (uint64_t)texture->width * texture->height; /* 0 for those that are not there */
}

uint64_t ao_targets_bytes(const ao_targets *targets, uint32_t scale)
{
    const ao_trace *trace = &targets->traces[scale];
    enum {
        DEPTH_BYTES = 4,
        NORMAL_BYTES = 4,
        VISIBILITY_BYTES = 4,
        FILTERED_BYTES = 16
    }; /* R32F, RG16, R32F, RGBA32F */
    return DEPTH_BYTES * (pixels(&targets->depth) + pixels(&trace->depth)) +
           NORMAL_BYTES * (pixels(&targets->normal) + pixels(&trace->normal)) +
           VISIBILITY_BYTES * (pixels(&targets->visibility) + pixels(&trace->visibility)) +
           FILTERED_BYTES * pixels(&trace->filtered);
}
