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
    if (w->paused != w->told.paused)
        nook_log_info("play: %s", w->paused ? "paused" : "goes on");
    w->told.status = view->status;
    w->told.open = view->open;
    w->told.paused = w->paused;
}

static void set_title(nook_play_window *w, const nook_session_view *view)
{
    static const char *const states[] = { "", " - won", " - lost" };
    char title[512], locks[64] = "", carried[128] = "";
    if (view->locks > 0)
        snprintf(locks, sizeof locks, " - %u of %u locks open", view->open, view->locks);
    if (*view->carried)
        snprintf(carried, sizeof carried, " - carrying %s", view->carried);
    snprintf(title, sizeof title, "Nook - %s%s%s%s%s", w->play.level->title, locks, carried, states[view->status],
             w->paused ? " - paused" : "");
    nook_context_set_title(w->stage.context, title);
}

void nook_play_tell(nook_play_window *w)
{
    const nook_session_view view = nook_session_look(w->play.session);
    tell_carried(&w->told, &view);
    tell_status(w, &view);
    if (w->has_window)
        set_title(w, &view);
}
