#include "game/live/history.h"
#include <string.h>

static nook_live_views *state_at(nook_live_history *history, uint32_t at)
{
    return &history->states[(history->first + at) % NOOK_LIVE_HISTORY_MAX];
}

void nook_live_history_push(nook_live_history *history, const nook_live_views *views)
{
    if (history->count > 0 && memcmp(state_at(history, history->at), views, sizeof *views) == 0)
        return;
    if (history->count > 0)
        history->count = history->at + 1;
    if (history->count == NOOK_LIVE_HISTORY_MAX) {
        history->first = (history->first + 1) % NOOK_LIVE_HISTORY_MAX;
        history->count--;
    }
    history->at = history->count++;
    memcpy(state_at(history, history->at), views, sizeof *views);
}

bool nook_live_history_undo(nook_live_history *history, nook_live_views *views)
{
    if (history->count == 0 || history->at == 0)
        return false;
    memcpy(views, state_at(history, --history->at), sizeof *views);
    return true;
}

bool nook_live_history_redo(nook_live_history *history, nook_live_views *views)
{
    if (history->at + 1 >= history->count)
        return false;
    memcpy(views, state_at(history, ++history->at), sizeof *views);
    return true;
}
