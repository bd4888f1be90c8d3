/** extreme_run.h - running extreme cases and keeping what they found. */
#pragma once
#include "game/extremes/extremes.h"

/** One case and what it found. */
typedef struct nook_extreme_row {
    const nook_extreme_group *group;
    const nook_extreme *extreme;
    nook_result result; /**< Not NOOK_OK: it could not be measured, and `found` says nothing. */
    nook_extreme_found found;
    double ms; /**< Wall clock. */
} nook_extreme_row;

/** All rows of a run, in the order of the groups. Owns `rows`; release with nook_extreme_rows_free. */
typedef struct nook_extreme_rows {
    nook_extreme_row *rows;
    size_t count;
} nook_extreme_rows;

typedef struct nook_extreme_summary {
    size_t cases, groups, holding, failing, limits; /**< limits: cases that name a boundary. */
    uint64_t checked, outside;                      /**< Visibilities. */
    double seconds;
} nook_extreme_summary;

/**
 * Does the group's or the case's name hold `only`, whatever the case of the letters? The whole name of a group matches its cases
 * alone; NULL matches all.
 */
bool nook_extreme_matches(const nook_extreme_group *group, const nook_extreme *extreme, const char *only);
/** How many cases match. */
size_t nook_extreme_count(const char *only);

/** Ran, what must hold does, and where a limit is stated, its numbers are. */
bool nook_extreme_row_holds(const nook_extreme_row *row);

/** Runs one case. An error that GL raised meanwhile makes its result NOOK_E_DEVICE. */
void nook_extreme_run(const nook_extremes *extremes, const nook_extreme_group *group, const nook_extreme *extreme,
                      nook_extreme_row *out_row);

/**
 * Runs all cases that match, in order.
 * @param begin, end  called around each case, for progress and tables; NULL is allowed
 * @return NOOK_E_MEMORY; what does not hold is no error of this call. *out_rows is untouched on failure
 */
nook_result nook_extreme_run_all(const nook_extremes *extremes, const char *only,
                                 void (*begin)(void *user, const nook_extreme_group *, const nook_extreme *),
                                 void (*end)(void *user, const nook_extreme_row *), void *user,
                                 nook_extreme_rows *out_rows);
void nook_extreme_rows_free(nook_extreme_rows *rows);

nook_extreme_summary nook_extreme_summarize(const nook_extreme_rows *rows);
