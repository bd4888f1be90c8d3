/** verify_run.h - every chosen technique on every chosen fixture, and what belongs to one stage alone. */
#pragma once
#include "game/verify/rig.h"
#include "game/verify/verify_rows.h"

enum { NOOK_VERIFY_CHOSEN_MAX = 32, NOOK_VERIFY_RAYS_SEEN = 2048, NOOK_VERIFY_POINTS_HIDDEN = 4096 };

typedef struct nook_verify_desc {
    nook_gpu *gpu;
    const struct nook_ao_technique *techniques[NOOK_VERIFY_CHOSEN_MAX]; /**< Which ones. */
    size_t technique_count;
    bool filter;                                  /**< And the filter. */
    const char *fixtures[NOOK_VERIFY_CHOSEN_MAX]; /**< Names or numbers of rows; none: all. */
    size_t fixture_count;
    uint32_t rays; /**< In place of those that a claim is made for; 0: as the claims say. */
    bool quick;    /**< Some points of the same fixtures. */
} nook_verify_desc;

/** Reads "volume,filter" into the desc; NULL: all. @return NOOK_E_NOT_FOUND (the line lists the names) */
nook_result nook_verify_choose_techniques(const char *list, nook_verify_desc *desc);
/** Reads "pit,wall,19" into the desc; NULL: all. The texts are kept in `storage`. @return the same */
nook_result nook_verify_choose_fixtures(const char *list, nook_verify_desc *desc, char *storage, size_t capacity);

/** Whether rows of this number and name are wanted. */
bool nook_verify_wants(const nook_verify_desc *desc, int number, const char *name);

/** Runs everything. Rows that are off are no failure. @return why something could not be measured at all */
nook_result nook_verify_run(const nook_verify_desc *desc, nook_verify_rows *rows);

/** Row 19: what the volume technique says of itself. */
nook_result nook_verify_volume_checks(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows);
/** Row 20: the filter alone, and the result at other scales of the trace. */
nook_result nook_verify_filter_checks(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows);
