/**
 * measure_origin.h - what measured: for rows that stay behind when program, shaders or machine have changed.
 */
#pragma once
#include "engine/core/result.h"
#include <stddef.h>

struct nook_gpu;

enum { NOOK_ORIGIN_BUILD_SIZE = 17, NOOK_ORIGIN_DATE_SIZE = 21, NOOK_ORIGIN_MACHINE_SIZE = 512 };

/**
 * Hash of the running program and of every file in shaders/ and modules/ that it compiles at run time, as 16 hexadecimal digits.
 * @param root  holds these folders
 * @return NOOK_E_IO, NOOK_E_NOT_FOUND, NOOK_E_MEMORY; *out untouched then
 */
nook_result nook_origin_build(const char *root, char out[NOOK_ORIGIN_BUILD_SIZE]);

/** Renderer, processor and how many of its cores this process may use. @return out */
const char *nook_origin_machine(const struct nook_gpu *gpu, char out[NOOK_ORIGIN_MACHINE_SIZE]);

/** Now, ISO 8601, UTC, to the second. @return out */
const char *nook_origin_date(char out[NOOK_ORIGIN_DATE_SIZE]);
