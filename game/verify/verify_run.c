#include "game/verify/verify_run.h"
#include "game/techniques.h"
#include "game/verify/verify_work.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

bool nook_verify_wants(const nook_verify_desc *desc, int number, const char *name)
{
    char text[16];
    snprintf(text, sizeof text, "%d", number);
    for (size_t i = 0; i < desc->fixture_count; i++) {
        if (strcmp(desc->fixtures[i], name) == 0 || strcmp(desc->fixtures[i], text) == 0)
            return true;
    }
    return desc->fixture_count == 0;
}

/** One technique that is told the geometry: all pixels have one truth. */
static nook_result measure(const nook_verify_work *w, const nook_verify_claim *claim, const nook_verify_scene *scene)
{
    nook_verify_readings readings;
    nook_verify_row row;
    nook_result result = nook_verify_begin_row(w, claim, scene, &readings, &row);
    if (result == NOOK_OK)
        result = nook_verify_rig_measure(w->rig, scene, &readings.judged, &readings.of_judged);
    if (result == NOOK_OK)
        result = nook_verify_rig_measure(w->rig, scene, &readings.initial, &readings.of_initial);
    if (result != NOOK_OK)
        return result;
    row.check.spread = readings.of_judged.occlusion.deviation;
    row.check.spread_max = nook_verify_spread_max(row.check.tolerance, row.check.expected, claim->samples);
    return nook_verify_end_row(w, &row, &readings);
}

/** All that the technique claims, and what it does where it claims nothing. */
static nook_result measure_claims(const nook_verify_work *w, const nook_ao_technique *technique,
                                  const nook_verify_scene *scene)
{
    nook_verify_claim first = nook_verify_claim_for(technique);
    nook_result result = measure(w, &first, scene);
    for (size_t i = 1; result == NOOK_OK && nook_verify_claim_at(technique->name, i); i++)
        result = measure(w, nook_verify_claim_at(technique->name, i), scene);
    return result;
}

/** All techniques that meet the triangles themselves, or all that meet voxels of them. */
static nook_result measure_told(const nook_verify_work *w, uint32_t point, bool voxels)
{
    nook_verify_scene scene;
    nook_result result = NOOK_OK;
    bool made = false;
    for (size_t i = 0; result == NOOK_OK && i < w->desc->technique_count; i++) {
        const nook_ao_technique *technique = w->desc->techniques[i];
        if (nook_verify_claim_for(technique).reads_picture || !technique->exact != voxels)
            continue;
        if (!made) {
            nook_verify_scene_make(w->fixture, point, voxels ? NOOK_VERIFY_VOXELS : NOOK_VERIFY_INFINITE, &scene);
            made = true;
            result = nook_verify_rig_set(w->rig, &scene, voxels);
        }
        if (result == NOOK_OK)
            result = measure_claims(w, technique, &scene);
    }
    if (made)
        nook_verify_scene_free(&scene);
    return result;
}

/** Whether any of them is chosen. */
static bool any_looks(const nook_verify_desc *desc)
{
    bool any = false;
    for (size_t i = 0; i < desc->technique_count; i++)
        any = any || nook_verify_claim_for(desc->techniques[i]).reads_picture;
    return any;
}

/** Row 18: occlusion without a normal, of which no technique here is an estimate. */
static nook_result say_positional(const nook_verify_desc *desc, nook_verify_rows *rows)
{
    const double k = 0.4;
    if (!nook_verify_wants(desc, 18, "positional"))
        return NOOK_OK;
    const nook_verify_row row = { .number = 18,
                                  .fixture = "positional",
                                  .what = "a plane under a point without a normal",
                                  .point = "k 0.4, hard",
                                  .technique = "-",
                                  .target = "over the sphere",
                                  .check = { .expected = (1.0 - k) / 2.0, .measured = NAN },
                                  .equation_1 = NAN,
                                  .deviation = NAN,
                                  .initial = NAN,
                                  .reason = "no technique here computes it: all have a normal" };
    return nook_verify_rows_add(rows, &row);
}

static nook_result run_fixtures(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows)
{
    size_t count;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&count);
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < count; i++) {
        const nook_verify_work w = { desc, rig, &fixtures[i], rows };
        uint32_t points = desc->quick ? fixtures[i].quick_points : fixtures[i].points;
        if (!nook_verify_wants(desc, fixtures[i].row, fixtures[i].name))
            continue;
        for (uint32_t point = 0; point < points && result == NOOK_OK; point++) {
            result = measure_told(&w, point, false);
            if (result == NOOK_OK)
                result = measure_told(&w, point, true);
            if (result == NOOK_OK && any_looks(desc))
                result = nook_verify_look_at(&w, point);
        }
    }
    return result;
}

nook_result nook_verify_run(const nook_verify_desc *desc, nook_verify_rows *rows)
{
    nook_verify_rig rig;
    nook_result result = nook_verify_rig_open(desc->gpu, &rig);
    if (result != NOOK_OK)
        return result;
    result = run_fixtures(desc, &rig, rows);
    if (result == NOOK_OK)
        result = say_positional(desc, rows);
    if (result == NOOK_OK)
        result = nook_verify_volume_checks(desc, &rig, rows);
    if (result == NOOK_OK)
        result = nook_verify_filter_checks(desc, &rig, rows);
    nook_verify_rig_close(&rig);
    return result;
}
