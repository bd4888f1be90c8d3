/**
 * soak_run.h - plays for very long and looks whether anything wears out: bodies thrown about, shaders and code reloaded, sizes changed,
 * tries begun anew. Nothing may grow, become no number, or leave the world.
 */
#pragma once
#include "game/play/play_window.h"
#include "game/play/soak_memory.h"

typedef struct nook_soak_desc {
    nook_play_window_desc window; /**< One tick a frame. */
    uint32_t frames;              /**< At least 100. */
    uint32_t seed;                /**< Of what is thrown. */
} nook_soak_desc;

typedef struct nook_soak_report {
    uint32_t frames, throws, reloads, restarts, resizes;
    uint32_t
        exchanges; /**< Of code: of the game, of a technique, of all. 0 when no libraries were built beside the program. */
    uint32_t returned; /**< Bodies that had left the world. */
    uint64_t pixels;   /**< Visibilities looked at. */
    uint64_t wrong;    /**< Of these: not a number, or outside of [0, 1]. */
    nook_soak_memory memory;
    uint32_t files[2]; /**< Open after the warm-up (a tenth of the frames), and at the end. */
    double seconds;
} nook_soak_report;

/** Progress on standard error; Ctrl-C ends it in order, with fewer frames. @return why it could not go on to its end; the report is filled in as far as it came */
nook_result nook_soak_run(const char *root, const nook_soak_desc *desc, nook_soak_report *out_report);

/** Whether nothing wore out. */
bool nook_soak_holds(const nook_soak_report *report);
