/**
 * space.h - the settings that tune chooses among: for every technique a ladder of values for each parameter that trades speed for
 * accuracy, and all their combinations.
 *
 * Those parameters are the technique's counts (rays, steps, samples, ...), the resolution of its volumes, ao.scale and ao.filter. Others
 * (thresholds, biases, kernels) change what is computed, not how finely, and stay at their initial values.
 */
#pragma once
#include "game/settings/setting.h"

enum { NOOK_TUNE_AXES_MAX = 10, NOOK_TUNE_RUNGS_MAX = 24, NOOK_TUNE_TECHNIQUES_MAX = 16 };

/** One parameter's values, from cheap to dear. */
typedef struct nook_tune_axis {
    char name[64];                       /**< As nook_setting_assign takes it. */
    char rungs[NOOK_TUNE_RUNGS_MAX][16]; /**< The values as text. */
    uint32_t rung_count;
    uint32_t initial; /**< The rung of the parameter's initial value. */
    bool ordered;     /**< false: no rung is between two others (filters). */
} nook_tune_axis;

/** A technique's axes. */
typedef struct nook_tune_ladders {
    const struct nook_ao_technique *technique;
    nook_tune_axis axes[NOOK_TUNE_AXES_MAX];
    uint32_t axis_count;
} nook_tune_ladders;

typedef struct nook_tune_space {
    nook_tune_ladders techniques[NOOK_TUNE_TECHNIQUES_MAX];
    uint32_t technique_count;
} nook_tune_space;

/** One setting of a space. Rungs of axes that there are not are 0. */
typedef struct nook_tune_point {
    uint32_t technique; /**< Into techniques. */
    uint8_t rungs[NOOK_TUNE_AXES_MAX];
} nook_tune_point;

/** Adds a technique with its ladders. There is room for NOOK_TUNE_TECHNIQUES_MAX. */
void nook_tune_space_add(nook_tune_space *space, const struct nook_ao_technique *technique);

/** How many settings there are. */
double nook_tune_space_size(const nook_tune_space *space);

/** The technique as it comes. */
nook_tune_point nook_tune_initial(const nook_tune_space *space, uint32_t technique);

/** Moves along an axis. @return false: there is no such rung; *point is untouched */
bool nook_tune_step(const nook_tune_space *space, nook_tune_point *point, uint32_t axis, int rungs);

bool nook_tune_same(const nook_tune_point *a, const nook_tune_point *b);

nook_setting nook_tune_setting(const nook_tune_space *space, const nook_tune_point *point);
