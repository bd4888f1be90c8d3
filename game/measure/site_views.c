#include "game/measure/site_views.h"
#include "game/stage.h"

static nook_result match_path(nook_stage *stage, const nook_surfaces *first, nook_site_views *views)
{
    nook_surfaces before = { 0 }, next = { 0 };
    nook_result result = NOOK_OK;
    for (int i = 1; i < NOOK_PATH_VIEWS && result == NOOK_OK; i++) {
        result = nook_surfaces_draw(stage, &views->path[i], &next);
        if (result == NOOK_OK)
            result = nook_match_create(i == 1 ? &first->seen : &before.seen, &next.seen, &views->path_matches[i - 1]);
        nook_surfaces_free(&before);
        before = next;
    }
    nook_surfaces_free(&before);
    return result;
}

nook_result nook_site_views_create(nook_stage *stage, const nook_camera *camera, const nook_surfaces *first,
                                   nook_site_views *out_views)
{
    nook_site_views views = { 0 };
    double distance = 0.0;
    *out_views = views;
    nook_result result = nook_middle_distance(first->distances, stage->width, stage->height, &distance);
    if (result == NOOK_OK)
        result = nook_second_view_choose(stage, camera, &views.second, &views.second_match);
    for (int i = 0; i < NOOK_PATH_VIEWS; i++)
        views.path[i] = nook_camera_turn(camera, distance, i * NOOK_PATH_STEP_DEGREES);
    if (result == NOOK_OK)
        result = match_path(stage, first, &views);
    if (result != NOOK_OK) {
        nook_site_views_free(&views);
        return result;
    }
    *out_views = views;
    return NOOK_OK;
}

void nook_site_views_free(nook_site_views *views)
{
    nook_match_free(&views->second_match);
    for (int i = 0; i < NOOK_PATH_VIEWS - 1; i++)
        nook_match_free(&views->path_matches[i]);
    *views = (nook_site_views){ 0 };
}
