#pragma once
#include "game/measure/truth.h"

/**
 * The sums of an earlier run. A file that is damaged, or of another picture, is one warning and left alone.
 * @return whether there were any; the truth is untouched otherwise
 */
bool nook_truth_file_read(nook_truth *truth);

/** Keeps the sums. Where that fails: one warning for each truth, no more. */
void nook_truth_file_write(nook_truth *truth);
