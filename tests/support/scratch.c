#include "tests/support/scratch.h"
#include "engine/core/file.h"
#include <stdlib.h>

char *nook_scratch_path(char *out, size_t capacity, const char *name)
{
    const char *folder = getenv("NOOK_TEST_TMP");
    return nook_path_join(out, capacity, folder && *folder ? folder : ".", name);
}
