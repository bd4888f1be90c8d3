/** test_extremes.h - the extreme cases of one group as a test program, each case a test named as what must hold. */
#pragma once
#include "game/extremes/extremes.h"

/** Runs them on OSMesa with quick = true. @return what main returns */
int test_extremes_main(const nook_extreme_group *group);
