#include "game/verify/verify_run.h"
#include "game/techniques.h"
#include "game/verify/claims.h"
#include "game/verify/oracle.h"
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

/** One fixture at one point and one technique: what it is held to, and how it is set. */
typedef struct work {
    const nook_verify_desc *desc;
    nook_verify_rig *rig;
    const nook_verify_fixture *fixture;
    nook_verify_rows *rows;
} work;

/** What a technique without a claim is treated as. */
static nook_verify_claim no_claim(const nook_ao_technique *technique)
{
    return (nook_verify_claim){ .technique = technique->name,
                                .tolerance = INFINITY,
                                .reads_picture = technique->inputs == 0,
                                .settings = technique->name,
                                .says = "nothing" };
}

static nook_verify_claim claim_of(const nook_ao_technique *technique)
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

/** Fills in all but what is measured. */
static nook_result begin_row(const work *w, const nook_verify_claim *claim, const nook_verify_scene *scene,
                             nook_setting *out_setting, nook_verify_row *out_row)
{
    const nook_verify_exception *exception =
        nook_verify_exception_for(claim->technique, w->fixture->name, scene->point);
    bool plane = w->fixture->row == 1;
    nook_verify_row row = { .number = w->fixture->row,
                            .fixture = w->fixture->name,
                            .what = w->fixture->what,
                            .technique = claim->technique,
                            .target = nook_verify_target_name(claim->target),
                            .equation_1 = scene->truth[NOOK_FORM_COSINE] };
    row.check.claimed = nook_verify_claim_of(claim->technique) && (!claim->horizons || scene->height_field);
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
    nook_result result =
        read_setting(w->desc, exception && exception->settings ? exception->settings : claim->settings, out_setting);
    char text[NOOK_SETTING_TEXT_MAX];
    if (result == NOOK_OK)
        snprintf(row.settings, sizeof row.settings, "%.190s", nook_setting_print(out_setting, text));
    *out_row = row;
    return result;
}

static nook_result end_row(const work *w, nook_verify_row *row, const nook_fixture_occlusion *occlusion)
{
    row->check.measured = row->number == 1 ? occlusion->highest : occlusion->mean; /* a plane: not one pixel */
    row->deviation = occlusion->deviation;
    return nook_verify_rows_add(w->rows, row);
}

/** One technique that is told the geometry. */
static nook_result measure(const work *w, const nook_ao_technique *technique, const nook_verify_scene *scene)
{
    nook_verify_claim claim = claim_of(technique);
    nook_setting setting;
    nook_verify_row row;
    nook_fixture_occlusion occlusion;
    nook_result result = begin_row(w, &claim, scene, &setting, &row);
    if (result == NOOK_OK)
        result = nook_verify_rig_measure(w->rig, scene, &setting, &occlusion, &row.outside);
    return result == NOOK_OK ? end_row(w, &row, &occlusion) : result;
}

/** All techniques that read triangles, or all that read volumes. */
static nook_result measure_told(const work *w, uint32_t point, bool volumes)
{
    nook_verify_scene scene;
    nook_result result = NOOK_OK;
    bool made = false;
    for (size_t i = 0; result == NOOK_OK && i < w->desc->technique_count; i++) {
        const nook_ao_technique *technique = w->desc->techniques[i];
        if (claim_of(technique).reads_picture || ((technique->inputs & NOOK_AO_IN_VOLUMES) != 0) != volumes)
            continue;
        if (!made) {
            nook_verify_scene_make(w->fixture, point, volumes ? NOOK_VERIFY_VOLUME : NOOK_VERIFY_INFINITE, &scene);
            made = true;
            result = nook_verify_rig_set(w->rig, &scene, volumes);
        }
        if (result == NOOK_OK)
            result = measure(w, technique, &scene);
    }
    if (made)
        nook_verify_scene_free(&scene);
    return result;
}

/** What a camera's picture lacks of the fixture's A, by both measures. */
typedef struct lacking {
    double by[2];
    bool known[2];
} lacking;

static double missing_by(const nook_verify_scene *scene, const nook_verify_camera *camera, nook_form_weight weight,
                         lacking *lack)
{
    if (!lack->known[weight]) {
        lack->by[weight] = nook_verify_cast_occlusion(scene, weight, NULL, NOOK_VERIFY_RAYS_SEEN) -
                           nook_verify_cast_occlusion(scene, weight, camera, NOOK_VERIFY_RAYS_SEEN);
        lack->known[weight] = true;
    }
    return lack->by[weight];
}

static nook_result look(const work *w, const nook_ao_technique *technique, const nook_verify_scene *scene,
                        const nook_verify_camera *camera, lacking *lack)
{
    nook_verify_claim claim = claim_of(technique);
    nook_setting setting;
    nook_verify_row row;
    nook_fixture_occlusion occlusion;
    nook_result result = begin_row(w, &claim, scene, &setting, &row);
    if (result == NOOK_OK)
        result = nook_verify_rig_look(w->rig, scene, &setting, &occlusion, &row.outside);
    if (result != NOOK_OK)
        return result;
    nook_form_weight weight = claim.target == NOOK_VERIFY_SOLID_ANGLE ? NOOK_FORM_SOLID_ANGLE : NOOK_FORM_COSINE;
    row.camera = camera->name;
    row.check.missing = missing_by(scene, camera, weight, lack);
    if (claim.target == NOOK_VERIFY_HALF_BALL)
        row.check.expected = nook_verify_cast_half_ball(scene, camera, 0.01, NOOK_VERIFY_POINTS_HIDDEN);
    return end_row(w, &row, &occlusion);
}

/** The truth of what the picture shows, from the picture itself: what the techniques beside it can reach at the best. */
static nook_result look_through_screen(const work *w, const nook_verify_scene *scene, const nook_verify_camera *camera,
                                       lacking *lack)
{
    nook_setting setting;
    nook_fixture_occlusion occlusion;
    nook_verify_row row = { .number = w->fixture->row,
                            .fixture = w->fixture->name,
                            .what = w->fixture->what,
                            .technique = "reference",
                            .camera = camera->name,
                            .target = nook_verify_target_name(NOOK_VERIFY_EQUATION_1),
                            .equation_1 = scene->truth[NOOK_FORM_COSINE],
                            .settings = "reference rays=64 sees=screen",
                            .reason = scene->height_field ? NULL : "silhouettes end short by a pixel" };
    row.check.expected = scene->truth[NOOK_FORM_COSINE];
    row.check.tolerance = NOOK_VERIFY_SCREEN_TOLERANCE;
    row.check.claimed = scene->height_field;
    snprintf(row.point, sizeof row.point, "%s", scene->point);
    nook_result result = nook_setting_parse("verify", row.settings, &setting);
    if (result == NOOK_OK)
        result = nook_verify_rig_look(w->rig, scene, &setting, &occlusion, &row.outside);
    if (result != NOOK_OK)
        return result;
    row.check.missing = missing_by(scene, camera, NOOK_FORM_COSINE, lack);
    return end_row(w, &row, &occlusion);
}

/** Whether any of them is chosen. */
static bool any_looks(const nook_verify_desc *desc)
{
    bool any = false;
    for (size_t i = 0; i < desc->technique_count; i++)
        any = any || claim_of(desc->techniques[i]).reads_picture;
    return any;
}

/** All techniques that know the depth buffer only. */
static nook_result look_at(const work *w, uint32_t point)
{
    nook_verify_scene scene;
    nook_result result = NOOK_OK;
    nook_verify_scene_make(w->fixture, point, NOOK_VERIFY_PICTURE, &scene);
    for (size_t k = 0; k < NOOK_VERIFY_CAMERAS_MAX && scene.cameras[k].name && result == NOOK_OK; k++) {
        const nook_verify_camera *camera = &scene.cameras[k];
        lacking lack = { 0 };
        result = nook_verify_rig_draw(w->rig, &scene, camera);
        for (size_t i = 0; result == NOOK_OK && i < w->desc->technique_count; i++) {
            if (claim_of(w->desc->techniques[i]).reads_picture)
                result = look(w, w->desc->techniques[i], &scene, camera, &lack);
            else if (w->desc->techniques[i]->exact)
                result = look_through_screen(w, &scene, camera, &lack);
        }
    }
    nook_verify_scene_free(&scene);
    return result;
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
                                  .reason = "no technique here computes it: all have a normal" };
    return nook_verify_rows_add(rows, &row);
}

static nook_result run_fixtures(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows)
{
    size_t count;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&count);
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < count; i++) {
        const work w = { desc, rig, &fixtures[i], rows };
        uint32_t points = desc->quick ? fixtures[i].quick_points : fixtures[i].points;
        if (!nook_verify_wants(desc, fixtures[i].row, fixtures[i].name))
            continue;
        for (uint32_t point = 0; point < points && result == NOOK_OK; point++) {
            result = measure_told(&w, point, false);
            if (result == NOOK_OK)
                result = measure_told(&w, point, true);
            if (result == NOOK_OK && point < fixtures[i].picture_points && any_looks(desc))
                result = look_at(&w, point);
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
