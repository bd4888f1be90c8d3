/** scratch_folder.h - a folder of one's own for files that nobody keeps. */
#pragma once
#include "engine/core/result.h"

typedef struct nook_scratch_folder {
    char path[256];
} nook_scratch_folder;

/** Makes an empty folder under TMPDIR, else /tmp. @return NOOK_E_IO */
nook_result nook_scratch_folder_make(nook_scratch_folder *out_folder);
/** Removes it with all that is in it. What cannot be removed is named by a warning. */
void nook_scratch_folder_remove(nook_scratch_folder *folder);
