#include "game/commands/commands.h"
#include "engine/core/result.h"

static const nook_command commands[] = {
#define NOOK_COMMAND(name, summary) { #name, summary, nook_command_##name },
#include "game/commands/commands.def"
#undef NOOK_COMMAND
};

const nook_command *nook_command_table(size_t *out_count)
{
    *out_count = NOOK_COUNT(commands);
    return commands;
}
