#include "game/verify/verify_work.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/** What a technique without a claim is treated as. */
static nook_verify_claim no_claim(const nook_ao_technique *technique)
{
    return (nook_verify_claim){ .name = technique->name,
                                .technique = technique->name,
                                .tolerance = INFINITY,
                                .reads_picture = technique->inputs == 0,
                                .settings = technique->name,
                                .says = "nothing" };
}

nook_verify_claim nook_verify_claim_for(const nook_ao_technique *technique)
{
    const nook_verify_claim *claim = nook_verify_claim_of(technique->name);
    return claim ? *claim : no_claim(technique);
}

/** As the claim, its exception and the user's rays say. */
static nook_result read_setting(const nook_verify_desc *desc, const char *text, nook_setting *out_setting)
{
    nook_result result = nook_setting_parse("verify", text, out_setting);
    if (result != NOOK_OK || !desc->rays)
        return result;
    const nook_ao_technique *technique = out_setting->technique;
    char rays[16];
    snprintf(rays, sizeof rays, "%u", desc->rays);
    if (technique->inputs != 0 && nook_param_find(technique->params, technique->param_count, "rays"))
        result = nook_setting_assign("--rays", out_setting, "rays", rays);
    return result;
}

nook_result nook_verify_begin_row(const nook_verify_work *work, const nook_verify_claim *claim,
                                  const nook_verify_scene *scene, nook_verify_readings *out_readings,
                                  nook_verify_row *out_row)
{
    const nook_verify_exception *exception = nook_verify_exception_for(claim->name, work->fixture->name, scene->point);
    bool plane = work->fixture->row == 1;
    nook_verify_row row = { .number = work->fixture->row,
                            .fixture = work->fixture->name,
                            .what = work->fixture->what,
                            .technique = claim->name,
                            .target = nook_verify_target_name(claim->target),
                            .equation_1 = scene->truth[NOOK_FORM_COSINE] };
    row.check.claimed = nook_verify_claim_of(claim->name) && (!claim->horizons || scene->height_field);
    row.check.tolerance = plane ? claim->plane : claim->tolerance;
    row.check.expected =
        scene->truth[claim->target == NOOK_VERIFY_SOLID_ANGLE ? NOOK_FORM_SOLID_ANGLE : NOOK_FORM_COSINE];
    if (!row.check.claimed)
        row.reason = claim->horizons ? "no height field" : "the technique claims nothing";
    if (exception) {
        row.reason = exception->reason;
        row.check.claimed = row.check.claimed && exception->settings;
        row.check.tolerance = exception->tolerance > 0.0 ? exception->tolerance : row.check.tolerance;
    }
    snprintf(row.point, sizeof row.point, "%s", scene->point);
    nook_result result = read_setting(
        work->desc, exception && exception->settings ? exception->settings : claim->settings, &out_readings->judged);
    if (result != NOOK_OK)
        return result;
    char text[NOOK_SETTING_TEXT_MAX];
    snprintf(row.settings, sizeof row.settings, "%.190s", nook_setting_print(&out_readings->judged, text));
    out_readings->initial = nook_setting_initial(out_readings->judged.technique);
    if (claim->initial)
        result = nook_setting_parse("verify", claim->initial, &out_readings->initial);
    *out_row = row;
    return result;
}

/** A plane is not dark in one pixel. */
static double value_of(const nook_verify_row *row, const nook_verify_reading *reading)
{
    return row->number == 1 ? reading->occlusion.highest : reading->occlusion.mean;
}

nook_result nook_verify_end_row(const nook_verify_work *work, nook_verify_row *row,
                                const nook_verify_readings *readings)
{
    row->check.measured = value_of(row, &readings->of_judged);
    row->deviation = readings->of_judged.occlusion.deviation;
    row->initial = value_of(row, &readings->of_initial);
    row->initial_deviation = readings->of_initial.occlusion.deviation;
    row->outside = readings->of_judged.outside + readings->of_initial.outside;
    return nook_verify_rows_add(work->rows, row);
}
