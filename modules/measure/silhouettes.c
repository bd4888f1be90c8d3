#include "modules/measure/silhouettes.h"
#include "engine/core/log.h"
#include "engine/core/surface.h"
#include <stdlib.h>

/* What a pixel is to the silhouettes that run past it; both may be. */
enum { BESIDE_INSIDE = 1, BESIDE_OUTSIDE = 2 };

/* Looks at two neighbours, and notes at each what side of a silhouette it is. */
static void compare(const nook_seen *seen, double footprint, const uint32_t a[2], const uint32_t b[2], uint8_t *beside)
{
    size_t ia = (size_t)a[1] * seen->width + a[0], ib = (size_t)b[1] * seen->width + b[0];
    double near_a = seen->distances[ia], near_b = seen->distances[ib];
    bool shown_a = near_a > 0.0, shown_b = near_b > 0.0;
    if (!shown_a && !shown_b)
        return;
    if (shown_a && shown_b) {
        nook_surface_point point_a = nook_seen_point(seen, footprint, a[0], a[1]);
        nook_surface_point point_b = nook_seen_point(seen, footprint, b[0], b[1]);
        if (nook_surface_joins(&point_a, &point_b))
            return;
    }
    bool a_is_near = shown_a && (!shown_b || near_a < near_b);
    beside[ia] |= a_is_near ? BESIDE_INSIDE : BESIDE_OUTSIDE;
    beside[ib] |= a_is_near ? BESIDE_OUTSIDE : BESIDE_INSIDE;
}

static void find_silhouettes(const nook_seen *seen, uint8_t *beside)
{
    double footprint = nook_seen_footprint(seen);
    for (uint32_t y = 0; y < seen->height; y++) {
        for (uint32_t x = 0; x < seen->width; x++) {
            uint32_t here[2] = { x, y };
            if (x + 1 < seen->width)
                compare(seen, footprint, here, (uint32_t[2]){ x + 1, y }, beside);
            if (y + 1 < seen->height)
                compare(seen, footprint, here, (uint32_t[2]){ x, y + 1 }, beside);
        }
    }
}

/* The side of the nearest silhouette: pixels that show nothing have no side, so they speak for none. */
static uint8_t side_of(const nook_seen *seen, const uint8_t *beside, uint32_t x, uint32_t y)
{
    int reach = NOOK_SILHOUETTE_PIXELS, nearest = reach * reach;
    uint8_t sides = 0;
    for (int dy = -reach; dy <= reach; dy++) {
        for (int dx = -reach; dx <= reach; dx++) {
            int64_t column = (int64_t)x + dx, row = (int64_t)y + dy;
            int squared = dx * dx + dy * dy;
            if (squared > nearest || column < 0 || row < 0 || column >= seen->width || row >= seen->height)
                continue;
            size_t i = (size_t)row * seen->width + (size_t)column;
            if (!beside[i] || !(seen->distances[i] > 0.0f))
                continue;
            sides = (uint8_t)(squared < nearest ? beside[i] : sides | beside[i]);
            nearest = squared;
        }
    }
    return sides & BESIDE_OUTSIDE ? NOOK_SILHOUETTE_OUTSIDE : sides ? NOOK_SILHOUETTE_INSIDE : NOOK_SILHOUETTE_AWAY;
}

nook_result nook_silhouettes_mark(const nook_seen *seen, uint8_t *out_marks)
{
    size_t pixels = (size_t)seen->width * seen->height;
    uint8_t *beside = calloc(pixels, 1);
    if (!beside)
        return nook_fail(NOOK_E_MEMORY, "silhouettes: no memory for %zu pixels", pixels);
    find_silhouettes(seen, beside);
    for (uint32_t y = 0; y < seen->height; y++) {
        for (uint32_t x = 0; x < seen->width; x++) {
            size_t i = (size_t)y * seen->width + x;
            out_marks[i] = seen->distances[i] > 0.0f ? side_of(seen, beside, x, y) : NOOK_SILHOUETTE_EMPTY;
        }
    }
    free(beside);
    return NOOK_OK;
}

void nook_silhouettes_mask(const uint8_t *marks, size_t pixels, uint8_t side, uint8_t *out_mask)
{
    for (size_t i = 0; i < pixels; i++)
        out_mask[i] = marks[i] == side;
}
