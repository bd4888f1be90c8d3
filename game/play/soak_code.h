/**
 * soak_code.h - a soaked game whose code is exchanged all the time: by the libraries that were built beside the program, one after the
 * other, and all at once.
 */
#pragma once
#include "game/play/play_host.h"
#include "game/play/play_window.h"
#include "game/scratch_folder.h"

typedef struct nook_soak_code {
    nook_module main_module; /**< As it is linked in, but for how it begins. */
    nook_play_host play;
    nook_scratch_folder folder; /**< Where the host looks for libraries. */
    char built[1024];           /**< Folder of the libraries; "": there are none. */
    uint32_t asked;             /**< Exchanges. */
} nook_soak_code;

/** @param how  outlives it @return why the game cannot begin */
nook_result nook_soak_code_open(const char *root, nook_play_window_desc *how, nook_soak_code *out_code);
/** Exchanges until each library has been exchanged by itself, and all at once. @return 0: there are no libraries */
uint32_t nook_soak_code_turns(const nook_soak_code *code);
/** Puts one library, or all, where the host finds it in its next frame. @return NOOK_E_IO, NOOK_E_MEMORY */
nook_result nook_soak_code_exchange(nook_soak_code *code);
/** One frame. @return also NOOK_E_VERSION: code was refused, or the state was not kept */
nook_result nook_soak_code_frame(nook_soak_code *code);
/** @return as nook_play_window_close */
nook_result nook_soak_code_close(nook_soak_code *code);
