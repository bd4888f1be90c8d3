/**
 * surfel_extent.h - how far a plane reaches inside of its voxel, where that is less than all of it: docs/surfel_bricks.md, Extents. The
 * same in shaders/ao/surfel.glsl.
 *
 * A box, the second word of a surfel that has one plane:
 *   bits 0-3, 4-7, 8-11    where it begins along x, y, z: sixteenths of the voxel from its lower faces
 *   bits 12-15, ... 20-23  where it ends: sixteenths from its upper faces
 *   bits 24-31             0, which no plane has; the word 0 cuts nothing
 *
 * An interval, six bits: code = axis * 21 + (distance - 1) * 7 + place. Its ends are two of seven points of the axis, sixths of the
 * voxel from its lower face: `place` and (place + distance) mod 7, in either order. Distances of 1 to 3 around a ring of seven meet every
 * two points once.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Voxels from the voxel's centre: [-0.5, 0.5]; an end at a face cuts nothing there. */
typedef struct nook_surfel_extent {
    double low[3], high[3];
} nook_surfel_extent;

enum { NOOK_EXTENT_BOX_STEPS = 16, NOOK_EXTENT_STEPS = 6, NOOK_EXTENT_CODES = 63 };

/** The smallest box that holds the wanted one. @param wanted  low <= high @param out  what the word says */
uint32_t nook_surfel_box_pack(const nook_surfel_extent *wanted, nook_surfel_extent *out);
nook_surfel_extent nook_surfel_box_unpack(uint32_t word);
/** Whether nook_surfel_box_pack could have made it. */
bool nook_surfel_is_box(uint32_t word);

/** The nearest interval that holds the wanted one along one axis, but for a sixtieth of a voxel. @return below NOOK_EXTENT_CODES */
uint32_t nook_surfel_interval_pack(const nook_surfel_extent *wanted, int axis, nook_surfel_extent *out);
nook_surfel_extent nook_surfel_interval_unpack(uint32_t code);

#ifdef __cplusplus
}
#endif
