#include "game/extremes/voxel_forms.h"
#include "engine/core/angle.h"
#include "modules/fixture/closed_form.h"
#include <math.h>

double nook_square_overhead(double side, double height)
{
    return 4.0 * nook_form_level_rectangle(NOOK_FORM_COSINE, 0.5 * side, 0.5 * side, height);
}

/*
 * A layer of one voxel, whose filtered density is at least 1/2 over a thickness of 2 - 1 / (1/2 + e) voxels at a distance of
 * e < 1/2 from its rim: the rim lacks ln 2 - 1/2 voxels of it, and what is left lies about the layer's middle.
 * So A is at least that of a square narrower by twice this and half a voxel higher. @return the error as a part of that loss
 */
double nook_layer_loss(double occlusion, double height, uint32_t side)
{
    const double voxel = 1.0 / side, lacking = log(2.0) - 0.5, truth = nook_square_overhead(1.0, height);
    double fewest = nook_square_overhead(1.0 - 2.0 * lacking * voxel, height + 0.5 * voxel);
    return fabs(occlusion - truth) / (truth - fewest);
}

/*
 * The filtered density of one voxel is a product of tents, and a sample hits where that is at least 1/2: a region that lies
 * inside the voxel. No ray can hit more than the voxel's own silhouette. A jittered step of one voxel hits a chord of c <= 1 voxels
 * with probability c, so that at least the integral over the region is found. Along the needle only the chord's part across it
 * is counted, which bounds the probability from below where it reaches 1.
 */
double nook_thin_body_least(const nook_thin_body *body)
{
    enum { CELLS = 24 }; /* along an axis of a voxel */
    double sum = 0.0, cell = body->voxel / CELLS;
    for (uint32_t i = 0; i < CELLS * body->side; i++) {
        for (uint32_t k = 0; k < CELLS * CELLS; k++) {
            double from_end = fmin(i + 0.5, CELLS * body->side - i - 0.5) / CELLS; /* voxels */
            double density = fmin(1.0, 0.5 + from_end);
            double y = (k % CELLS + 0.5) / CELLS - 0.5, z = (k / CELLS + 0.5) / CELLS - 0.5;
            if (density * (1.0 - fabs(y)) * (1.0 - fabs(z)) < 0.5)
                continue;
            double at[3] = { (i + 0.5) * cell - 0.5 * body->side * body->voxel, y * body->voxel,
                             body->height + (z + 0.5) * body->voxel };
            double squared = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
            double across = body->side > 1 ? sqrt(1.0 - at[0] * at[0] / squared) : 1.0;
            sum += at[2] / sqrt(squared) / squared * across * cell * cell * cell;
        }
    }
    return sum / (body->voxel * NOOK_PI);
}
