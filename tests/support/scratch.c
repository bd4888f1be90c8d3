#include "tests/support/scratch.h"
#include "engine/core/file.h"
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

char *nook_scratch_path(char *out, size_t capacity, const char *name)
{
    const char *folder = getenv("NOOK_TEST_TMP");
    char own[64];
    if (!folder || !*folder) {
        snprintf(own, sizeof own, "/tmp/nook_test.%ld", (long)getpid());
        nook_directory_make(own);
        folder = own;
    }
    return nook_path_join(out, capacity, folder, name);
}
