#pragma once
#include "engine/core/param.h"

/** What the one who plays can do. */
#define NOOK_PARAM_STRUCT nook_player_params
#define NOOK_PARAM_TABLE nook_player_table
#define NOOK_PARAM_FILE "game/play/player.def"
#include "engine/core/param_block.inl"

static inline nook_player_params nook_player_params_initial(void)
{
    nook_player_params out;
    nook_param_reset(nook_player_table, NOOK_COUNT(nook_player_table), &out);
    return out;
}
