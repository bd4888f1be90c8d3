/**
 * measure_run.h - a sweep over scenes: every setting at every site that the journal does not have yet.
 */
#pragma once
#include "engine/platform/context.h"
#include "game/measure/journal.h"
#include "game/measure/measure_progress.h"
#include "game/measure/measure_scenes.h"
#include "game/measure/sweep.h"

typedef struct nook_measure_run {
    const char *root; /**< The folder that holds shaders/. */
    const char *folder;
    const char *cache; /**< Of truths, and of volumes where their baking is not measured; NULL: none. */
    nook_backend backend;
    const char *build;
    const nook_sweep *sweep;
    nook_results *results;          /**< Those that are there: added to. */
    nook_journal *journal;          /**< Open. */
    nook_measure_progress progress; /**< Of the run; filled by it, as are the counts below. */
    size_t reused;                  /**< Rows that were there. */
    size_t sites;                   /**< Opened or reused. */
    size_t failures;                /**< Scenes that could not be measured. */
} nook_measure_run;

/**
 * Measures until it is done or nook_interrupt_asked; the journal then has all that was measured. A scene that cannot be measured is
 * counted, and the next is taken; a journal that cannot be written ends it.
 */
void nook_measure_run_scenes(nook_measure_run *run, const nook_scene_list *scenes);

/** One scene. @return why it could not be measured */
nook_result nook_measure_run_scene(nook_measure_run *run, const char *path);

/** How many rows a sweep has in one scene. */
size_t nook_sweep_row_count(const nook_sweep *sweep);
