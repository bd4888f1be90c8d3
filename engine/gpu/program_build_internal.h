/**
 * program_build_internal.h - shader files to a linked program, aside: nothing of the device changes until the program is taken.
 */
#pragma once
#include "engine/gpu/gpu_internal.h"

enum { PROGRAM_TROUBLE_CAPACITY = 8192 };

/** What became of a build. Release with nook_program_build_free. */
typedef struct program_build {
    GLuint id;          /**< 0 when it failed. */
    uint32_t locations; /**< As in program_entry. */
    char **files;       /**< As in program_entry; on failure those that were read. */
    uint32_t file_count;
    char *layout;
    nook_result result;
    char trouble
        [PROGRAM_TROUBLE_CAPACITY]; /**< On failure lines that say why, each with its newline. Nothing is logged. */
} program_build;

/** Reads, compiles, links and checks what the entry asks for, against the layout that it has. */
void nook_program_build(nook_gpu *gpu, const program_entry *wanted, program_build *out_build);
void nook_program_build_free(nook_gpu *gpu, program_build *build);

/** Adds one line to lines of text that do not hold it yet; what does not fit is left out. @return false: it was there */
bool nook_program_add_line(char *lines, size_t capacity, const char *line, size_t length);
