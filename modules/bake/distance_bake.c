#include "modules/bake/distance_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/distance_pieces.h"
#include "modules/bake/triangle_tree.h"
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Corners were snapped by at most half a step along each axis, so no point of a surface has moved farther than this. It is taken off:
   no stored distance is larger than the true one. Corners of what was cut are rounded once more. */
static const double snapped_voxels = 0.87 / NOOK_SUBVOXEL;

typedef struct bake {
    const nook_triangle_tree *tree;
    const nook_grid_frame *frame;
    double moved; /* voxels, at the most, of a corner */
    uint8_t *voxels;
    _Atomic uint64_t occupied;
} bake;

static uint8_t encode(double steps_squared, double moved)
{
    double voxels = sqrt(steps_squared) / NOOK_SUBVOXEL - moved;
    return (uint8_t)fmin(fmax(floor(voxels * NOOK_DISTANCES_PER_VOXEL), 0.0), UINT8_MAX);
}

/* Rows of voxels along x. A row begins without a hint: what it gets does not depend on the rows that its thread had before. */
static void bake_rows(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    const double limit_steps = (UINT8_MAX + 1.0) / NOOK_DISTANCES_PER_VOXEL * NOOK_SUBVOXEL;
    uint64_t occupied = 0;
    (void)worker;
    for (size_t row = first; row < last; row++) {
        uint8_t *voxels = b->voxels + row * b->frame->size[0];
        uint32_t hint = 0;
        double point[3] = { 0.0, (double)(row % b->frame->size[1]) + 0.5, (double)(row / b->frame->size[1]) + 0.5 };
        point[1] *= NOOK_SUBVOXEL, point[2] *= NOOK_SUBVOXEL;
        for (uint32_t x = 0; x < b->frame->size[0]; x++) {
            point[0] = (x + 0.5) * NOOK_SUBVOXEL;
            voxels[x] = encode(nook_triangle_tree_distance(b->tree, point, limit_steps * limit_steps, &hint), b->moved);
            occupied += voxels[x] < NOOK_DISTANCE_OCCUPIED;
        }
    }
    atomic_fetch_add(&b->occupied, occupied);
}

nook_result nook_distance_bake(const nook_triangles *triangles, const nook_alphas *alphas, unsigned threads,
                               const nook_grid_frame *frame, nook_volume *out_volume)
{
    size_t rows = (size_t)frame->size[1] * frame->size[2];
    nook_distance_pieces pieces = { .triangles = NULL };
    nook_triangle_tree *tree = NULL;
    if (nook_distance_pieces_make(triangles, alphas, frame, &pieces) == NOOK_OK)
        tree = nook_triangle_tree_create(pieces.triangles, pieces.count);
    bake b = { .tree = tree, .frame = frame, .moved = (pieces.cut ? 2.0 : 1.0) * snapped_voxels };
    nook_distance_pieces_free(&pieces);
    uint8_t *voxels = malloc(rows * frame->size[0]);
    if (!tree || !voxels) {
        nook_triangle_tree_destroy(tree);
        free(voxels);
        return nook_fail(NOOK_E_MEMORY, "voxelize: no memory for distances in %ux%ux%u voxels; lower the resolution",
                         frame->size[0], frame->size[1], frame->size[2]);
    }
    b.voxels = voxels;
    nook_parallel_for(rows, threads, bake_rows, &b);
    nook_triangle_tree_destroy(tree);
    *out_volume = (nook_volume){ .info = { .occupied = atomic_load(&b.occupied) }, .voxels = voxels };
    return NOOK_OK;
}
