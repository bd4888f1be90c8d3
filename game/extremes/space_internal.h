/** space_internal.h - the cases of the group space that have a file of their own. */
#pragma once
#include "game/extremes/extremes.h"

/* drawn_cases.c */
nook_result nook_space_run_drawn(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_space_run_drawn_pictures(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_space_run_far_vertices(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_space_run_far_vertices_pictures(const nook_extremes *extremes, nook_extreme_found *out_found);
