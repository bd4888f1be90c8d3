/** folder_walk.h - the files of a folder and of the folders in it, in the order of their names, without hidden ones. */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>

/** What is done with the files found. */
typedef struct nook_folder_visitor {
    bool (*wants)(const char *path); /**< Whether it is one of those looked for. */
    nook_result (*take)(void *user, const char *path);
    void *user;
} nook_folder_visitor;

/** @param depth  of folders within folders; 0: none @return NOOK_E_IO, or what `take` returned, which ends the walk */
nook_result nook_folder_walk(const char *folder, int depth, const nook_folder_visitor *visitor);
