/** buffer_internal.h - the cases of the group buffers that have a file of their own. */
#pragma once
#include "game/extremes/edge_pictures.h"

/** The pictures of the usual scene with this kind of G-buffer, in the size that all cases compare at. */
nook_result nook_buffer_take(const nook_extremes *extremes, const nook_edge_scene_desc *desc, nook_extreme_found *found,
                             const char *where, nook_edge_pictures *out_pictures);

/* layout_cases.c */
nook_result nook_buffer_run_no_normals(const nook_extremes *extremes, nook_extreme_found *out_found);
nook_result nook_buffer_run_flipped(const nook_extremes *extremes, nook_extreme_found *out_found);
