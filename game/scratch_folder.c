#define _XOPEN_SOURCE 700 /* nftw */
#include "game/scratch_folder.h"
#include "engine/core/log.h"
#include <errno.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FOLDERS_OPEN = 8 };

nook_result nook_scratch_folder_make(nook_scratch_folder *out_folder)
{
    nook_scratch_folder folder;
    const char *parent = getenv("TMPDIR");
    int size = snprintf(folder.path, sizeof folder.path, "%s/nook.XXXXXX", parent && *parent ? parent : "/tmp");
    if (size >= (int)sizeof folder.path)
        return nook_fail(NOOK_E_IO, "%s: too long a path for temporary files; set TMPDIR", parent);
    if (!mkdtemp(folder.path))
        return nook_fail(NOOK_E_IO, "%s: cannot be made: %s; set TMPDIR to a folder that can be written", folder.path,
                         strerror(errno));
    *out_folder = folder;
    return NOOK_OK;
}

static int remove_one(const char *path, const struct stat *status, int type, struct FTW *where)
{
    (void)status, (void)type, (void)where;
    if (remove(path) != 0)
        nook_log_warning("%s: cannot be removed: %s", path, strerror(errno));
    return 0;
}

void nook_scratch_folder_remove(nook_scratch_folder *folder)
{
    nftw(folder->path, remove_one, FOLDERS_OPEN, FTW_DEPTH | FTW_PHYS);
    folder->path[0] = '\0';
}
