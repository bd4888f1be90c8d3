#pragma once
#include "engine/core/result.h"
#include <stddef.h>

/** Paths of scene files. */
typedef struct nook_scene_list {
    char **paths; /**< Owned. */
    size_t count;
} nook_scene_list;

/** Adds one. @return NOOK_E_MEMORY */
nook_result nook_scene_list_add(nook_scene_list *list, const char *path);
/**
 * Adds every .glb and .gltf of a folder and of the folders in it, in the order of their names.
 * @return NOOK_E_IO, NOOK_E_NOT_FOUND there is none, NOOK_E_MEMORY
 */
nook_result nook_scene_list_add_folder(nook_scene_list *list, const char *folder);
void nook_scene_list_free(nook_scene_list *list); /**< Zeroed ones are allowed. */
