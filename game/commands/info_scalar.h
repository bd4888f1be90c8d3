#pragma once
#include <stdbool.h>

/** `nook info` for .nrrd and .nhdr files. @return a NOOK_EXIT_* code */
int nook_info_scalar_volume(const char *path, bool as_json);
