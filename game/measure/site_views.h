/**
 * site_views.h - the other cameras of a site: a second one far to the side, and a short path as a camera in motion takes it.
 */
#pragma once
#include "game/compare/second_view.h"
#include "game/compare/surfaces.h"

struct nook_stage;

/** Views of the path, the site's own the first. */
#define NOOK_PATH_VIEWS 4
/**
 * Between consecutive views, about the point in the middle of the picture: a camera that takes 12 seconds for a round at 60
 * pictures a second.
 */
#define NOOK_PATH_STEP_DEGREES 0.5

typedef struct nook_site_views {
    nook_second_view second;
    nook_match second_match; /**< From the site's pixels to the second's. Owned. */
    nook_camera path[NOOK_PATH_VIEWS];
    nook_match path_matches[NOOK_PATH_VIEWS - 1]; /**< From each to the next. Owned. */
} nook_site_views;

/**
 * Chooses them and finds their common points. The stage's frame is another camera's afterwards.
 * @param first  the site's own view
 * @return as nook_second_view_choose; *out_views is zero then
 */
nook_result nook_site_views_create(struct nook_stage *stage, const nook_camera *camera, const nook_surfaces *first,
                                   nook_site_views *out_views);
void nook_site_views_free(nook_site_views *views); /**< Zeroed ones are allowed. */
