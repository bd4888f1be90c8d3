/**
 * material_alpha.h - what of a material is not opaque, for those who bake it, trace it, and voxelise it on the GPU.
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/core/alpha.h"
#include "engine/render/renderer.h"
#include "modules/ao/nook_ao.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @param out  all but which triangles; texels are the scene's @return false: it is opaque, and *out untouched */
bool nook_material_alpha(const nook_scene *scene, const nook_material *material, nook_alpha_part *out);

/**
 * The triangles of a primitive in the buffers of a nook_render_scene, for nook_ao_voxelize; their mask is that of their material.
 * @return false: nothing of them is to be voxelised: they are blended, or masked away by a factor alone
 */
bool nook_primitive_live_range(const nook_scene *scene, const nook_primitive *primitive, nook_ao_triangle_range *out);

/** A mask for each material of the scene. @return free() it; NULL: no memory */
nook_ao_live_mask *nook_scene_live_masks(const nook_scene *scene);
/** Their textures, for the next nook_ao_voxelize. @param masks  of the materials of that scene */
void nook_scene_live_masks_find(const nook_scene *scene, const nook_render_scene *drawn, nook_ao_live_mask *masks);

#ifdef __cplusplus
}
#endif
