/** scene_internal.h - inside engine/asset only: what all makers of scenes share. */
#pragma once
#include "engine/asset/scene.h"
#include "engine/core/log.h"

/** Logs a warning and keeps its text in the scene. From the 100th on they are neither kept nor logged. */
void nook_scene_warn(nook_scene *scene, const char *format, ...) NOOK_PRINTF(2, 3);

/** Remembers a file that the scene is made of, once; also one that could not be read. @return false, logged: no memory */
bool nook_scene_add_file(nook_scene *scene, const char *path);

/** A copy; "" for NULL. @return NULL, logged, when out of memory */
char *nook_scene_copy_string(const char *text);

/** Array of `count` zeroed elements; one is allocated for none. @return NULL, logged, when out of memory */
void *nook_scene_allocate(const char *path, size_t count, size_t element_size);

/** Fills the default material of glTF: white, metallic 1, roughness 1, no images. name is left NULL. */
void nook_scene_default_material(nook_material *out_material);

/** Mesh boxes and the world box, triangle_count, and the checks of what is drawn. @return NOOK_E_FORMAT when too large */
nook_result nook_scene_finish(nook_scene *scene);

/** Replaces the normals of these triangles' vertices by those of the faces; the vertices must not be shared. */
void nook_scene_make_flat_normals(nook_vertex *vertices, uint32_t vertex_count);
/**
 * Gives vertices whose normal is zero or not finite the area-weighted mean of their triangles; all others become unit.
 * @return how many were broken
 */
uint32_t nook_scene_repair_normals(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                                   uint32_t index_count);
/** Tangents from texture coordinates (Lengyel 2001); where those are degenerate, any direction in the surface. */
void nook_scene_make_tangents(nook_vertex *vertices, uint32_t vertex_count, const uint32_t *indices,
                              uint32_t index_count);
