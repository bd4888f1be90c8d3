/* A game that nobody sees. */
#include "engine/core/log.h"
#include "game/interrupt.h"
#include "game/play/play.h"

static bool is_driven(const nook_play *play)
{
    return play->pilot || play->replay.level[0] != '\0';
}

/* Whether there is nothing more to wait for. What was recorded ends where it ended, so that the last states can be compared. */
static bool is_over(const nook_play *play)
{
    if (nook_play_is_beyond_end(play))
        return true;
    return nook_play_is_free(play) && (is_driven(play) || !(play->level->seconds > 0.0));
}

nook_result nook_play_headless(nook_play *play, bool *out_orderly)
{
    const nook_play_input nothing = { 0 };
    if (nook_play_is_free(play) && !(play->level->seconds > 0.0))
        return nook_fail(NOOK_E_ARG, "%s has no time limit and nobody plays: give --replay or --pilot",
                         play->level->path);
    while (!is_over(play) && !nook_interrupt_asked()) {
        nook_result result = nook_play_tick(play, &nothing);
        if (result != NOOK_OK)
            return result;
    }
    nook_play_print_end(play);
    *out_orderly = !nook_interrupt_asked() && play->pilot_status != NOOK_PILOT_FAILED &&
                   (!nook_play_can_end(play->level) || play->ended_at > 0 || play->replay.level[0] != '\0');
    return NOOK_OK;
}
