/**
 * file_watch.h - which files have changed on disk, asked once a frame without waiting and without a thread.
 *
 * Folders are watched, not files: an editor that saves by renaming a new file over the old one ends the watch of the file, but
 * not of its folder. A path is given when it and all others have been left alone for a moment, so that a file is not read
 * while it is written, and files saved together come together.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NOOK_FILE_WATCH_SETTLE_MS = 25,   /**< Without any change, until the changes are given. */
    NOOK_FILE_WATCH_LONGEST_MS = 500, /**< From the first change, even when changes do not end. */
};

typedef struct nook_file_watch nook_file_watch;

typedef struct nook_file_watch_desc {
    const char *root;           /**< Folder that all paths are relative to. Copied. */
    const char *const *folders; /**< Of root, watched; NULL: root itself. Copied. */
    size_t folder_count;
    bool flat; /**< True: without the folders in them. */
} nook_file_watch_desc;

/**
 * Starts watching the folders with all folders in them, those that come later too. Folders whose name starts with a dot
 * and links to folders are left out (a folder of the description itself may be a link).
 * @return NOOK_E_NOT_FOUND a folder is missing; NOOK_E_IO it cannot be read; NOOK_E_MEMORY the system's limit of watches or
 *         of open files is reached (the line says which setting it is); *out_watch is NULL then
 */
nook_result nook_file_watch_create(const nook_file_watch_desc *desc, nook_file_watch **out_watch);
void nook_file_watch_destroy(nook_file_watch *watch); /**< NULL is allowed. */

/**
 * What a poll calls for a file that was written, made, renamed, touched or deleted.
 * @param path relative to root, "folder/name"; of a folder that is gone its own path, for all that was in it. Valid in the call.
 */
typedef void nook_file_changed(void *user, const char *path);

/**
 * Gives each path that has changed since the last poll once, sorted; returns at once. A folder of the description that is
 * deleted is watched again when it is back, and all its files are given then. Of more than 16384 changes between two
 * polls some may be lost. `changed` must not use the watch.
 * @return how many paths were given
 */
size_t nook_file_watch_poll(nook_file_watch *watch, nook_file_changed *changed, void *user);

/**
 * How long what the last poll has seen, and not given, must be left alone yet: who has nothing better to do than a picture without it
 * waits that long and polls again. 0: nothing is held back.
 */
double nook_file_watch_settling_ms(const nook_file_watch *watch);

/** When the first of the changes that the last poll gave was made, by nook_clock_ms; 0 before there was one. */
double nook_file_watch_changed_ms(const nook_file_watch *watch);

/** Folders that are watched now: for reports. */
size_t nook_file_watch_folder_count(const nook_file_watch *watch);

#ifdef __cplusplus
}
#endif
