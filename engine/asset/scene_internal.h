/** scene_internal.h - inside engine/asset only: what all makers of scenes share. */
#pragma once
#include "engine/asset/scene.h"
#include "engine/asset/scene_join.h"
#include "engine/core/log.h"

/** Logs a warning, unless the scene is silent, and keeps its text in the scene. From the 100th on they are neither kept nor logged. NULL: logs it. */
void nook_scene_warn(nook_scene *scene, const char *format, ...) NOOK_PRINTF(2, 3);

/** Remembers a file that the scene is made of, once; also one that could not be read. @return false, logged: no memory */
bool nook_scene_add_file(nook_scene *scene, const char *path);
/** Takes over the extinction of a medium on success. @return NOOK_E_FORMAT too many; NOOK_E_MEMORY */
nook_result nook_scene_add_density(nook_scene *scene, const char *name, const nook_medium *medium,
                                   const nook_matrix *world_from_local);

/** A copy; "" for NULL. @return NULL, logged, when out of memory */
char *nook_scene_copy_string(const char *text);

/** Array of `count` zeroed elements; one is allocated for none. @return NULL, logged, when out of memory */
void *nook_scene_allocate(const char *path, size_t count, size_t element_size);

/** Fills the default material of glTF: white, metallic 1, roughness 1, no images. name is left NULL. */
void nook_scene_default_material(nook_material *out_material);

/**
 * Room for what moves of the parts whose nodes come, in a joined scene. @param nodes  of the joined scene
 * @return NOOK_E_MEMORY, logged
 */
nook_result nook_scene_allocate_motion(nook_scene *scene, const nook_scene_part *parts, uint32_t count, size_t nodes);
/**
 * Appends what moves of one part, whose nodes were appended from `node` on, its meshes from `mesh`, its vertices from `vertex`.
 * @return NOOK_E_MEMORY, logged
 */
nook_result nook_scene_append_motion(nook_scene *to, const nook_scene *from, uint32_t node, uint32_t mesh,
                                     uint32_t vertex);

/**
 * Gives vertices whose normal is zero or not finite the area-weighted mean of their triangles; all others become unit.
 * @return how many were broken
 */
uint32_t nook_scene_repair_normals(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                                   uint32_t index_count);
/** Tangents from texture coordinates (Lengyel 2001); where those are degenerate, any direction in the surface. */
void nook_scene_make_tangents(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                              uint32_t index_count);
