/**
 * debug_sections_internal.h - the parts of an ELF file that hold what the compiler knew about its types. Not for use outside engine/module.
 */
#pragma once
#include "engine/core/file.h"

/** Borrowed bytes. Zeroed: there are none. */
typedef struct nook_section {
    const uint8_t *bytes;
    size_t size;
} nook_section;

typedef struct nook_debug_sections {
    nook_file file; /**< Owned; the others point into it. */
    nook_section info, abbrev, str, line_str, str_offsets;
} nook_debug_sections;

/**
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY; NOOK_E_FORMAT no ELF file of 64 bits of this machine's byte order;
 *         NOOK_E_VERSION built without debug information. Nothing to free then
 */
nook_result nook_debug_sections_read(const char *path, nook_debug_sections *out_sections);
void nook_debug_sections_free(nook_debug_sections *sections);
