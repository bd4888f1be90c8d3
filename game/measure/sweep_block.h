#pragma once
#include "game/measure/sweep.h"
#include "game/settings/line_reader.h"

enum { NOOK_SWEEP_LISTS_MAX = 16, NOOK_SWEEP_VALUES_MAX = 32, NOOK_SWEEP_LINE_MAX = NOOK_LINE_CAPACITY };

/** "rays = 4 8 16" of a block. */
typedef struct nook_sweep_list {
    char text[NOOK_SWEEP_LINE_MAX]; /**< What name and values point into. */
    const char *name;
    const char *values[NOOK_SWEEP_VALUES_MAX];
    uint32_t count; /**< At least 1. */
    unsigned line;  /**< Of the file. */
} nook_sweep_list;

/** A block of a sweep: a technique, and lists of which every combination is a setting. */
typedef struct nook_sweep_block {
    const char *file; /**< For messages. */
    const struct nook_ao_technique *technique;
    nook_sweep_list lists[NOOK_SWEEP_LISTS_MAX];
    uint32_t list_count;
} nook_sweep_block;

/**
 * Adds a line to a block after trying each of its values alone.
 * @param name, values  words; copied
 * @return NOOK_E_FORMAT, said with file and line
 */
nook_result nook_sweep_block_add(nook_sweep_block *block, unsigned line, const char *name, const char *values);

/** Adds the initial setting and every combination to the sweep, each once. @return NOOK_E_FORMAT too many, NOOK_E_MEMORY */
nook_result nook_sweep_block_expand(const nook_sweep_block *block, nook_sweep *sweep);
