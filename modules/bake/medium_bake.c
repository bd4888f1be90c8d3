#include "modules/bake/medium_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>

static const double DEPTH_LEAST = 1e-30, DEPTH_MOST = 1e30; /* -ln of what gets through a voxel: all, nothing */

typedef struct bake {
    const nook_medium *medium;
    double voxel; /* metres */
    uint32_t inner[3];
    float *means; /* of the inner voxels */
} bake;

/* The cells that a voxel has a part of along an axis. */
typedef struct span {
    uint32_t first, end;
} span;

static double side_of(const nook_medium *medium, int axis)
{
    return medium->spacing[axis] * medium->size[axis];
}

static span cells_of(const bake *b, int axis, uint32_t voxel)
{
    double low = voxel * b->voxel / b->medium->spacing[axis],
           high = (voxel + 1.0) * b->voxel / b->medium->spacing[axis];
    double last = b->medium->size[axis];
    return (span){ (uint32_t)fmin(floor(low), last), (uint32_t)fmin(ceil(high), last) };
}

/* How much of a voxel's side lies in a cell, [0, 1]. */
static double share(const bake *b, int axis, uint32_t voxel, uint32_t cell)
{
    double step = b->medium->spacing[axis] / b->voxel;
    double part = fmin((cell + 1.0) * step, voxel + 1.0) - fmax(cell * step, voxel);
    return fmax(part, 0.0);
}

static double mean_of(const bake *b, const uint32_t voxel[3])
{
    const uint32_t *size = b->medium->size;
    const span x = cells_of(b, 0, voxel[0]), y = cells_of(b, 1, voxel[1]), z = cells_of(b, 2, voxel[2]);
    double sum = 0.0;
    for (uint32_t k = z.first; k < z.end; k++) {
        for (uint32_t j = y.first; j < y.end; j++) {
            const float *row = b->medium->extinction + ((size_t)k * size[1] + j) * size[0];
            double along = 0.0;
            for (uint32_t i = x.first; i < x.end; i++)
                along += share(b, 0, voxel[0], i) * (double)row[i];
            sum += along * share(b, 1, voxel[1], j) * share(b, 2, voxel[2], k);
        }
    }
    return sum;
}

static void fill_slices(void *user, size_t first, size_t last, unsigned worker)
{
    const bake *b = user;
    (void)worker;
    for (size_t z = first; z < last; z++)
        for (uint32_t y = 0; y < b->inner[1]; y++)
            for (uint32_t x = 0; x < b->inner[0]; x++)
                b->means[(z * b->inner[1] + y) * b->inner[0] + x] =
                    (float)mean_of(b, (const uint32_t[3]){ x, y, (uint32_t)z });
}

/* Bytes of the means, 255 for the highest. */
static void store(const bake *b, float highest, nook_volume *volume)
{
    const nook_volume_info *info = &volume->info;
    const float *mean = b->means;
    for (uint32_t z = 1; z <= b->inner[2]; z++) {
        for (uint32_t y = 1; y <= b->inner[1]; y++) {
            uint8_t *row = volume->voxels + ((size_t)z * info->height + y) * info->width;
            for (uint32_t x = 1; x <= b->inner[0]; x++, mean++) {
                row[x] = highest > 0.0f ? (uint8_t)lroundf(255.0f * (*mean / highest)) : 0;
                volume->info.occupied += row[x] > 0;
            }
        }
    }
}

uint32_t nook_medium_resolution(const nook_medium *medium, uint32_t resolution)
{
    double longest = fmax(fmax(side_of(medium, 0), side_of(medium, 1)), side_of(medium, 2));
    double shortest = fmin(fmin(medium->spacing[0], medium->spacing[1]), medium->spacing[2]);
    double most = fmin(NOOK_VOLUME_SIDE_MAX - 2.0, ceil(longest / shortest - 1e-6));
    return (uint32_t)fmax(fmin(resolution, most), 1.0);
}

nook_result nook_medium_bake(const nook_medium *medium, uint32_t resolution, unsigned threads, nook_volume *out_volume)
{
    uint32_t longest = nook_medium_resolution(medium, resolution);
    bake b = { .medium = medium };
    for (int axis = 0; axis < 3; axis++)
        b.voxel = fmax(b.voxel, side_of(medium, axis) / longest);
    for (int axis = 0; axis < 3; axis++) /* a rounding above a whole number of voxels is none */
        b.inner[axis] = (uint32_t)fmin(fmax(ceil(side_of(medium, axis) / b.voxel - 1e-6), 1.0), longest);
    nook_volume volume = { .info = { .kind = NOOK_VOLUME_DENSITY,
                                     .width = b.inner[0] + 2,
                                     .height = b.inner[1] + 2,
                                     .depth = b.inner[2] + 2,
                                     .voxel_size = b.voxel,
                                     .origin = { -b.voxel, -b.voxel, -b.voxel } } };
    size_t count = (size_t)b.inner[0] * b.inner[1] * b.inner[2];
    b.means = malloc(count * sizeof *b.means);
    volume.voxels = calloc((size_t)volume.info.width * volume.info.height, volume.info.depth);
    if (!b.means || !volume.voxels) {
        free(b.means);
        free(volume.voxels);
        return nook_fail(NOOK_E_MEMORY, "density: no memory for %zu voxels; lower the resolution", count);
    }
    float highest = 0.0f;
    nook_parallel_for(b.inner[2], threads, fill_slices, &b);
    for (size_t i = 0; i < count; i++)
        highest = fmaxf(highest, b.means[i]);
    if (highest * b.voxel <
        DEPTH_LEAST) /* as a float on the GPU it might be 0, and bytes without a depth are opacities */
        highest = 0.0f;
    store(&b, highest, &volume);
    volume.info.depth_of_255 = fmin((double)highest * b.voxel, DEPTH_MOST);
    free(b.means);
    *out_volume = volume;
    return NOOK_OK;
}
