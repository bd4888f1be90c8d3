/* Row 19: what the volume technique says of its own floor, its guard, its steps, of several occluders (errata C5, C7, C8, C9) and of
   panes. */
#include "game/verify/claims.h"
#include "game/verify/verify_run.h"
#include "modules/ao/technique.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/** Units are voxels in most of these: r_max of 8 is 8 voxels. */
typedef struct volume_check {
    const char *name, *point, *settings;
    double expected, tolerance, r_max;
    nook_falloff falloff;
} volume_check;

typedef struct volume_run {
    const nook_verify_desc *desc;
    nook_fixture_view *view;
    nook_verify_rows *rows;
} volume_run;

static const char *const LIFTED = "volume rays=1024 steps=1024 ao.filter=none";
static const char *const MULTIPLY = "volume rays=1024 steps=1024 combine=multiply ao.filter=none";

static nook_result measure(const volume_run *run, const volume_check *check, const double normal[3], double distance,
                           nook_fixture_occlusion *out_occlusion)
{
    nook_setting setting;
    nook_ao *ao = run->view->ao;
    const nook_fixture_receiver receiver = { .normal = { normal[0], normal[1], normal[2] }, .distance = distance };
    nook_result result = nook_setting_parse("verify", check->settings, &setting);
    if (result == NOOK_OK)
        result = nook_setting_apply(ao, &setting);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.r_max", check->r_max);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.falloff", (double)check->falloff);
    return result == NOOK_OK ? nook_fixture_measure(run->view, "volume", &receiver, out_occlusion) : result;
}

static nook_result report(const volume_run *run, const volume_check *check, double measured, double deviation)
{
    nook_verify_row row = { .number = 19,
                            .fixture = "volume_self",
                            .what = check->name,
                            .technique = "volume",
                            .target = "own: prediction",
                            .check = { .expected = check->expected,
                                       .measured = measured,
                                       .tolerance = check->tolerance,
                                       .spread = deviation,
                                       .spread_max = check->tolerance,
                                       .claimed = true },
                            .equation_1 = NAN,
                            .deviation = deviation,
                            .initial = NAN,
                            .outside = run->view->outside };
    snprintf(row.point, sizeof row.point, "%s", check->point);
    snprintf(row.settings, sizeof row.settings, "%s", check->settings);
    return nook_verify_rows_add(run->rows, &row);
}

/** Measures what was added to the view, from above, and drops it. */
static nook_result settle(const volume_run *run, const volume_check *check)
{
    nook_fixture_occlusion occlusion;
    nook_result result = measure(run, check, (double[]){ 0, 0, 1 }, 0.3, &occlusion);
    nook_fixture_view_drop_occluders(run->view);
    return result == NOOK_OK ? report(run, check, occlusion.mean, occlusion.deviation) : result;
}

static nook_result add(const volume_run *run, nook_fixture_mesh *mesh, uint32_t resolution)
{
    nook_result result = nook_fixture_view_add(run->view, mesh, resolution, NULL, NULL);
    nook_fixture_mesh_free(mesh);
    return result;
}

/* ---- C7: a floor at any phase and tilt reads 0 ------------------------------------------------------------------ */

/** A floor through the origin in voxels of 1/16, moved by a phase along each axis of the grid. */
static nook_result add_floor(const volume_run *run, double tilt, double turn, double phase)
{
    const double t[3] = { cos(tilt) * cos(turn), cos(tilt) * sin(turn), -sin(tilt) },
                 b[3] = { -sin(turn), cos(turn), 0 };
    const double size = 0.9, low = -1.5 - phase / 16, high = low + 3;
    double corner[3], edge_t[3], edge_b[3];
    for (int axis = 0; axis < 3; axis++) {
        corner[axis] = -size * (t[axis] + b[axis]);
        edge_t[axis] = 2 * size * t[axis], edge_b[axis] = 2 * size * b[axis];
    }
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, corner, edge_t, edge_b);
    for (int side = 0; side < 2; side++) { /* specks that hold the box */
        double p[3] = { side ? high : low, side ? high : low, side ? high : low };
        nook_fixture_add_triangle(&mesh, p, p, p);
    }
    return add(run, &mesh, 48);
}

/** @param settings  of the kind of volume @param bound  the most that a floor may read */
static nook_result check_floors(const volume_run *run, const char *settings, double bound)
{
    static const double tilts[] = { 0.0, 0.05, 0.3, 0.615479709, 0.785398163 }, turns[] = { 0.0, 0.785398163, 2.5 };
    const int phases = run->desc->quick ? 2 : 8;
    const volume_check check = { "C7: open floor", "15 tilts, phases of the grid, worst", settings, 0.0, bound, 0.4,
                                 NOOK_FALLOFF_HARD };
    double worst = 0.0;
    nook_result result = NOOK_OK;
    for (int k = 0; k < 15; k++) {
        double tilt = tilts[k / 3], turn = turns[k % 3];
        for (int phase = 0; phase < phases && result == NOOK_OK; phase++) {
            nook_fixture_occlusion got = { 0 };
            result = add_floor(run, tilt, turn, (double)phase / phases);
            if (result == NOOK_OK)
                result = measure(run, &check, (double[]){ sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt) },
                                 0.5, &got);
            worst = fmax(worst, got.highest);
            nook_fixture_view_drop_occluders(run->view);
        }
    }
    return result == NOOK_OK ? report(run, &check, worst, 0.0) : result;
}

/* ---- C8: the paper's guard ------------------------------------------------------------------------------------- */

/** A dome of a radius around the receiver: the paper's guard drops the rays that leave the slab beyond it. Voxels are 1. */
static nook_result check_dome(const volume_run *run, double radius, bool lifted)
{
    char point[64];
    const double slab = 1.0 / 2 + 1 - 0.4; /* of an upright normal at threshold 0.4 */
    snprintf(point, sizeof point, "dome of %g voxels, %s guard", radius, lifted ? "lifted" : "paper's");
    const volume_check check = { "C8: rays that the guard drops",
                                 point,
                                 lifted ? "volume rays=1024 steps=1024 threshold=0.4 stepping=fixed ao.filter=none"
                                        : "volume rays=1024 steps=1024 threshold=0.4 stepping=fixed guard=slab "
                                          "ao.filter=none",
                                 lifted ? 1.0 : nook_form_guarded_box(slab, radius),
                                 0.02,
                                 radius + 2.0,
                                 NOOK_FALLOFF_HARD };
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_sphere(&mesh, (double[]){ 0, 0, 0 }, radius, 64);
    nook_result result = add(run, &mesh, (uint32_t)(2.0 * radius));
    return result == NOOK_OK ? settle(run, &check) : result;
}

static nook_result check_guards(const volume_run *run)
{
    nook_result result = NOOK_OK;
    for (int k = 0; k < 4 && result == NOOK_OK; k++)
        result = check_dome(run, k % 2 ? 12.0 : 6.0, k >= 2);
    return result;
}

/* ---- C9: steps ------------------------------------------------------------------------------------------------- */

static nook_result check_steps(const volume_run *run)
{
    static const int steps[] = { 20, 40, 64, 160 };
    const double height = 20.0, r_max = 80.0, k = height / r_max; /* voxels are 1 */
    nook_result result = NOOK_OK;
    for (int i = 0; i < 4 && result == NOOK_OK; i++) {
        char point[64], settings[128];
        snprintf(point, sizeof point, "ceiling, layer of %g steps", steps[i] / r_max);
        snprintf(settings, sizeof settings, "volume rays=1024 steps=%d stepping=fixed guard=slab ao.filter=none",
                 steps[i]);
        const volume_check check = { "C9: steps beside a thin layer",
                                     point,
                                     settings,
                                     nook_form_stepped_ceiling(steps[i] / r_max, k),
                                     0.02,
                                     r_max,
                                     NOOK_FALLOFF_HARD };
        nook_fixture_mesh mesh = { 0 };
        nook_fixture_add_quad(&mesh, (double[]){ -128, -128, height }, (double[]){ 256, 0, 0 },
                              (double[]){ 0, 256, 0 });
        result = add(run, &mesh, 256);
        if (result == NOOK_OK)
            result = settle(run, &check);
    }
    return result;
}

/* ---- C5: several occluders -------------------------------------------------------------------------------------- */

static nook_result add_wall(const volume_run *run, double x)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ x, -21, 0 }, (double[]){ 0, 42, 0 }, (double[]){ 0, 0, 21 });
    return add(run, &mesh, 256);
}

/** The same wall twice, or two opposite ones, at 0.1 r_max. */
static nook_result check_walls(const volume_run *run)
{
    const double one = nook_form_wall(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.1);
    nook_result result = NOOK_OK;
    for (int k = 0; k < 4 && result == NOOK_OK; k++) {
        bool multiply = k & 1, opposite = k & 2;
        double product = nook_form_product((double[]){ one, one }, 2), whole = opposite ? 2 * one : one;
        char point[64];
        snprintf(point, sizeof point, "%s, %s", opposite ? "opposite walls" : "one wall twice",
                 multiply ? "multiply" : "union");
        const volume_check check = { "C5: several occluders",    point, multiply ? MULTIPLY : LIFTED,
                                     multiply ? product : whole, 0.02,  20.0,
                                     NOOK_FALLOFF_HARD };
        result = add_wall(run, 2.0);
        if (result == NOOK_OK)
            result = add_wall(run, opposite ? -2.0 : 2.0);
        if (result == NOOK_OK)
            result = settle(run, &check);
    }
    return result;
}

static nook_result check_cube(const volume_run *run)
{
    const double ceiling = 4.0 * nook_form_level_rectangle(NOOK_FORM_COSINE, 0.5, 0.5, 1.0);
    const double wall = 2.0 * nook_form_upright_rectangle(NOOK_FORM_COSINE, 0.5, 1.0, 0.5);
    const double faces[] = { ceiling, wall, wall, wall, wall };
    nook_result result = NOOK_OK;
    for (int multiply = 0; multiply < 2 && result == NOOK_OK; multiply++) {
        const volume_check check = { "C5: several occluders",
                                     multiply ? "six faces of a cube, multiply" : "six faces of a cube, union",
                                     multiply ? MULTIPLY : LIFTED,
                                     multiply ? nook_form_product(faces, 5) : 1.0,
                                     0.02,
                                     1000.0,
                                     NOOK_FALLOFF_HARD };
        for (unsigned face = 0; face < 6 && result == NOOK_OK; face++) {
            nook_fixture_mesh mesh = { 0 };
            nook_fixture_add_box(&mesh, (double[]){ -32, -32, 0 }, (double[]){ 32, 32, 64 }, 1u << face);
            result = add(run, &mesh, 128);
        }
        if (result == NOOK_OK)
            result = settle(run, &check);
    }
    return result;
}

/* ---- Panes: one takes its alpha once, two multiply --------------------------------------------------------------- */

/** Two panes of alpha 0.4 overhead, at 0.2 and 0.4 r_max; the upper one may be left out. Voxels are 1. */
static nook_result check_panes(const volume_run *run)
{
    const double alpha = 0.4, r_max = 40.0;
    nook_result result = NOOK_OK;
    for (int panes = 1; panes <= 2 && result == NOOK_OK; panes++) {
        double lower = nook_form_ceiling(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.0, 0.2);
        double upper = nook_form_ceiling(NOOK_FORM_COSINE, NOOK_FALLOFF_HARD, 0.0, 0.4);
        const volume_check check = { "panes of alpha 0.4",
                                     panes == 1 ? "one overhead" : "two overhead",
                                     "volume kind=density rays=1024 ao.filter=none",
                                     alpha * lower + (panes == 2 ? (1.0 - alpha) * alpha * upper : 0.0),
                                     0.02,
                                     r_max,
                                     NOOK_FALLOFF_HARD };
        nook_fixture_mesh mesh = { .transparency = 1.0 - alpha };
        for (int i = 1; i <= panes; i++)
            nook_fixture_add_quad(&mesh, (double[]){ -128, -128, 0.2 * i * r_max }, (double[]){ 256, 0, 0 },
                                  (double[]){ 0, 256, 0 });
        result = add(run, &mesh, 256);
        if (result == NOOK_OK)
            result = settle(run, &check);
    }
    return result;
}

nook_result nook_verify_volume_checks(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows)
{
    const volume_run run = { desc, rig->receiver, rows };
    bool chosen = false;
    for (size_t i = 0; i < desc->technique_count; i++)
        chosen = chosen || strcmp(desc->techniques[i]->name, "volume") == 0;
    if (!chosen || !nook_verify_wants(desc, 19, "volume_self"))
        return NOOK_OK;
    nook_fixture_view_drop_occluders(rig->receiver);
    nook_result result = check_floors(&run, "volume rays=64 ao.filter=none", 1.0 / 255);
    if (result == NOOK_OK)
        result = check_floors(&run, "volume kind=surfel rays=64 ao.filter=none", 0.0);
    if (result == NOOK_OK)
        result = check_floors(&run, "volume kind=density rays=64 ao.filter=none", 0.0);
    if (result == NOOK_OK)
        result = check_floors(&run, "volume kind=distance rays=64 ao.filter=none", 0.0);
    if (result == NOOK_OK)
        result = check_panes(&run);
    if (result == NOOK_OK)
        result = check_guards(&run);
    if (result == NOOK_OK)
        result = check_steps(&run);
    if (result == NOOK_OK)
        result = check_walls(&run);
    return result == NOOK_OK ? check_cube(&run) : result;
}
