/**
 * scene_motion.h - what of a scene can move: rest transforms, skins, meshes that change their shape, animation clips.
 *
 * All of it is checked when it is loaded: numbers are finite, times do not fall, indices are valid. docs/animation.md tells how
 * it is played.
 */
#pragma once
#include "engine/core/matrix.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NOOK_SKIN_JOINTS_MAX = 1024,  /**< Joints of one skin. */
    NOOK_MORPH_TARGETS_MAX = 256, /**< Of one mesh. */
    NOOK_INFLUENCES = 4,          /**< Joints that move one vertex. */
};

/** A node's transform to its parent, as the file gives it. */
typedef struct nook_node_rest {
    bool is_matrix;                /**< As a matrix: no track moves it. */
    nook_matrix parent_from_local; /**< What the parts make, or the matrix. */
    double translation[3];         /**< Metres. */
    double rotation[4];            /**< Unit quaternion (x, y, z, w). */
    double scale[3];
} nook_node_rest;

typedef struct nook_skin_joint {
    uint32_t node;               /**< Into scene->nodes. */
    nook_matrix joint_from_mesh; /**< Inverse bind matrix; affine. */
} nook_skin_joint;

typedef struct nook_skin {
    char *name;
    uint32_t first_joint, joint_count; /**< Into scene->joints. */
} nook_skin;

/** What moves a vertex. Weights are in [0, 1], their sum is 1. */
typedef struct nook_influence {
    uint16_t joints[NOOK_INFLUENCES]; /**< Into the skin's joints. */
    float weights[NOOK_INFLUENCES];
} nook_influence;

/** What one morph target adds to a vertex at weight 1, mesh space. */
typedef struct nook_morph_delta {
    float position[3]; /**< Metres. */
    float normal[3];   /**< Added to the unit normal; 0 in primitives that are shaded flat. */
} nook_morph_delta;

/** A box; min > max when there is nothing in it. */
typedef struct nook_box {
    float min[3], max[3]; /**< Metres, mesh space. */
} nook_box;

/** A mesh that a skin or morph targets deform. No other node draws it. */
typedef struct nook_deformable {
    uint32_t mesh, node;
    uint32_t skin;                       /**< NOOK_NONE: morph targets only. */
    uint32_t first_vertex, vertex_count; /**< Into scene->vertices: all of the mesh. */
    uint32_t first_rest; /**< Into scene->rest_vertices, where there are any: the same vertices as the file has them. */
    uint32_t first_influence; /**< Into scene->influences, one per vertex; NOOK_NONE without a skin. */
    uint32_t target_count;
    size_t first_delta; /**< Into scene->morph_deltas: target t, vertex v at first_delta + t * vertex_count + v. */
    uint32_t
        first_weight;   /**< Into scene->morph_weights, one per target: as the file has them where no clip says more. */
    uint32_t first_box; /**< Into scene->joint_boxes, one per joint of the skin, or one without a skin. */
    uint32_t first_target_box; /**< Into scene->target_boxes, one per target: of its differences of position. */
} nook_deformable;

typedef enum nook_track_path {
    NOOK_TRACK_TRANSLATION,
    NOOK_TRACK_ROTATION,
    NOOK_TRACK_SCALE,
    NOOK_TRACK_WEIGHTS, /**< Of the morph targets of the node's mesh. */
} nook_track_path;

typedef enum nook_interpolation { NOOK_STEP, NOOK_LINEAR, NOOK_CUBIC_SPLINE } nook_interpolation;

/** What a clip does to one property of one node. */
typedef struct nook_track {
    uint32_t node; /**< Into scene->nodes. */
    nook_track_path path;
    nook_interpolation interpolation;
    uint32_t key_count;  /**< At least 1. */
    uint32_t width;      /**< Numbers of one value: 3, 4, or the number of morph targets. */
    uint32_t first_time; /**< Into scene->track_values: key_count times, seconds, >= 0, each at least the one before. */
    uint32_t
        first_value; /**< Into scene->track_values: width numbers a key; of a cubic spline in-tangent, value, out-tangent. */
} nook_track;

typedef struct nook_clip {
    char *name;                        /**< UTF-8, never NULL. */
    double duration;                   /**< Seconds: the largest time of its keys. */
    uint32_t first_track, track_count; /**< Into scene->tracks. */
} nook_clip;

#ifdef __cplusplus
}
#endif
