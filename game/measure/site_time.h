/**
 * site_time.h - what settings take at a site, timed in rounds: every setting a few frames, then all of them again. A machine that is
 * slower for some seconds slows down one round of many settings, and not all frames of one.
 *
 *   nook_site_show -> nook_site_time_round for each setting; all of it NOOK_SITE_ROUNDS times -> nook_site_times_put
 */
#pragma once
#include "game/measure/site.h"

enum { NOOK_SITE_ROUNDS = 5, NOOK_SITE_ROUNDS_SLOW = 3 };

/** One setting at one site; zero to begin with. */
typedef struct nook_site_times {
    uint32_t rounds;                 /**< Taken so far, at most `wanted`. */
    uint32_t wanted;                 /**< NOOK_SITE_ROUNDS, fewer of slow frames; found in the first round. */
    uint32_t frames;                 /**< Timed in each round: as many as fit, found in the first. */
    double ms[NOOK_SITE_ROUNDS];     /**< Median of each round's frames, wall clock around glFinish. */
    double gpu_ms[NOOK_SITE_ROUNDS]; /**< The same by timer queries; NaN where these lie. */
} nook_site_times;

/** Draws the site's G-buffer, which the stage then holds. */
nook_result nook_site_show(nook_site *site);

/**
 * One round of one setting: applied, warmed up, timed. Nothing where it has had all its rounds. The stage holds the site's G-buffer.
 * @param setting  of a technique that is not exact: frames of such take seconds
 */
nook_result nook_site_time_round(nook_site *site, const nook_setting *setting, nook_site_times *times);

/** Median, least and most of the rounds' medians, and how many frames were timed in all. @param times  of at least one round */
void nook_site_times_put(const nook_site_times *times, nook_sample *sample);
