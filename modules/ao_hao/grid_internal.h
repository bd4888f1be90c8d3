/** grid_internal.h - where the grid of voxels lies: around what can occlude something that the view shows. */
#pragma once
#include "engine/core/matrix.h"
#include <stdbool.h>
#include <stdint.h>

/** Along the grid's axes, metres from the world's origin. Empty when a minimum is above its maximum. */
typedef struct hao_box {
    double min[3], max[3];
} hao_box;

static const hao_box hao_nothing = { { 1e300, 1e300, 1e300 }, { -1e300, -1e300, -1e300 } };

bool hao_box_is_empty(const hao_box *box); /**< NaN is empty. */
void hao_box_add_point(hao_box *box, const double point[3]);
void hao_box_add(hao_box *box, const hao_box *other);
void hao_box_cut(hao_box *box, const hao_box *other); /**< To what both hold. */
/** The box around `box` after an affine transform. */
hao_box hao_box_transform(const hao_box *box, const nook_matrix *transform);

/** A pinhole camera, as nook_ao_pass has it, in metres along the grid's axes. */
typedef struct hao_view {
    nook_matrix grid_from_view; /**< Rigid. */
    double ray_scale[2], ray_offset[2];
    double r_max, far; /**< Metres; nothing farther from the eye than `far` along an axis is looked at. */
} hao_view;

/** Cubic voxels, at whole multiples of their side from the world's origin. */
typedef struct hao_grid {
    double voxel_size; /**< Metres: a power of 2^(1/8), so that it stays while the view turns a little. */
    double first[3];   /**< Voxels from the world's origin to the grid's voxel (0, 0, 0): whole numbers. */
    uint32_t size[3];  /**< Voxels; 0 when nothing can occlude what is seen. */
    hao_box box;       /**< What it is for; its voxels reach beyond by less than one. */
    nook_matrix voxel_from_view;
} hao_grid;

/** Axes of the grid for one slicemap: its third one is a diagonal of the world's cube. Grid from world, a rotation. */
nook_matrix hao_diagonal_axes(void);

/**
 * Around everything of `scene` that lies within r_max of a point that the view may show.
 * @param scene       what occludes
 * @param resolution  most voxels along an axis, at least 4
 */
void hao_grid_place(const hao_view *view, const hao_box *scene, uint32_t resolution, hao_grid *out_grid);
