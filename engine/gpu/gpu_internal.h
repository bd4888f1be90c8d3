/**
 * gpu_internal.h - what the files of engine/gpu share about a device.
 */
#pragma once
#include "engine/gpu/gpu.h"

typedef struct nook_program_entry {
    char *identity; /**< Owned: paths and defines, one after another. */
    uint32_t id;
} nook_program_entry;

struct nook_gpu_cache {
    nook_gl gl;
    char *source_root;            /**< Owned. */
    nook_program_entry *programs; /**< Owned; a few dozen at most, searched in order. */
    size_t program_count, program_capacity;
    float max_anisotropy; /**< 1: the driver has none. */
    bool listens;         /**< The debug callback is ours. */
    bool error_pending;   /**< An error was logged that nook_gpu_check has not told yet. */
};

/** Reads and logs what GL has raised, and keeps it for nook_gpu_check. @return the last error, 0 for none */
uint32_t nook_gpu_take_errors(nook_gpu *gpu, const char *where);

/** Deletes all programs of the cache. */
void nook_program_cache_free(nook_gpu *gpu);
