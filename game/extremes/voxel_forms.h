/**
 * voxel_forms.h - what voxels of density 1, filtered and cut at 1/2, occlude at most and at least: closed forms at the origin, normal +z,
 * r_max beyond all of it, hard falloff, matched steps of one voxel.
 */
#pragma once
#include <stdint.h>

/** A of a square of `side` at `height`, its middle overhead; metres. */
double nook_square_overhead(double side, double height);

/**
 * The error of A under a square of one metre, one layer of voxels thick, overhead, as a part of what the filter may take of it.
 * @param height metres to its lower face @param side voxels along it @return at most 1
 */
double nook_layer_loss(double occlusion, double height, uint32_t side);

/** A needle along x of `side` voxels, or with 1 a single one, its middle overhead; metres. */
typedef struct nook_thin_body {
    uint32_t side;
    double voxel, height; /**< Metres; of its lower face. */
} nook_thin_body;

/** The least that is found of its A; the most is all of it. */
double nook_thin_body_least(const nook_thin_body *body);
