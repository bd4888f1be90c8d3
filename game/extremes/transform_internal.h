/** transform_internal.h - the cases of the group transforms that have files of their own. */
#pragma once
#include "game/extremes/extremes.h"

/* occluder_matrix_cases.c */
nook_result nook_transform_run_uploaded(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_transform_run_left_out(const nook_extremes *extremes, nook_extreme_found *out_found);
/* transform_truth_cases.c */
nook_result nook_transform_run_instances(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_transform_run_volume(const nook_extremes *extremes, nook_extreme_found *out_found);
