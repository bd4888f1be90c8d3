/* How a game ends, with a window or without. */
#include "game/play/play.h"
#include <stdio.h>

static const double seconds_beyond_the_end = 2.0;

bool nook_play_can_end(const nook_level *level)
{
    for (uint32_t i = 0; i < level->entity_count; i++) {
        if (level->entities[i].kind == NOOK_LEVEL_GOAL)
            return true;
    }
    return level->seconds > 0.0;
}

bool nook_play_is_beyond_end(const nook_play *play)
{
    double beyond = (double)(nook_session_look(play->session).ticks - play->ended_at) * NOOK_PHYSICS_STEP;
    return play->ended_at > 0 && beyond >= seconds_beyond_the_end;
}

void nook_play_print_end(const nook_play *play)
{
    static const char *const words[] = { "undecided", "won", "lost" };
    bool decided = nook_play_can_end(play->level);
    nook_session_view view = nook_session_look(play->session);
    bool over = play->ended_at > 0;
    uint64_t ticks = over ? play->ended_at : view.ticks;
    uint64_t hash = over ? play->ended_hash : nook_session_hash(play->session);
    printf("%s after %llu ticks (%.1f s), hash %016llx\n", decided ? words[view.status] : "ended",
           (unsigned long long)ticks, (double)ticks * NOOK_PHYSICS_STEP, (unsigned long long)hash);
}
