/** verify_rows.h - what verify found: one row for every technique, fixture, point and camera. */
#pragma once
#include "engine/core/result.h"
#include "game/verify/verdict.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct nook_verify_row {
    int number;            /**< Of docs/techniques.md, section Fixtures. */
    const char *fixture;   /**< Its name on the command line. Constant text, like all that is not an array. */
    const char *what;      /**< Its geometry, one line. */
    char point[64];        /**< Of its parameters. */
    const char *technique; /**< Or "filter", or "-" for what nobody computes. */
    const char *camera;    /**< NULL: the technique is told the geometry. */
    const char *target;    /**< Of what `expected` is the value: "Eq. 1", "own: solid angle". */
    nook_verify_check check;
    double equation_1; /**< The fixture's A by equation 1; NaN where that means nothing. */
    double deviation;  /**< Between the pixels of which the measured value is the mean; NaN: one value. */
    double
        initial; /**< What the technique gives as it comes, at its initial parameters; not judged. NaN: no such thing. */
    double initial_deviation; /**< The same between the pixels. */
    uint64_t outside;         /**< Visibilities outside of [0, 1], at either: makes the row off. */
    char settings[192];
    const char *reason; /**< Why nothing, or something else, is claimed; NULL. */
    nook_verdict verdict;
} nook_verify_row;

/** Told of every row as soon as it is there. */
typedef struct nook_verify_listener {
    void (*row)(void *user, const nook_verify_row *row); /**< May be NULL. */
    void *user;
} nook_verify_listener;

typedef struct nook_verify_rows {
    nook_verify_row *rows; /**< Owned. */
    size_t count, capacity;
    nook_verify_listener listener;
} nook_verify_rows;

/** Judges the row and adds a copy. @return NOOK_E_MEMORY */
nook_result nook_verify_rows_add(nook_verify_rows *rows, const nook_verify_row *row);
void nook_verify_rows_free(nook_verify_rows *rows);

typedef struct nook_verify_summary {
    size_t verdicts[NOOK_VERDICT_COUNT];
    size_t checks;                /**< ok and off. */
    const nook_verify_row *worst; /**< Of these, nearest to a bound, of its error or its spread; NULL without checks. */
    double largest_error;         /**< Of these, absolute. */
    uint64_t outside;
} nook_verify_summary;

nook_verify_summary nook_verify_summarize(const nook_verify_rows *rows);

/** What the checks of one technique on the fixtures, rows 1 to 17, have in common. Errors are of A, + too dark. */
typedef struct nook_verify_tally {
    const char *technique;
    bool by_screen; /**< The reference, of what one picture holds. */
    size_t checks;
    double bias, rmse, spread;         /**< Of what is judged; the spread is the RMS of all. */
    double largest;                    /**< Error with the largest amount, with its sign. */
    const char *where;                 /**< The fixture of it. */
    double initial_bias, initial_rmse; /**< As it comes; NaN: no such thing. */
} nook_verify_tally;

/** One for each technique that has checks, in the order of the rows. @return how many, at most `capacity` */
size_t nook_verify_tally_techniques(const nook_verify_rows *rows, nook_verify_tally *tallies, size_t capacity);
