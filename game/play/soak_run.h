/**
 * soak_run.h - plays for very long and looks whether anything wears out: bodies thrown about, shaders and code reloaded, sizes changed,
 * tries begun anew. Nothing may grow, become no number, or go through what stands still.
 *
 * The first tenth is for warming up: each of these things happens once in it, however short the run is, so that what is made when
 * something happens for the first time is no growth.
 */
#pragma once
#include "game/play/play_window.h"
#include "game/play/soak_bodies.h"
#include "game/play/soak_memory.h"

enum { NOOK_SOAK_FRAMES_MIN = 200 }; /**< A tenth of fewer has no room to warm up in. */

typedef struct nook_soak_desc {
    nook_play_window_desc window; /**< One tick a frame. */
    uint32_t frames;              /**< At least NOOK_SOAK_FRAMES_MIN. */
    uint32_t seed;                /**< Of what is thrown. */
} nook_soak_desc;

typedef struct nook_soak_report {
    uint32_t frames, throws, reloads, restarts, resizes;
    uint32_t
        exchanges; /**< Of code: of the game, of a technique, of all. 0 when no libraries were built beside the program. */
    nook_soak_bodies bodies; /**< Those that left the world; freed. */
    uint64_t pixels;         /**< Visibilities looked at. */
    uint64_t wrong;          /**< Of these: not a number, or outside of [0, 1]. */
    nook_soak_memory heap;   /**< What was allocated and not freed; zero where the C library does not tell. */
    nook_soak_memory
        resident; /**< What the process occupies: with what allocators keep of what was freed, and what they tore to pieces. */
    uint32_t files[2]; /**< Open after the warm-up, and at the end. */
    double seconds;
} nook_soak_report;

/** Progress on standard error; Ctrl-C ends it in order, with fewer frames. @return why it could not go on to its end; the report is filled in as far as it came */
nook_result nook_soak_run(const char *root, const nook_soak_desc *desc, nook_soak_report *out_report);

/** Whether nothing wore out. */
bool nook_soak_holds(const nook_soak_report *report);
