/** play_request.h - the command line of ./nook play. */
#pragma once
#include "engine/platform/context.h"
#include "game/option_rows.h"
#include "game/play/play.h"

/** Texts point into argv and into itself: it must stay where it was read. */
typedef struct nook_play_request {
    nook_play_desc desc;
    bool headless; /**< No window; nothing is drawn unless `capture` wants pictures. */
    const char *settings, *cache, *pictures, *capture; /**< capture: NULL for none. */
    double from;    /**< Seconds of the replay or pilot that pass before the first picture. */
    int32_t frames; /**< Pictures until it ends; 0: no such end. */
    nook_option_size size;
    nook_backend backend;
    char default_cache[NOOK_OPTION_PATH_MAX];
} nook_play_request;

/**
 * Prints help, or what is wrong.
 * @param root  the folder that holds shaders/ and content/
 * @return true: go on. false: return *out_exit_code from the command
 */
bool nook_play_request_read(const char *root, int argc, char **argv, nook_play_request *out, int *out_exit_code);
