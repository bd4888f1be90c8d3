#pragma once
#include "game/live/live_views.h"

enum { NOOK_LIVE_HISTORY_MAX = 64 };

/** What the views were: a ring of the last states. Zero it before the first push. */
typedef struct nook_live_history {
    nook_live_views states[NOOK_LIVE_HISTORY_MAX];
    uint32_t first; /**< Place of the oldest. */
    uint32_t count; /**< How many there are. */
    uint32_t at;    /**< The present one, counted from the oldest; below count. */
} nook_live_history;

/** Remembers a state that differs from the present one; what was taken back is forgotten, and so is the oldest of a full ring. */
void nook_live_history_push(nook_live_history *history, const nook_live_views *views);
/** @return false: there is nothing before; *views is untouched then */
bool nook_live_history_undo(nook_live_history *history, nook_live_views *views);
/** @return false: nothing was taken back; *views is untouched then */
bool nook_live_history_redo(nook_live_history *history, nook_live_views *views);
