/** verdict.h - what a measured number says about a claim. */
#pragma once
#include <stdbool.h>

typedef enum nook_verdict {
    NOOK_VERDICT_OK,          /**< Claimed, and within the tolerance. */
    NOOK_VERDICT_OFF,         /**< Claimed, and not. */
    NOOK_VERDICT_UNSEEN,      /**< The depth buffer does not hold what occludes. */
    NOOK_VERDICT_NOT_CLAIMED, /**< The technique does not say that it computes this. */
    NOOK_VERDICT_COUNT
} nook_verdict;

/** One number held against one claim. */
typedef struct nook_verify_check {
    double expected, measured;
    double tolerance; /**< Largest |measured - expected| that is ok. */
    double
        missing; /**< The part of the fixture's A that the technique's input does not hold; 0 for what reads all geometry. */
    bool claimed;
} nook_verify_check;

/** How much may be missing before a fixture counts as unseen: what the oracle's rays leave uncertain. */
#define NOOK_VERIFY_MISSING_MAX 0.01

/** Unseen goes before not claimed, and both before ok and off. Numbers that are NaN are never ok. */
nook_verdict nook_verify_judge(const nook_verify_check *check);

/** "ok", "off", "unseen", "not claimed". */
const char *nook_verdict_name(nook_verdict verdict);
