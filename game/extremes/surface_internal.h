/** surface_internal.h - the cases of the group surfaces that have files of their own. */
#pragma once
#include "game/extremes/extremes.h"

/* normal_cases.c */
nook_result nook_surface_run_codes(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_surface_run_rebuilt(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_surface_run_rubbish_normals(const nook_extremes *extremes, nook_extreme_found *out_found);
/* depth_cases.c */
nook_result nook_surface_run_rubbish_depths(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_surface_run_background(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_surface_run_sizes(const nook_extremes *extremes, nook_extreme_found *out_found);
