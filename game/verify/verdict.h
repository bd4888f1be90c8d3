/** verdict.h - what a measured number says about a claim. */
#pragma once
#include <stdbool.h>

typedef enum nook_verdict {
    NOOK_VERDICT_OK,          /**< Claimed, and within the tolerance. */
    NOOK_VERDICT_OFF,         /**< Claimed, and not. */
    NOOK_VERDICT_UNSEEN,      /**< The depth buffer does not hold what occludes. */
    NOOK_VERDICT_UNRESOLVED,  /**< It does, in too few pixels to tell how much. */
    NOOK_VERDICT_NOT_CLAIMED, /**< The technique does not say that it computes this. */
    NOOK_VERDICT_COUNT
} nook_verdict;

/** One number held against one claim. */
typedef struct nook_verify_check {
    double expected, measured;
    double tolerance; /**< Largest |measured - expected| that is ok. */
    /**
     * Standard deviation over the pixels of what each is off its own truth: noise, and errors that differ from pixel to pixel. A mean
     * may be right where no pixel is.
     */
    double spread;
    double spread_max; /**< Largest that is ok; see nook_verify_spread_max. */
    double
        missing; /**< The part of the fixture's A that the technique's input does not hold; 0 for what reads all geometry. */
    double unresolved; /**< The part of A that hinges on which point of a pixel the input holds; 0 likewise. */
    bool claimed;
} nook_verify_check;

/** How much may be missing before a fixture counts as unseen: what the oracle's rays leave uncertain. */
#define NOOK_VERIFY_MISSING_MAX 0.01
/**
 * How much of A the pixels may leave open, see nook_verify_look_through, before a camera counts as unresolved: the most that any
 * technique of pictures is allowed to be off.
 */
#define NOOK_VERIFY_UNRESOLVED_MAX 0.04

/**
 * What the errors of single pixels may scatter: as much as the mean may be off, for what is systematic, and what a mean over samples
 * that know nothing of each other does: rho is in [0, 1], so that one has a variance of at most A (1 - A).
 * @param samples  random ones in a pixel; 0: none, or so many that they are within the tolerance
 */
double nook_verify_spread_max(double tolerance, double expected, double samples);

/** Unseen goes before unresolved, that before not claimed, and these before ok and off. Numbers that are NaN are never ok. */
nook_verdict nook_verify_judge(const nook_verify_check *check);

/** Ok and off: whether the claim was put to the test. */
bool nook_verify_is_checked(nook_verdict verdict);

/** "ok", "off", "unseen", "unresolved", "not claimed". */
const char *nook_verdict_name(nook_verdict verdict);
