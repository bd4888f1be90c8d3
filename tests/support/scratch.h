#pragma once
#include <stddef.h>

/**
 * The path of a file in this program's scratch folder, which ./nook test makes and empties (NOOK_TEST_TMP; a new
 * folder in /tmp, which stays, when a program is run by hand).
 * @return out
 */
char *nook_scratch_path(char *out, size_t capacity, const char *name);
