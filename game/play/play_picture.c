#include "game/play/play_picture.h"

/* Frames a second that the picture gets smaller for; 0: it does not. Films and frames of a given length are as large as was asked for. */
static double wanted_rate(const nook_play_window *w)
{
    if (w->frame_rate > 0.0)
        return w->frame_rate;
    return w->has_window && !w->captures && !(w->frame_seconds > 0.0) ? w->preferences.frame_rate : 0.0;
}

static bool shows_one_lit_picture(const nook_play_window *w)
{
    const nook_live_views *views = nook_live_state(w->live);
    return views->count == 1 && views->views[0].mode == NOOK_LIVE_LIT;
}

void nook_play_picture_learn(nook_play_window *w, double frame_ms, bool goes_on)
{
    double rate = shows_one_lit_picture(w) ? wanted_rate(w) : 0.0;
    double ms = nook_picture_time_take(&w->picture_time, w->stage.gpu, frame_ms);
    if (nook_live_frozen(w->live))
        return; /* its truth is of these pixels */
    if (!(rate > 0.0))
        (void)nook_picture_fit_reset(&w->picture_fit);
    else if (goes_on && ms > 0.0)
        (void)nook_picture_fit_add(&w->picture_fit, ms, 1000.0 / rate);
}

nook_result nook_play_picture_fit(nook_play_window *w)
{
    const uint32_t whole[2] = { w->width >> w->preferences.picture_scale, w->height >> w->preferences.picture_scale };
    if (whole[0] != w->whole[0] || whole[1] != w->whole[1]) {
        (void)nook_picture_fit_reset(&w->picture_fit); /* what frames of another window took says nothing */
        w->whole[0] = whole[0], w->whole[1] = whole[1];
    }
    uint32_t width = nook_picture_fit_side(&w->picture_fit, whole[0]);
    uint32_t height = nook_picture_fit_side(&w->picture_fit, whole[1]);
    if (width == w->stage.width && height == w->stage.height)
        return NOOK_OK;
    return nook_stage_set_size(&w->stage, width, height);
}
