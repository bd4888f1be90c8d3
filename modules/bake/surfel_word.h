/**
 * surfel_word.h - a plane inside a voxel as 32 bits: what a surfel holds two of. The same in shaders/ao/surfel.glsl.
 *
 *   bits 0-7, 8-15  normal, octahedral, two signed bytes of +-127 (no -128)
 *   bits 16-23      offset along the normal from the voxel's centre, a signed byte of +-127 for +-NOOK_SURFEL_OFFSET_MAX voxels
 *   bits 24-29      alpha, 1 to 63: the part of the plane within the voxel that is there; within an interval its code, alpha being 63
 *   bits 30-31      where it ends: enum nook_surfel_side
 *
 * Words below 2^24 are no planes: as second ones they are the box that the first plane lies in (surfel_extent.h), 0 being the voxel.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_SURFEL_OFFSET_MAX 0.87 /**< Voxels: a little more than half a voxel's diagonal. */
#define NOOK_SURFEL_ALPHA_MAX 63u

typedef enum nook_surfel_side {
    NOOK_SIDE_BOTH = 0,  /**< The plane goes through. */
    NOOK_SIDE_ABOVE = 1, /**< It is there only where dot(other's normal, x) >= other's offset. */
    NOOK_SIDE_BELOW = 2, /**< Only where it is less. */
    NOOK_SIDE_WITHIN = 3 /**< Only within an interval of one axis; of two planes alone. */
} nook_surfel_side;

typedef struct nook_surfel_plane {
    double normal[3]; /**< Of unit length; either way. */
    double offset;    /**< Voxels from the voxel's centre: dot(normal, x) = offset. */
    uint32_t alpha;   /**< 1 to NOOK_SURFEL_ALPHA_MAX. */
    nook_surfel_side side;
    uint32_t interval; /**< NOOK_SIDE_WITHIN: its code (surfel_extent.h). */
} nook_surfel_plane;

/** The word whose normal is nearest; its offset is that at which it goes through `through` (voxels from the centre) all the same. */
uint32_t nook_surfel_pack(const nook_surfel_plane *plane, const double through[3]);
nook_surfel_plane nook_surfel_unpack(uint32_t word); /**< Not of 0. */

bool nook_surfel_word_is_plane(uint32_t word); /**< Else it is a box. */

/** Whether two words make a surfel: the first is a plane, the second one or a box, and neither holds what is never written. */
bool nook_surfel_is_sound(uint32_t first, uint32_t second);

#ifdef __cplusplus
}
#endif
