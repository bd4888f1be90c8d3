/**
 * picture_fit.h - how large the picture of a game is, so that its frames come in time: what a frame costs follows its pixels.
 *
 *   zeroed -> a frame -> add -> scale -> a frame ...
 *
 * Times    of whole frames where software draws them; of a GPU its own, as the wait for the monitor says nothing of what is left.
 * Smaller  as soon as 3 of the last 20 frames were longer than 15/16 of what they may take: at once by as many steps as the third
 *          longest asks for. One or two long frames are the machine's, and no size mends them.
 * Larger   by one step, when for 40 frames in a row the third longest of the last 20 would by its pixels have been in time in that
 *          size; where the last such try failed soon, for twice as many, and so on up to 640. So a load between two sizes does not pump.
 * Changes cost a frame or two: textures are made anew and nothing can be taken over from the frame before. These do not count.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

enum { NOOK_PICTURE_FIT_STEPS = 6, NOOK_PICTURE_FIT_RECENT = 20 };

/** Plain numbers; zeroed: the whole size, nothing known. */
typedef struct nook_picture_fit {
    uint32_t step;    /**< [0, NOOK_PICTURE_FIT_STEPS): 0 is the whole size. */
    uint32_t count;   /**< Frames of this size so far. */
    uint32_t changes; /**< Of size, since it was zeroed. */
    uint32_t calm;    /**< Frames in a row after which a larger size seems possible. */
    uint32_t doubts;  /**< How often a larger size has failed soon, without one that lasted since. */
    bool larger;      /**< The last change was to a larger size. */
    float recent[NOOK_PICTURE_FIT_RECENT]; /**< Milliseconds, a ring. */
} nook_picture_fit;

/**
 * Adds how long a frame took. @param budget_ms  what it may take; 0: as long as it likes, the size goes back to the whole one
 * @return whether the next frame is to have another size
 */
bool nook_picture_fit_add(nook_picture_fit *fit, double ms, double budget_ms);
/** Back to the whole size. @return whether that is another one */
bool nook_picture_fit_reset(nook_picture_fit *fit);
/** Of each side: 1, 0.9, 0.8, ... 0.5. */
double nook_picture_fit_scale(const nook_picture_fit *fit);
/**
 * A side of `pixels` in the size of now; at least 1. A few pixels less where it, its half or its quarter (what occlusion is traced at) would be a
 * power of two and that of the whole side is not: llvmpipe compiles all programs again for textures that are, which takes a second.
 */
uint32_t nook_picture_fit_side(const nook_picture_fit *fit, uint32_t pixels);
