/** verify_work.h - one fixture and what is done with it: the rows begin and end here, whatever measures them. */
#pragma once
#include "game/verify/claims.h"
#include "game/verify/verify_run.h"
#include "modules/ao/technique.h"

typedef struct nook_verify_work {
    const nook_verify_desc *desc;
    nook_verify_rig *rig;
    const nook_verify_fixture *fixture;
    nook_verify_rows *rows;
} nook_verify_work;

/** What is read of one row. */
typedef struct nook_verify_readings {
    nook_setting judged, initial; /**< The claim's or its exception's; the technique as it comes. */
    nook_verify_reading of_judged, of_initial;
} nook_verify_readings;

/** The technique's first claim, or one of nothing. */
nook_verify_claim nook_verify_claim_for(const nook_ao_technique *technique);

/** Fills in all but what is measured, and the settings. @return as nook_setting_parse */
nook_result nook_verify_begin_row(const nook_verify_work *work, const nook_verify_claim *claim,
                                  const nook_verify_scene *scene, nook_verify_readings *out_readings,
                                  nook_verify_row *out_row);
/** Adds the row with what was measured; check.spread stays as it is. @return NOOK_E_MEMORY */
nook_result nook_verify_end_row(const nook_verify_work *work, nook_verify_row *row,
                                const nook_verify_readings *readings);

/** All cameras of one point of the fixture, for all chosen techniques that know the depth buffer only. */
nook_result nook_verify_look_at(const nook_verify_work *work, uint32_t point);
