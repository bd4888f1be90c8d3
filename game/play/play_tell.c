#include "engine/core/log.h"
#include "game/play/play_window.h"
#include <stdio.h>
#include <string.h>

static void tell_carried(nook_play_told *told, const nook_session_view *view)
{
    if (strcmp(told->carried, view->carried) == 0)
        return;
    if (*told->carried)
        nook_log_info("play: let go of %s", told->carried);
    if (*view->carried)
        nook_log_info("play: took %s", view->carried);
    snprintf(told->carried, sizeof told->carried, "%s", view->carried);
}

static void tell_status(nook_play_window *w, const nook_session_view *view)
{
    if (view->status != w->told.status && view->status != NOOK_SESSION_PLAYING)
        nook_log_info("play: %s after %.1f s", view->status == NOOK_SESSION_WON ? "won" : "lost",
                      (double)view->ticks * NOOK_PHYSICS_STEP);
    if (view->open != w->told.open)
        nook_log_info("play: %u of %u locks open", view->open, view->locks);
    w->told.status = view->status;
    w->told.open = view->open;
}

/* Ticks are those of the frame before where it goes on: how many there were while it stood still. */
static void tell_standing(nook_play_window *w, const nook_session_view *view)
{
    static const char *const states[] = { "goes on", "paused", "frozen" };
    nook_play_standing standing = nook_play_standing_of(w);
    uint64_t ticks = standing == NOOK_PLAY_GOES_ON ? w->told.ticks : view->ticks;
    if (standing != w->told.standing)
        nook_log_info("play: %s after %llu ticks", states[standing], (unsigned long long)ticks);
    w->told.standing = standing;
    w->told.ticks = view->ticks;
}

static void set_title(nook_play_window *w, const nook_session_view *view)
{
    static const char *const states[] = { "", " - won", " - lost" };
    static const char *const standings[] = { "", " - paused", " - frozen" };
    char title[512], locks[64] = "", carried[128] = "";
    if (view->locks > 0)
        snprintf(locks, sizeof locks, " - %u of %u locks open", view->open, view->locks);
    if (*view->carried)
        snprintf(carried, sizeof carried, " - carrying %s", view->carried);
    snprintf(title, sizeof title, "Nook - %s%s%s%s%s", w->play.level->title, locks, carried, states[view->status],
             standings[nook_play_standing_of(w)]);
    nook_context_set_title(w->stage.context, title);
}

nook_play_standing nook_play_standing_of(const nook_play_window *window)
{
    if (nook_live_frozen(window->live))
        return NOOK_PLAY_FROZEN;
    return window->paused ? NOOK_PLAY_PAUSED : NOOK_PLAY_GOES_ON;
}

void nook_play_tell(nook_play_window *w)
{
    const nook_session_view view = nook_session_look(w->play.session);
    tell_carried(&w->told, &view);
    tell_status(w, &view);
    tell_standing(w, &view);
    if (w->has_window)
        set_title(w, &view);
}
