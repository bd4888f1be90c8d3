#include "game/commands/commands.h"
#include <gnu/libc-version.h>
#include <stdio.h>

int nook_command_version(const nook_app *app, int argc, char **argv)
{
    (void)app;
    const nook_usage usage = { .command = "version",
                               .summary = "Prints the version of Nook, the compiler, the C library." };
    nook_arguments arguments;
    int exit_code;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, &exit_code))
        return exit_code;
    printf("nook %s (compiler %s, C library %s)\n", NOOK_VERSION, __VERSION__, gnu_get_libc_version());
    return NOOK_EXIT_OK;
}
