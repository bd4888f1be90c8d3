/**
 * volume_file.h - the .nkv file: one occluder's voxels, densities, surfels or distances. Format: docs/volume_format.md.
 */
#pragma once
#include "engine/core/result.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_VOLUME_VERSION 1u
#define NOOK_VOLUME_SIDE_MAX 514u /**< 512 and the empty border on both sides. */

typedef enum nook_volume_kind {
    NOOK_VOLUME_BINARY = 0,   /**< A voxel is 255 where a surface was voxelised (voxelize.h says which), else 0. */
    NOOK_VOLUME_DENSITY = 1,  /**< The largest alpha of what lies in a voxel, 255 opaque: docs/volume_kinds.md. */
    NOOK_VOLUME_SURFEL = 2,   /**< Planes inside of voxels, in bricks: docs/surfel_bricks.md. */
    NOOK_VOLUME_DISTANCE = 3, /**< How far the nearest surface is from a voxel's centre: docs/volume_kinds.md. */
} nook_volume_kind;

enum {
    NOOK_VOLUME_KINDS = 4,         /**< Their numbers are below. */
    NOOK_DISTANCES_PER_VOXEL = 32, /**< A distance of one voxel as it is stored; 255 is all from there on. */
    NOOK_DISTANCE_OCCUPIED = NOOK_DISTANCES_PER_VOXEL / 2 /**< Nearer than this a voxel counts as occupied. */
};
/** All of them, for messages: their numbers and names. */
#define NOOK_VOLUME_KINDS_TEXT "0 (binary), 1 (density), 2 (surfel) and 3 (distance)"
/** A set of kinds is bits. */
#define NOOK_VOLUME_BIT(kind) (1u << (kind))

/** Kinds by name: "binary", "density", "surfel", "distance". @return NULL for a number that is none */
const char *nook_volume_kind_name(nook_volume_kind kind);

/** What a volume is, without its contents. */
typedef struct nook_volume_info {
    nook_volume_kind kind;
    uint32_t width, height, depth; /**< Voxels, each in [1, NOOK_VOLUME_SIDE_MAX], the empty border included. */
    double voxel_size;             /**< Metres in mesh space, > 0; the same on all axes. */
    double origin[3];              /**< Metres, mesh space: outer corner of voxel (0, 0, 0). */
    uint64_t content_hash;         /**< Of the triangles and the bake settings; tells a stale bake. */
    /** Of a medium (medium_bake.h): its densities are optical depths, this that of a voxel of 255 along its side, natural logarithm; > 0.
        0: alphas of surfaces. In no file. */
    double depth_of_255;
    uint64_t occupied; /**< Voxels that are not 0, have a surfel, or whose distance is below NOOK_DISTANCE_OCCUPIED. */
} nook_volume_info;

/** 4 x 4 x 4 voxels. Layout of the GPU's: RGBA32UI. */
typedef struct nook_brick {
    /** Voxels that have a surfel: bits of nook_brick_bit (modules/bake/brick_grid.h), the low word first. */
    uint32_t mask[2];
    uint32_t first_surfel; /**< Of its voxels, in the order of their bits. */
    /** Chebyshev distance in bricks to the nearest one that has a surfel; 0: this one has. At most the grid's longest side: then there
        is none. */
    uint32_t skip;
} nook_brick;

/** What lies in a voxel: two words of modules/bake/surfel_word.h; the second may be 0. Layout of the GPU's: RG32UI. */
typedef struct nook_surfel {
    uint32_t plane[2];
} nook_surfel;

/** A volume in memory. */
typedef struct nook_volume {
    nook_volume_info info;
    uint8_t *voxels; /**< But for surfels: width * height * depth bytes, x fastest, then y, then z; else NULL. Owned. */
    nook_brick *bricks;   /**< Surfel: those of nook_brick_counts, x fastest, then y, then z; else NULL. Owned. */
    nook_surfel *surfels; /**< Surfel: info.occupied of them, in the order of bricks; else NULL. Owned. */
} nook_volume;

void nook_volume_free(nook_volume *volume); /**< NULL and zeroed volumes are allowed. */

/**
 * Reads and checks a .nkv file image: magic, version, sizes, checksum, decompressed size, and all that shaders rely on.
 * @param name  used in messages only
 * @return NOOK_E_FORMAT not a volume, cut short or damaged; NOOK_E_VERSION bake it again; NOOK_E_MEMORY.
 *         *out_volume is untouched on failure
 */
nook_result nook_volume_decode(const char *name, const void *bytes, size_t size, nook_volume *out_volume);
/** Only the header; checked against the file's size and checksum, but nothing is decompressed. */
nook_result nook_volume_decode_info(const char *name, const void *bytes, size_t size, nook_volume_info *out_info);

/** Makes a .nkv file image; the same volume gives the same bytes. Outputs are untouched on failure. @param out_bytes  owned by the caller, release with free() @return NOOK_E_MEMORY, NOOK_E_ARG */
nook_result nook_volume_encode(const nook_volume *volume, void **out_bytes, size_t *out_size);

#ifdef __cplusplus
}
#endif
