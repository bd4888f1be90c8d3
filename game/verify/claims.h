/** claims.h - what each technique says it computes, how near it comes to that, with which settings, and where it does not. */
#pragma once
#include <stdbool.h>
#include <stddef.h>

/** How near the reference comes to what the picture holds, from the picture: a rim is one pixel off. */
#define NOOK_VERIFY_SCREEN_TOLERANCE 0.04

/** What a technique's A is an estimate of. */
typedef enum nook_verify_target {
    NOOK_VERIFY_EQUATION_1,  /**< Equation 1. */
    NOOK_VERIFY_SOLID_ANGLE, /**< Its own: rho over the solid angle, without the cosine. */
    NOOK_VERIFY_HALF_BALL    /**< Its own: rho over the points of a half ball that the depth buffer hides. */
} nook_verify_target;

typedef struct nook_verify_claim {
    const char *name; /**< Of its rows: the technique's, or of another kind of it, "volume.surfel". */
    const char *technique;
    const char
        *initial; /**< The kind of technique that its rows are about, as it comes: a setting. NULL: the technique. */
    const char *settings; /**< As in a settings file: what the claim is made for, and little noise. */
    const char *says;     /**< One line. */
    double tolerance;
    double plane;   /**< The most that an open plane may read. */
    double samples; /**< Random ones in a pixel, as far as they scatter pixels by more than the tolerance; 0: none. */
    nook_verify_target target;
    bool reads_picture; /**< Knows the depth buffer only: measured with cameras. */
    bool horizons;      /**< Holds where the geometry is a height field over the receiver. */
} nook_verify_claim;

/** A fixture on which a technique claims something else. */
typedef struct nook_verify_exception {
    const char *claim, *fixture; /**< Names. */
    const char *point;           /**< The start of the points that it is about; "": all. */
    const char *settings;        /**< In place of the claim's; NULL: no claim is made. */
    double tolerance;            /**< In place of the claim's; 0: the same. */
    const char *reason;          /**< One line; docs/techniques.md says more. */
} nook_verify_exception;

/** By its name. @return NULL: there is none; a technique of that name claims nothing */
const nook_verify_claim *nook_verify_claim_of(const char *name);
/** The index-th claim of a technique; the first has its name. @return NULL past the last */
const nook_verify_claim *nook_verify_claim_at(const char *technique, size_t index);
/** @return NULL: the claim stands */
const nook_verify_exception *nook_verify_exception_for(const char *claim, const char *fixture, const char *point);

/** "Eq. 1", "own: solid angle", "own: half ball". */
const char *nook_verify_target_name(nook_verify_target target);
