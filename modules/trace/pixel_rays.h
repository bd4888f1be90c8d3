/** pixel_rays.h - the rays of a pixel and what comes of them: shared by the technique reference and by the refinement in the background. */
#pragma once
#include "modules/ao/technique.h"
#include "modules/trace/ray_points.h"
#include "modules/trace/tracer.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the rays of a picture have in common. Borrows all; may be used by many threads at once. */
typedef struct nook_trace_work {
    const nook_ao_pass *pass; /**< Sizes, rays of view, r_max, falloff, depth_error; nothing of the GPU. */
    const nook_tracer *triangles;
    const float *depth;           /**< width * height. */
    const uint16_t *normal;       /**< RG pairs. */
    const nook_ray_point *points; /**< `count`, by their place; shifted by pixel and seed. */
    const float (*directions)[4]; /**< Not NULL: these instead, as nook_fill_directions makes them. */
    uint32_t count;               /**< Rays of each pixel. */
    uint32_t seed;
} nook_trace_work;

/** Visibility of the pixels [begin, end) of a row, 1 where there is no geometry. @param out_row  the row; only those are written */
void nook_trace_pixels(const nook_trace_work *work, uint32_t begin, uint32_t end, uint32_t y, float *out_row);

/**
 * The same of one pixel, and whose triangles its rays met first.
 * @param shares  pass->instance_count sums, to which each instance's part of 1 - visibility is added
 */
double nook_trace_shares(const nook_trace_work *work, uint32_t x, uint32_t y, double *shares);

#ifdef __cplusplus
}
#endif
