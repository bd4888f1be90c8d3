#pragma once
#include "game/command.h"

/** Declares int nook_command_<name>(const nook_app *app, int argc, char **argv) for every row of commands.def. */
#define NOOK_COMMAND(name, summary) int nook_command_##name(const nook_app *app, int argc, char **argv);
#include "game/commands/commands.def"
#undef NOOK_COMMAND

/** All commands, in the order of commands.def. @param out_count  rows */
const nook_command *nook_command_table(size_t *out_count);
