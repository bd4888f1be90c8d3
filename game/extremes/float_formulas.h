/**
 * float_formulas.h - three ways from a pixel's depth to a voxel in the float32 of shaders: ours, and the two obvious ones, to show where
 * those break. On the CPU, which rounds as GPUs must.
 */
#pragma once
#include "engine/core/matrix.h"

/** What is known in double: where camera and volume are. */
typedef struct nook_float_setting {
    nook_matrix view_from_world;  /**< Rigid. */
    nook_matrix clip_from_view;   /**< Reversed-Z, infinite. */
    nook_matrix world_from_voxel; /**< Of the volume. */
} nook_float_setting;

/** A pixel: place in the image, [-1, 1], and distance along -Z, world units. */
typedef struct nook_float_pixel {
    float ndc[2], distance;
} nook_float_pixel;

typedef struct nook_float_error {
    double relative;   /**< View space: ray * distance, and one matrix from view to voxel, composed in double. Ours. */
    double world;      /**< The point in world space, then voxel_from_world: p * scale + bias. */
    double projection; /**< The point by the inverse view-projection, then voxel_from_world. */
} nook_float_error;

/** How far each way ends from where the pixel truly is, voxels, the worst axis. Against long double. */
nook_float_error nook_float_measure(const nook_float_setting *setting, const nook_float_pixel *pixel);
