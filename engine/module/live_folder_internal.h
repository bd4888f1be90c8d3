/**
 * live_folder_internal.h - the folder in which whoever builds (./nook watch) and the program that runs meet. Not for use outside engine/module.
 *
 *   <name>.so            a library as it was built last; a new file takes its place by rename
 *   build                written after the libraries: "12 ok", or "12 failed" and what the compiler said
 *   <name>.<pid>.<n>.so  the copy that a running program has loaded
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { NOOK_LIVE_PATH_MAX = 4096, NOOK_LIVE_TEXT_MAX = 2048 };

/** Which file, and in which state. Zeroed: there is none. */
typedef struct nook_file_mark {
    uint64_t device, node, size;
    int64_t seconds, nanoseconds; /**< Of its last change. */
} nook_file_mark;

nook_file_mark nook_file_mark_of(const char *path); /**< Zero when there is no such file. */
bool nook_file_mark_same(nook_file_mark a, nook_file_mark b);

typedef struct nook_live_folder {
    char path[NOOK_LIVE_PATH_MAX];
    nook_file_mark build; /**< Of the file as it was read last. */
    uint32_t copies;      /**< So far, for their numbers. */
} nook_live_folder;

/** What the file "build" says. */
typedef struct nook_live_build {
    bool failed;
    char text[NOOK_LIVE_TEXT_MAX]; /**< What the compiler said, cut to this; "" when all is well. */
} nook_live_build;

/** Removes copies that programs left behind which run no more. What was built before counts as known. */
void nook_live_folder_open(nook_live_folder *folder, const char *path);
/** @return true, once, when something was built since open or the last call; *out_build is untouched otherwise */
bool nook_live_folder_poll(nook_live_folder *folder, nook_live_build *out_build);

/** "<folder>/<name>.so" @return out, of NOOK_LIVE_PATH_MAX bytes */
char *nook_live_folder_library(const nook_live_folder *folder, const char *name, char *out);
/** Copies the library of that name under a number of its own. @param out_path  of NOOK_LIVE_PATH_MAX bytes @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY */
nook_result nook_live_folder_copy(nook_live_folder *folder, const char *name, char *out_path);
