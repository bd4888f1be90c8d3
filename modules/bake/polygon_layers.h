/** polygon_layers.h - polygons in steps, cut where layers of voxels end: inside modules/bake only. */
#pragma once
#include "modules/bake/polygon.h"
#include "modules/bake/triangle_grid.h"
#include <math.h>

/** First and last layer along an axis in which a polygon lies. @param inner  nook_grid_frame.inner of that axis */
static inline void nook_polygon_layers(const nook_polygon *polygon, int axis, int32_t inner, int32_t *out_first,
                                       int32_t *out_last)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < polygon->count; i++) {
        const double at = polygon->corner[i][axis];
        low = at < low ? at : low;
        high = at > high ? at : high;
    }
    *out_first = nook_grid_layer(low, inner);
    *out_last = nook_grid_layer(high, inner);
}

/** What lies in a layer, and what above it; of the last one all is in it. Layers end where those of voxels do: NOOK_LAYER_BIAS. */
static inline void nook_polygon_take_layer(const nook_polygon *polygon, int axis, int32_t layer, int32_t last,
                                           nook_polygon *out_here, nook_polygon *out_above)
{
    *out_here = *polygon;
    out_above->count = 0;
    if (layer < last)
        nook_polygon_split(polygon, axis, (layer + 1.0) * NOOK_SUBVOXEL - NOOK_LAYER_BIAS, out_here, out_above);
}
