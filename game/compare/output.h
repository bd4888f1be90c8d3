/**
 * output.h - a folder of files that belong together: they appear in it all at once, or not at all.
 *
 * What is written goes into a hidden folder inside it first. The commit puts it in place with the index, the file that
 * speaks of the others, last; the old index goes first, so that no index ever stands beside files of another run.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>

enum { NOOK_OUTPUT_PATH_MAX = 4096 };

typedef struct nook_output {
    char folder[NOOK_OUTPUT_PATH_MAX];
    char staging[NOOK_OUTPUT_PATH_MAX]; /**< folder/.tmp-PID; where to write. */
} nook_output;

/** Makes the folder and tries that it can be written to; leaves nothing else in it. @return NOOK_E_IO */
nook_result nook_output_prepare(const char *folder);

/**
 * Makes the hidden folder. Until commit or discard, SIGINT and SIGTERM wait: nook_output_interrupted tells of them, and the
 * end of the two raises them again. One output at a time.
 * @return NOOK_E_IO; *out_output is untouched then
 */
nook_result nook_output_open(const char *folder, nook_output *out_output);

/** Where to write a file of that name. @return out */
const char *nook_output_path(const nook_output *output, const char *name, char out[NOOK_OUTPUT_PATH_MAX]);

/** Someone wants the program to end: discard. */
bool nook_output_interrupted(void);

/**
 * Puts every file in place.
 * @param index  the name of the file that comes last. When the folder has one already, the files of that run which `ours`
 *               knows and which were not written again are removed.
 * @param ours   by a file's name; may be NULL
 * @return NOOK_E_IO; nothing was changed when a directory stands where a file belongs
 */
nook_result nook_output_commit(nook_output *output, const char *index, bool (*ours)(void *user, const char *name),
                               void *user);

/** Removes the hidden folder with all in it. */
void nook_output_discard(nook_output *output);
