#pragma once
#include "game/measure/journal.h"

/**
 * Takes in the rows, sites and pictures of another folder that these results lack, or have of another build than `build` while the
 * other folder has them of it.
 * @param folder  that of `results` and `journal`
 * @param out_taken  rows
 * @param out_left   rows that are there already, of the same machine
 * @return NOOK_E_NOT_FOUND no journal there, or why reading or writing failed
 */
nook_result nook_measure_merge(const char *from, const char *folder, const char *build, nook_results *results,
                               nook_journal *journal, size_t *out_taken, size_t *out_left);

/** Takes the rows of other builds out of the results. @return how many */
size_t nook_measure_drop_other_builds(nook_results *results, const char *build);
