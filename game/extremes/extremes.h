/**
 * extremes.h - the cases at the edge: each says what must hold, why that tolerance, and measures it.
 *
 * A case is a function in one of game/extremes/<subject>_cases.c and a row of that file's group, which groups.h names.
 * `./nook extremes` runs all; tests/extremes run them one group a program, quickly.
 */
#pragma once
#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/gpu.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct nook_fixture_view; /* modules/fixture/view.h */

/** What the cases share. */
typedef struct nook_extremes {
    nook_gpu *gpu;       /**< A device, current. */
    const char *scratch; /**< A folder for files and baked volumes, which the caller removes. */
    bool quick;          /**< Fewer samples of the same cases: for tests, under sanitizers too. */
    /** Told while a case works: fraction in [0, 1]. NULL: silence. */
    void (*progress)(void *user, double fraction);
    void *progress_user;
} nook_extremes;

/** A number that a limit states, as the README has it. */
typedef struct nook_extreme_stated {
    char what[96]; /**< "A with 3 voxels" */
    double stated, tolerance, measured;
} nook_extreme_stated;

enum { NOOK_EXTREME_STATED_MAX = 12 };

/** What a case found. Starts as zero. */
typedef struct nook_extreme_found {
    double measured;  /**< The worst that was seen, in the unit that the case names. */
    double bound;     /**< It holds when measured <= bound and nothing below says otherwise. */
    uint64_t outside; /**< Visibilities that were NaN, negative or above one, also before a clamp: must be 0, always. */
    uint64_t checked; /**< Visibilities that were looked at for that. */
    char where[192];  /**< Where the worst was: "scale 1e+06, 3 m off". */
    nook_extreme_stated stated[NOOK_EXTREME_STATED_MAX]; /**< Numbers of the limit: each must be what was measured. */
    size_t stated_count;
} nook_extreme_found;

typedef struct nook_extreme {
    const char *name; /**< What must hold, as a sentence: "the image is the same at world scales 1e-6 to 1e6". */
    const char *unit; /**< Of measured and bound: "RMS of visibility", "voxels", "bytes". */
    const char *why;  /**< Why this bound, one line. */
    const char
        *limit; /**< NULL; or, for what cannot hold everywhere: the boundary, as the README states it. Its numbers
                            are nook_extreme_state's. */
    /** @return why it could not be measured at all (logged); what did not hold is no failure of this kind */
    nook_result (*run)(const nook_extremes *extremes, nook_extreme_found *out_found);
} nook_extreme;

typedef struct nook_extreme_group {
    const char *name; /**< "transforms" */
    const nook_extreme *cases;
    size_t count;
} nook_extreme_group;

/** Every group, in the order of the table. @param out_count  groups */
const nook_extreme_group *const *nook_extreme_groups(size_t *out_count);

/** Within the tolerance; a NaN is not. */
bool nook_extreme_stated_holds(const nook_extreme_stated *stated);

/** Something was looked at, measured <= bound (a NaN is not), nothing outside, and all that is stated is so. */
bool nook_extreme_holds(const nook_extreme_found *found);

/* ---- For cases ---- */

/**
 * Keeps `value` as the worst when it is larger than what was measured so far (0 at first) or not a number, and where that was.
 * @param format  printf-style: "scale %g, technique %s"
 */
void nook_extreme_worst(nook_extreme_found *found, double value, const char *format, ...) NOOK_PRINTF(3, 4);

/**
 * Holds a number of the case's limit against what was measured.
 * @param stated, tolerance  what the README says, and how far off it may be
 * @param format  what it is, printf-style: "A with %u voxels"
 */
void nook_extreme_state(nook_extreme_found *found, double stated, double tolerance, double measured, const char *format,
                        ...) NOOK_PRINTF(5, 6);

/**
 * Counts what a view's last record had outside of [0, 1] (nook_fixture_view.outside: before it was clamped, and in the picture). The
 * first names the place, and none after it does.
 */
void nook_extreme_check_view(nook_extreme_found *found, const struct nook_fixture_view *view, const char *format, ...)
    NOOK_PRINTF(3, 4);

/** The same of a picture that no view holds. */
void nook_extreme_check(nook_extreme_found *found, const float *visibility, size_t count, const char *format, ...)
    NOOK_PRINTF(4, 5);

/** Passes progress on to whoever asked for it. */
void nook_extreme_progress(const nook_extremes *extremes, double fraction);
