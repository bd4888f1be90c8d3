#pragma once
#include <stddef.h>

/**
 * The path of a file in this program's scratch folder, which ./nook test makes and empties (NOOK_TEST_TMP; the current
 * folder when a program is run by hand).
 * @return out
 */
char *nook_scratch_path(char *out, size_t capacity, const char *name);
