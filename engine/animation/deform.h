/**
 * deform.h - vertices of a mesh in a pose, on the CPU: for what must have triangles that stand (volumes, the reference), and what
 * shaders/render/deform.comp.glsl is compared with.
 */
#pragma once
#include "engine/animation/scene_pose.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Morphs, then skins. Normals take the inverse transpose of the blended matrix; those of primitives without normals in the
 * file are made from the posed triangles.
 * @param rest  the deformable's vertices at rest: vertex_count of them @param out  may be `rest`
 */
void nook_deform(const nook_scene_pose *pose, uint32_t deformable, const nook_vertex *rest, nook_vertex *out);

#ifdef __cplusplus
}
#endif
