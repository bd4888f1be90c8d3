/**
 * gpu_internal.h - what the files of engine/gpu share about a device.
 */
#pragma once
#include "engine/gpu/gpu.h"

enum { PROGRAM_STAGES_MAX = 2, PROGRAM_LOCATIONS = 32 };

/** A program that was asked for, built or not. Its place in the cache never changes: handle - 1. */
typedef struct program_entry {
    char *paths[PROGRAM_STAGES_MAX]; /**< Owned; the second is NULL for compute. With defines: what it is found by. */
    char *defines;                   /**< Owned. */
    uint32_t id;                     /**< GL's name; 0: it has never been built. */
    uint32_t version;                /**< How often it has been built. */
    uint32_t locations;              /**< Bit n: the program has a uniform at location n. */
    char **files;                    /**< Owned: what it was made of, relative to the source root. */
    uint32_t file_count;
    char *layout;       /**< Owned: what C code relies on, see program_layout_internal.h. NULL before it was built. */
    char *trouble;      /**< Owned: lines that say why the last build failed; NULL: it did not. */
    nook_result result; /**< Of the last build. */
} program_entry;

/** The rows that C code writes into the uniform block of a params.def. */
typedef struct program_rows {
    char *path; /**< Owned; relative to the source root. */
    char *rows; /**< Owned; lines of program_layout_internal.h without their group. */
} program_rows;

struct nook_gpu_cache {
    nook_gl gl;
    char *source_root;       /**< Owned. */
    program_entry *programs; /**< Owned; a few dozen at most, searched in order. */
    size_t program_count, program_capacity;
    uint32_t replaced;    /**< Programs that took the place of others. */
    size_t program_used;  /**< Into programs: the one that uniforms are set of. */
    program_rows *rows;   /**< Owned. */
    size_t rows_count;    /**< A handful, searched in order. */
    float max_anisotropy; /**< 1: the driver has none. */
    bool listens;         /**< The debug callback is ours. */
    bool error_pending;   /**< An error was logged that nook_gpu_check has not told yet. */
};

/** Reads and logs what GL has raised, and keeps it for nook_gpu_check. @return the last error, 0 for none */
uint32_t nook_gpu_take_errors(nook_gpu *gpu, const char *where);

/** Deletes all programs of the cache. */
void nook_program_cache_free(nook_gpu *gpu);
