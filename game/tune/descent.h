/**
 * descent.h - from one setting of a technique to a better one: single steps to learn from, then what a fit of all that is known promises.
 */
#pragma once
#include "game/tune/trials.h"

/**
 * Improves on the technique's best trial for as long as that leads anywhere, or until no setting may be tried any more.
 * @return what measure returned
 */
nook_result nook_tune_descend(nook_tune_trials *trials, uint32_t technique);
