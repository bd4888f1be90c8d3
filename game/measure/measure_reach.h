#pragma once
#include "game/measure/measure_run.h"
#include "game/measure/measure_views.h"
#include "game/stage.h"

/**
 * Everything of a sweep at one r_max and falloff of one scene: all cameras, all settings, ordered so that volumes are baked once
 * for each resolution. Rows that the results have are left alone.
 * @param names  the row without camera, setting and sample: its texts are borrowed
 */
nook_result nook_measure_reach(nook_measure_run *run, nook_stage *stage, nook_measure_views *views,
                               const nook_result_row *names);
