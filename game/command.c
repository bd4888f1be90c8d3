#include "game/command.h"
#include "engine/core/suggestion.h"
#include <stdio.h>
#include <string.h>

static const char *const main_job = "compare";

const nook_command *nook_command_find(const nook_command *table, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(table[i].name, name) == 0)
            return &table[i];
    }
    return NULL;
}

void nook_command_print_list(const nook_command *table, size_t count)
{
    printf("usage: nook [COMMAND] [OPTIONS]\n\n");
    for (size_t i = 0; i < count; i++)
        printf("  %-10s %s\n", table[i].name, table[i].summary);
    printf("\nWithout a command: %s. Every command explains itself: nook COMMAND --help\n", main_job);
}

static int refuse_unknown(const nook_command *table, size_t count, const char *name)
{
    nook_suggestion suggestion = nook_suggestion_for(name);
    for (size_t i = 0; i < count; i++)
        nook_suggestion_offer(&suggestion, table[i].name);
    if (suggestion.nearest)
        fprintf(stderr, "nook: %s: no such command; did you mean %s?\n", name, suggestion.nearest);
    else
        fprintf(stderr, "nook: %s: no such command; nook help lists them\n", name);
    return NOOK_EXIT_USAGE;
}

static int run_named(const nook_app *app, const nook_command *table, size_t count, const char *name, int argc,
                     char **argv)
{
    const nook_command *command = nook_command_find(table, count, name);
    return command ? command->run(app, argc, argv) : refuse_unknown(table, count, name);
}

static int is_help(const char *text)
{
    return strcmp(text, "help") == 0 || strcmp(text, "--help") == 0 || strcmp(text, "-h") == 0;
}

int nook_command_dispatch(const nook_app *app, const nook_command *table, size_t count, int argc, char **argv)
{
    if (argc < 2)
        return run_named(app, table, count, main_job, 1, (char *[]){ (char *)main_job, NULL });
    if (is_help(argv[1]) && argc > 2)
        return run_named(app, table, count, argv[2], 2, (char *[]){ argv[2], "--help", NULL });
    if (is_help(argv[1])) {
        nook_command_print_list(table, count);
        return NOOK_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0)
        return run_named(app, table, count, "version", argc - 1, argv + 1);
    if (argv[1][0] == '-') /* options of the main job; argv[0], the program, stands where its name is expected */
        return run_named(app, table, count, main_job, argc, argv);
    return run_named(app, table, count, argv[1], argc - 1, argv + 1);
}
