/**
 * plan.h - which volumes a scene requires, and how fine: plain numbers in, a plan out. No GL, no files, no state.
 *
 * Every choice says its rule and the error that it rests on. Rules that are proven: docs/plan.md derives their bounds. Rules that are
 * measured are used in mode `measured` only.
 */
#pragma once
#include "engine/core/result.h"
#include "modules/plan/bounds.h"
#include "modules/plan/plan_params.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_PLAN_NONE UINT32_MAX

/** What would be baked without a plan. */
typedef struct nook_plan_volume {
    double sides[3];     /**< Of its box, metres, mesh space. */
    double scale;        /**< World metres for a metre of mesh space, at its largest instance. */
    uint32_t resolution; /**< Voxels on the longest side, as it would be without a plan; at least 1. */
    uint32_t twin;       /**< The first volume with the same triangles, bit for bit; itself when it is that. */
} nook_plan_volume;

/** A body where it stands. */
typedef struct nook_plan_occluder {
    uint32_t volume;
    nook_plan_box box;        /**< World. */
    double centre[3], radius; /**< A sphere that holds it, world. */
    bool alone; /**< May be left out: it is one rigid body, closed and convex, so that it does not see itself. */
} nook_plan_occluder;

/** A piece of surface that may be seen. */
typedef struct nook_plan_receiver {
    nook_plan_box box; /**< World. */
    uint32_t occluder; /**< Whose surface it is, or NOOK_PLAN_NONE. */
} nook_plan_receiver;

/** A piece of what stands still. */
typedef struct nook_plan_part {
    nook_plan_box box; /**< World. */
} nook_plan_part;

/** From where the scene is seen; without one, from anywhere. */
typedef struct nook_plan_view {
    double eye[3];
    double planes[5][4]; /**< Inside: dot(plane, point) + plane[3] >= 0; sides and near. */
    double pixel_metres; /**< What a pixel covers at a distance of 1. */
} nook_plan_view;

typedef struct nook_plan_scene {
    const nook_plan_volume *volumes;
    uint32_t volume_count;
    const nook_plan_occluder *occluders;
    uint32_t occluder_count;
    const nook_plan_receiver *receivers; /**< All surfaces that are drawn. */
    uint32_t receiver_count;
    const nook_plan_part *parts; /**< Of static_volume. */
    uint32_t part_count;
    uint32_t static_volume;     /**< Or NOOK_PLAN_NONE. */
    double r_max;               /**< Metres, > 0. */
    bool moves;                 /**< Bodies will not stay where they stand: distances prove nothing. */
    bool exact_union;           /**< Several volumes are joined ray by ray (volume.combine = union). */
    const nook_plan_view *view; /**< NULL: from anywhere. */
    /** The largest share of a pixel's rays that a cone of this sine holds; NULL: the integral, sine^2. Rises with the sine. */
    double (*ray_share)(void *user, double sine);
    void *user;
} nook_plan_scene;

/** Why a body is marched or not. */
typedef enum nook_plan_rule {
    NOOK_PLAN_KEPT,
    NOOK_PLAN_OUT_OF_REACH, /**< No surface that may be seen lies within r_max of it. */
    NOOK_PLAN_TOO_SMALL     /**< The solid angle that it takes of any surface that may be seen is within the error. */
} nook_plan_rule;

typedef struct nook_plan_occluder_choice {
    nook_plan_rule rule;
    double
        bound; /**< The most that it takes of any point; also of one that is kept: 1 for one that touches a surface. */
} nook_plan_occluder_choice;

/** Why a volume is as fine as it is. */
typedef enum nook_plan_fineness {
    NOOK_PLAN_AS_EVER,   /**< As without a plan. */
    NOOK_PLAN_BY_ERROR,  /**< As coarse as level_error allows. */
    NOOK_PLAN_BY_PIXEL,  /**< Finer ones would be smaller than a pixel. */
    NOOK_PLAN_BY_MEMORY, /**< Coarser than level_error asks: memory. */
    NOOK_PLAN_UNUSED,    /**< Nobody marches it: all its bodies are left out, or it is split. */
    NOOK_PLAN_TWIN       /**< Its bodies use the volume of its twin. */
} nook_plan_fineness;

typedef struct nook_plan_volume_choice {
    nook_plan_fineness why;
    uint32_t volume;     /**< The one that its bodies use: itself or its twin. */
    uint32_t resolution; /**< 0 when it is not baked. */
    uint64_t bytes;      /**< Of its binary voxels; 0 when it is not baked. */
    double error; /**< RMS by measurement of voxels of this size (nook_plan_level_error); 0 when it is not baked. */
} nook_plan_volume_choice;

/** Static parts that share a volume. */
typedef struct nook_plan_group {
    nook_plan_box box; /**< World. */
    uint32_t parts;
    uint32_t resolution;
    uint64_t bytes;
} nook_plan_group;

/** Owns all it points to. */
typedef struct nook_plan {
    nook_plan_params params;
    nook_plan_occluder_choice *occluders; /**< As the scene's. */
    uint32_t occluder_count;
    nook_plan_volume_choice *volumes; /**< As the scene's. */
    uint32_t volume_count;
    uint32_t *group_of_part; /**< As the scene's parts. */
    nook_plan_group *groups; /**< Instead of static_volume; none: it stays whole. */
    uint32_t group_count;
    double bound;                 /**< Proven: the most that the visibility of any point changes by what is left out. */
    double level_error;           /**< Measured: the largest RMS of a volume that is baked. */
    uint64_t bytes_before, bytes; /**< Of binary voxels, without the plan and with it. */
} nook_plan;

/** Bytes of the binary voxels of a box, border included, at so many voxels on its longest side. */
uint64_t nook_plan_voxel_bytes(const double sides[3], uint32_t resolution);

/**
 * RMS error of visibility that voxels have which are so many times smaller than r_max, measured on four scenes with many rays, the worst of
 * them; between what was measured, straight lines over the logarithm. docs/plan.md has the table.
 */
double nook_plan_level_error(double voxels_per_r_max);
/** The fewest voxels per r_max whose error is within `error`; those of the finest that was measured when none is. */
double nook_plan_level_for(double error);

/**
 * Makes the plan. In mode off everything stays as it is, and the bytes are told.
 * @return NOOK_E_RANGE the memory allowed is not enough (the line says what is, and what else to change); NOOK_E_MEMORY;
 *         *out_plan is zero then
 */
nook_result nook_plan_make(const nook_plan_scene *scene, const nook_plan_params *params, nook_plan *out_plan);
void nook_plan_free(nook_plan *plan); /**< Zeroed ones are allowed; becomes zero. */

#ifdef __cplusplus
}
#endif
