#include "game/play/play.h"
#include "game/commands/commands.h"
#include "game/interrupt.h"
#include "game/play/play_host.h"
#include "game/play/play_request.h"
#include <stdio.h>

static int play_headless(const nook_play_desc *desc)
{
    nook_play play;
    bool orderly = false;
    nook_result result = nook_play_open(desc, &play);
    if (result == NOOK_OK)
        result = nook_play_begin(&play, NULL, NULL);
    nook_interrupt_hold();
    if (result == NOOK_OK)
        result = nook_play_headless(&play, &orderly);
    nook_result closed = nook_play_close(&play); /* a recording is written whatever happens */
    fflush(stdout);
    nook_interrupt_release();
    return result == NOOK_OK && closed == NOOK_OK && orderly ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

int nook_command_play(const nook_app *app, int argc, char **argv)
{
    nook_play_request request;
    int exit_code;
    if (!nook_play_request_read(app->root, argc, argv, &request, &exit_code))
        return exit_code;
    if (request.headless && !request.capture)
        return play_headless(&request.desc);
    return nook_play_host_run(app->root, argc, argv) == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
