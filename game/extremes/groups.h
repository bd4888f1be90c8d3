/** groups.h - the groups of extreme cases, each in game/extremes/<name>_cases.c. A new one: declare it here, list it in groups.c. */
#pragma once
#include "game/extremes/extremes.h"

extern const nook_extreme_group nook_extreme_space;      /**< Scale and place. */
extern const nook_extreme_group nook_extreme_reach;      /**< r_max. */
extern const nook_extreme_group nook_extreme_surfaces;   /**< Normals, depths and image sizes of any kind. */
extern const nook_extreme_group nook_extreme_buffers;    /**< Formats of the G-buffer. */
extern const nook_extreme_group nook_extreme_transforms; /**< Matrices of occluders. */
extern const nook_extreme_group nook_extreme_triangles;  /**< What is baked. */
extern const nook_extreme_group nook_extreme_memory;     /**< What baking takes. */
extern const nook_extreme_group nook_extreme_spinning;   /**< A body that turns for a million frames. */
extern const nook_extreme_group nook_extreme_volumes;    /**< Sizes and shapes of volumes. */
extern const nook_extreme_group nook_extreme_occluders;  /**< Many at once. */
extern const nook_extreme_group nook_extreme_filter;     /**< Filter and upscaling alone. */
extern const nook_extreme_group nook_extreme_sampling;   /**< Rays, steps, samples and thresholds. */
