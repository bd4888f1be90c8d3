/**
 * scene_pose.h - a scene at a moment of its clips: where its nodes are, what its skins and morph targets are given.
 *
 *   create -> (rest -> apply clips -> finish) as often as wanted -> destroy
 *
 * Applying a clip is a function of the pose, the clip and the time alone; a pose that was begun anew has no memory of the one before.
 * Composed in double; joint matrices are relative to their mesh and only they are float (docs/animation.md).
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/core/result.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A matrix of a joint, as shaders read it: three rows of an affine matrix, mesh from mesh at rest. */
typedef struct nook_joint_matrix {
    float row[3][4];
} nook_joint_matrix;

/** What deforms one mesh in one pose. Borrows from the pose. */
typedef struct nook_mesh_pose {
    const nook_joint_matrix *joints; /**< One per joint of the skin; NULL without a skin. */
    const float *weights;            /**< One per morph target. */
    nook_box box;                    /**< Holds every vertex of the mesh. */
} nook_mesh_pose;

typedef struct nook_scene_pose {
    const nook_scene *scene;       /**< Borrowed. */
    nook_matrix *world_from_local; /**< Per node of the scene. Of a skinned mesh: the space its pose is relative to. */
    nook_mesh_pose *meshes;        /**< Per deformable of the scene. */
    struct nook_node_parts *parts; /**< Per node: translation, rotation, scale, as clips have set them. */
    double *weights;               /**< As scene->morph_weights. */
    nook_joint_matrix *joints;     /**< Of all deformables. */
    float *morph;                  /**< As scene->morph_weights, in float. */
    uint32_t *weights_of_node;     /**< Per node, where its weights begin; NOOK_NONE for none. */
} nook_scene_pose;

/** Allocates all that a pose of this scene needs, at rest and finished. @return NOOK_E_MEMORY; *out_pose is NULL then */
nook_result nook_scene_pose_create(const nook_scene *scene, nook_scene_pose **out_pose);
void nook_scene_pose_destroy(nook_scene_pose *pose); /**< NULL is allowed. */

/** Every node and weight as the file has it. */
void nook_scene_pose_rest(nook_scene_pose *pose);
/**
 * Sets what a clip moves to its values at a time. Before its first key and behind its last one a track holds.
 * @param clip  into scene->clips @param seconds  finite
 */
void nook_scene_pose_apply(nook_scene_pose *pose, uint32_t clip, double seconds);
/** Composes transforms of nodes, joint matrices, boxes. */
void nook_scene_pose_finish(nook_scene_pose *pose);

/**
 * The time inside a clip. @param duration  of the clip, seconds @param loop  goes around; false: holds at both ends
 * @return [0, duration); duration itself only where it holds
 */
double nook_clip_time(double duration, double seconds, bool loop);

/** A clip by its name. @return NOOK_NONE */
uint32_t nook_clip_find(const nook_scene *scene, const char *name);

#ifdef __cplusplus
}
#endif
