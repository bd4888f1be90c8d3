#pragma once
#include "game/option.h"
#include <stddef.h>

#define NOOK_VERSION "0.1.0"

/** What every command is given. */
typedef struct nook_app {
    const char *root; /**< The folder that holds shaders/ and content/, without a final '/'. */
} nook_app;

/** One command of the program. */
typedef struct nook_command {
    const char *name;    /**< [a-z]+ */
    const char *summary; /**< One line for the list. */
    /** argv[0] is the command's name. @return a NOOK_EXIT_* code */
    int (*run)(const nook_app *app, int argc, char **argv);
} nook_command;

/** @return the row of that name, or NULL */
const nook_command *nook_command_find(const nook_command *table, size_t count, const char *name);

/** Lists the commands with their summaries on standard output. */
void nook_command_print_list(const nook_command *table, size_t count);

/**
 * Runs the command that argv[1] names; the main job, `compare`, when there is none or it is an option.
 * `help`, --help and -h list the commands; `help NAME` is `NAME --help`; --version is the command `version`. An unknown name is one line on standard error.
 * @return what the command returned, or NOOK_EXIT_USAGE
 */
int nook_command_dispatch(const nook_app *app, const nook_command *table, size_t count, int argc, char **argv);
