/**
 * extremes.h - the cases at the edge: each says what must hold, why that tolerance, and measures it.
 *
 * A case is a function in one of game/extremes/<subject>.c and a row of that file's table. `./nook extremes` runs all; tests/extremes
 * run them one subject a program.
 */
#pragma once
#include "engine/core/result.h"
#include "engine/gpu/gpu.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** What the cases share. */
typedef struct nook_extremes {
    nook_gpu *gpu;       /**< A device, current. */
    const char *scratch; /**< A folder for files, which the caller removes. */
    bool quick;          /**< Fewer samples of the same cases: for tests, under sanitizers too. */
} nook_extremes;

/** What a case found. */
typedef struct nook_extreme_found {
    double measured;  /**< The worst that was seen, in the unit that the case names. */
    double bound;     /**< It holds when measured <= bound and nothing below says otherwise. */
    uint64_t outside; /**< Visibilities that were NaN, negative or above one: must be 0, always. */
    char where[192];  /**< Where the worst was: "scale 1e+06, 3 m off". */
} nook_extreme_found;

typedef struct nook_extreme {
    const char *name;  /**< What must hold, as a sentence: "the image is the same at world scales 1e-6 to 1e6". */
    const char *unit;  /**< Of measured and bound: "RMS of visibility", "voxels", "bytes". */
    const char *why;   /**< Why this bound, one line. */
    const char *limit; /**< NULL; or, for what cannot hold everywhere: the boundary, as the README states it. */
    /** @return why it could not be measured at all (logged); what did not hold is no failure of this kind */
    nook_result (*run)(const nook_extremes *extremes, nook_extreme_found *out_found);
} nook_extreme;

typedef struct nook_extreme_group {
    const char *name; /**< "transforms" */
    const nook_extreme *cases;
    size_t count;
} nook_extreme_group;

/** Every group, in the order of the table. */
const nook_extreme_group *nook_extreme_groups(size_t *out_count);

/** measured <= bound (a NaN is not) and nothing outside. */
bool nook_extreme_holds(const nook_extreme_found *found);
