/** edge_estimator.h - what the extreme cases record: every technique, and one that marches volumes with every kind of them. */
#pragma once
#include "modules/ao/technique.h"
#include <stdbool.h>

enum { NOOK_EDGE_ESTIMATORS_MAX = 32, NOOK_EDGE_ESTIMATOR_NAME_MAX = 64 };

typedef struct nook_edge_estimator {
    const nook_ao_technique *technique;
    char name
        [NOOK_EDGE_ESTIMATOR_NAME_MAX]; /**< Of the technique; "volume.surfel" where the kind is not the initial one. */
    bool hangs; /**< Its voxels hang in the world and not on bodies: a scene elsewhere is another sample of them. */
} nook_edge_estimator;

/** Those of the program, in the order of nook_techniques. @return how many */
size_t nook_edge_estimators(nook_edge_estimator out[NOOK_EDGE_ESTIMATORS_MAX]);

/**
 * Splits an estimator's name.
 * @param out_technique  NOOK_EDGE_ESTIMATOR_NAME_MAX bytes @return the kind, in `name`; NULL: the one that is set
 */
const char *nook_edge_estimator_split(const char *name, char *out_technique);
