#pragma once
#include "engine/core/param.h"

/** What bodies are where neither the level nor glTF says. */
#define NOOK_PARAM_STRUCT nook_body_defaults
#define NOOK_PARAM_TABLE nook_body_defaults_table
#define NOOK_PARAM_FILE "game/level/body.def"
#include "engine/core/param_block.inl"

static inline nook_body_defaults nook_body_defaults_initial(void)
{
    nook_body_defaults out;
    nook_param_reset(nook_body_defaults_table, NOOK_COUNT(nook_body_defaults_table), &out);
    return out;
}
