/* One sample to thousands: rays, steps, thresholds, and every parameter of every technique at its ends. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/edge_receiver.h"
#include "game/extremes/groups.h"
#include "game/settings/setting.h"
#include "game/techniques.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double thresholds[] = { 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99 };
static const char *const steppings[] = { "fixed", "matched" }, *const combines[] = { "multiply", "union" },
                         *const guards[] = { "slab", "lifted" };

/* ---- In a closed box -------------------------------------------------------------------------------------------- */

enum { BOX_SIDE = 32 }; /* voxels; the receiver is in the middle of its floor */

static nook_result show_box(nook_edge_receiver *receiver)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -0.5, -0.5, 0.0 }, (double[]){ 0.5, 0.5, 1.0 }, 63);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, BOX_SIDE, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    return result;
}

/* The longest path in it, metres: from corner to corner of what the filter reaches. */
static double longest_path(void)
{
    return sqrt(3.0) * (BOX_SIDE + 1.0) / BOX_SIDE;
}

static nook_result measure_box(nook_edge_receiver *receiver, const char *setting, nook_fixture_occlusion *out)
{
    nook_result result = nook_edge_receiver_set(receiver, longest_path(), "%s", setting);
    return result == NOOK_OK ? nook_edge_receiver_measure(receiver, out, "%s", setting) : result;
}

static nook_result look_at_rays(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    static const uint32_t rays[] = { 1, 2, 3, 7, 16, 65, 255, 4096 };
    nook_result result = show_box(receiver);
    for (size_t k = 0; k < NOOK_COUNT(rays) * 4 && result == NOOK_OK; k++) {
        char setting[128];
        nook_fixture_occlusion occlusion = { 0 };
        if (extremes->quick && rays[k / 4] > 255)
            continue; /* 255 rays of hundreds of steps do end loops that are not cut */
        snprintf(setting, sizeof setting, "volume rays=%u steps=1024 stepping=%s combine=%s", rays[k / 4],
                 steppings[k % 2], combines[k / 2 % 2]);
        result = measure_box(receiver, setting, &occlusion);
        if (result == NOOK_OK)
            nook_extreme_worst(receiver->found, 1.0 - occlusion.lowest, "%s", setting);
        nook_extreme_progress(extremes, (double)k / (NOOK_COUNT(rays) * 4));
    }
    return result;
}

static nook_result run_rays(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_rays);
}

/*
 * Every ray crosses a wall's layer of 2 (1 - threshold) voxels, less what the hardware's weights of 8 bits round off, in steps
 * no longer than the longest path / steps, at a random phase.
 */
static double least_in_box(uint32_t steps, double threshold)
{
    double layer = fmax(2.0 * (1.0 - threshold) - 2.0 / 256.0, 0.0) / BOX_SIDE;
    return fmin(1.0, layer * steps / longest_path());
}

/* A of one threshold with few steps, which the limit is about. */
typedef struct few_steps {
    double of_8, of_16, of_64;
} few_steps;

static void keep_few(few_steps *few, uint32_t steps, double occlusion)
{
    if (steps == 8)
        few->of_8 = occlusion;
    else if (steps == 16)
        few->of_16 = occlusion;
    else if (steps == 64)
        few->of_64 = occlusion;
}

static nook_result look_at_budgets(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    static const uint32_t budgets[] = { 1, 2, 4, 8, 16, 32, 64, 128, 256, 1024 };
    const uint32_t rays = extremes->quick ? 16 : 256;
    nook_result result = show_box(receiver);
    few_steps few = { NAN, NAN, NAN };
    receiver->found->bound = 3.0;
    for (size_t k = 0; k < NOOK_COUNT(budgets) * NOOK_COUNT(thresholds) * 4 && result == NOOK_OK; k++) {
        double threshold = thresholds[k / 4 % NOOK_COUNT(thresholds)];
        uint32_t steps = budgets[k / 4 / NOOK_COUNT(thresholds)];
        char setting[128];
        nook_fixture_occlusion occlusion = { 0 };
        snprintf(setting, sizeof setting, "volume rays=%u steps=%u threshold=%g stepping=%s combine=%s", rays, steps,
                 threshold, steppings[k % 2], combines[k / 2 % 2]);
        result = measure_box(receiver, setting, &occlusion);
        double least = least_in_box(steps, threshold), count = (double)rays * NOOK_EDGE_PIXELS;
        double deviation = sqrt(fmax(least * (1.0 - least), 1.0 / count) / count);
        if (result == NOOK_OK)
            nook_extreme_worst(receiver->found, (least - occlusion.mean) / deviation,
                               "%s: A %.4f, at least %.4f expected", setting, occlusion.mean, least);
        if (threshold == 0.5 && k % 4 == 0)
            keep_few(&few, steps, occlusion.mean);
        nook_extreme_progress(extremes, (double)k / (NOOK_COUNT(budgets) * NOOK_COUNT(thresholds) * 4));
    }
    nook_extreme_state(receiver->found, 1.0, 0.0, few.of_64, "A of 64 steps, threshold 0.5, across up to 57 voxels");
    nook_extreme_state(receiver->found, 2.0, 0.2, few.of_16 / few.of_8, "A of 16 steps by that of 8");
    return result;
}

static nook_result run_budgets(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_budgets);
}

/* ---- On an open floor ------------------------------------------------------------------------------------------- */

/* A floor through the receiver, at a phase and a tilt of the voxels; two specks fix the box that is baked. */
static nook_result show_floor(nook_edge_receiver *receiver, double phase, double tilt)
{
    const double c = cos(tilt), s = sin(tilt), u[3] = { 1.8 * c, 0, 1.8 * s }, v[3] = { 0, 1.8, 0 };
    const double corner[3] = { -0.9 * c, -0.9, -0.9 * s };
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_view_drop_occluders(receiver->view);
    nook_fixture_add_quad(&mesh, corner, u, v);
    for (int side = 0; side < 2; side++) {
        double p = (side ? 1.5 : -1.5) - phase * 3.0 / 48;
        nook_fixture_add_triangle(&mesh, (double[]){ p, p, p }, (double[]){ p, p, p }, (double[]){ p, p, p });
    }
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, 48, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    receiver->at = (nook_fixture_receiver){ .normal = { -s, 0, c }, .distance = 0.5, .angle = 0.6 };
    return result;
}

static nook_result look_at_floors(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    static const double tilts[] = { 0.0, 0.05, 0.3, 0.7853981633974483, 1.2 };
    const int phases = extremes->quick ? 2 : 6, rays = extremes->quick ? 8 : 32;
    const size_t skip = extremes->quick ? 3 : 1; /* 0.01, 0.5 and 0.99 are left */
    nook_result result = NOOK_OK;
    for (int k = 0; k < phases * (int)NOOK_COUNT(tilts) && result == NOOK_OK; k++) {
        double phase = (double)(k / (int)NOOK_COUNT(tilts)) / phases, tilt = tilts[k % (int)NOOK_COUNT(tilts)];
        result = show_floor(receiver, phase, tilt);
        for (size_t way = 0; way < NOOK_COUNT(thresholds) * 4 && result == NOOK_OK; way++) {
            nook_fixture_occlusion occlusion = { 0 };
            double threshold = thresholds[way / 4];
            if (way / 4 % skip != 0)
                continue;
            result = nook_edge_receiver_set(receiver, 0.4, "volume rays=%d steps=256 threshold=%g stepping=%s guard=%s",
                                            rays, threshold, steppings[way % 2], guards[way / 2 % 2]);
            if (result == NOOK_OK)
                result = nook_edge_receiver_measure(receiver, &occlusion, "a floor at threshold %g", threshold);
            if (result == NOOK_OK)
                nook_extreme_worst(receiver->found, occlusion.highest, "threshold %g, tilt %g, phase %g, %s, %s",
                                   threshold, tilt, phase, steppings[way % 2], guards[way / 2 % 2]);
        }
    }
    return result;
}

static nook_result run_floors(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_floors);
}

/* ---- More of everything ----------------------------------------------------------------------------------------- */

/* What more of should come nearer to what the most of it gives, up to at least thirty times what people use. */
typedef struct series {
    const char *technique, *number, *others;
    uint32_t most, most_quick;
} series;

static const series growing[] = {
    { "volume", "rays", "", 4096, 1024 },
    { "volume", "rays", " stepping=fixed", 4096, 256 },
    { "volume", "rays", " guard=slab", 4096, 256 },
    { "volume", "rays", " combine=multiply", 4096, 256 },
    { "ssao", "samples", "", 1024, 1024 },
    { "ssao", "samples", " kernel=sphere", 1024, 1024 },
    { "hsao", "directions", "", 256, 256 },
    { "hsao", "steps", " rays=4", 256, 256 },
    { "hbao", "directions", "", 256, 256 },
    { "hbao", "steps", "", 256, 256 },
    { "gtao", "slices", "", 256, 256 },
    { "gtao", "steps", "", 256, 256 },
    { "hao", "rays", "", 1024, 1024 },
    { "hao", "tests", "", 256, 256 },
    { "reference", "rays", "", 4096, 1024 },
};

static nook_result record(nook_edge_scene *scene, const series *s, uint32_t number, nook_extreme_found *found)
{
    char text[NOOK_SETTING_TEXT_MAX];
    nook_setting setting;
    snprintf(text, sizeof text, "%s %s=%u%s", s->technique, s->number, number, s->others);
    nook_result result = nook_setting_parse("extremes", text, &setting);
    if (result == NOOK_OK)
        result = nook_setting_assign("extremes", &setting, "ao.filter", "none");
    if (result == NOOK_OK)
        result = nook_setting_apply(scene->view->ao, &setting);
    return result == NOOK_OK ? nook_edge_scene_record(scene, s->technique, found, "%s", text) : result;
}

/* RMS to the picture of the most, for 1, 4, 16, ... */
static nook_result look_at_series(nook_edge_scene *scene, const series *s, uint32_t most, float *own_limit,
                                  nook_extreme_found *found)
{
    nook_result result = record(scene, s, most, found);
    if (result != NOOK_OK)
        return result;
    double before = INFINITY;
    memcpy(own_limit, scene->view->visibility, scene->pixels * sizeof *own_limit);
    for (uint32_t number = 1; number < most && result == NOOK_OK; number *= 4) {
        result = record(scene, s, number, found);
        double rms = nook_edge_rms(scene->view->visibility, own_limit, scene->pixels);
        if (result == NOOK_OK)
            nook_extreme_worst(found, fmax(rms - before, 0.0), "%s %s=%u%s: RMS %.4f, of %u %.4f", s->technique,
                               s->number, number, s->others, rms, number / 4, before);
        before = rms;
    }
    return result;
}

static nook_result run_growing(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const uint32_t side = extremes->quick ? 20 : 40;
    nook_edge_scene scene;
    nook_result result =
        nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = side, .height = side }, &scene);
    if (result != NOOK_OK)
        return result;
    float *own_limit = malloc(scene.pixels * sizeof *own_limit);
    if (!own_limit)
        result = nook_fail(NOOK_E_MEMORY, "extremes: no room for a picture");
    for (size_t i = 0; i < NOOK_COUNT(growing) && result == NOOK_OK; i++) {
        const series *s = &growing[i];
        result = look_at_series(&scene, s, extremes->quick ? s->most_quick : s->most, own_limit, out_found);
        nook_extreme_progress(extremes, (double)(i + 1) / NOOK_COUNT(growing));
    }
    free(own_limit);
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- The ends of every parameter -------------------------------------------------------------------------------- */

/* All parameters of a table at their lowest or highest values in turn, the others as they are at first. */
static nook_result look_at_ends(nook_edge_scene *scene, const char *technique, const char *owner,
                                const nook_param *params, size_t count, nook_extreme_found *found)
{
    nook_result result = NOOK_OK;
    for (size_t k = 0; k < 2 * count && result == NOOK_OK; k++) {
        const nook_param *param = &params[k / 2];
        char name[128];
        double before, value = k % 2 ? param->highest : param->lowest;
        snprintf(name, sizeof name, "%s.%s", owner, param->name);
        result = nook_ao_get_param(scene->view->ao, name, &before);
        if (result == NOOK_OK)
            result = nook_ao_set_param(scene->view->ao, name, value);
        if (result == NOOK_OK)
            result = nook_edge_scene_record(scene, technique, found, "%s with %s=%g", technique, name, value);
        if (result == NOOK_OK)
            nook_extreme_worst(found, (double)scene->view->outside, "%s with %s=%g", technique, name, value);
        nook_result restored = nook_ao_set_param(scene->view->ao, name, before);
        result = result == NOOK_OK ? restored : result;
    }
    return result;
}

static nook_result run_ends(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const uint32_t side = extremes->quick ? 12 : 24;
    size_t count, shared_count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    nook_edge_scene scene;
    nook_result result =
        nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = side, .height = side }, &scene);
    if (result != NOOK_OK)
        return result;
    const nook_param *shared = nook_ao_shared_params(&shared_count);
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        const nook_ao_technique *technique = techniques[i];
        result = look_at_ends(&scene, technique->name, technique->name, technique->params, technique->param_count,
                              out_found);
        if (result == NOOK_OK)
            result = look_at_ends(&scene, technique->name, "ao", shared, shared_count, out_found);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/* All of a technique's parameters at one end: at the highest, millions of samples a pixel. */
static nook_result set_all(nook_ao *ao, const nook_ao_technique *technique, bool highest)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < technique->param_count && result == NOOK_OK; i++) {
        char name[128];
        snprintf(name, sizeof name, "%s.%s", technique->name, technique->params[i].name);
        result = nook_ao_set_param(ao, name, highest ? technique->params[i].highest : technique->params[i].lowest);
    }
    return result;
}

static nook_result run_all_ends(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    nook_edge_scene scene;
    nook_result result = nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = 8, .height = 8 }, &scene);
    if (result != NOOK_OK)
        return result;
    for (size_t k = 0; k < 2 * count && result == NOOK_OK; k++) {
        const char *technique = techniques[k / 2]->name, *end = k % 2 ? "highest" : "lowest";
        if (extremes->quick && k % 2 && strcmp(technique, "hsao") == 0)
            continue; /* four million samples a pixel */
        result = set_all(scene.view->ao, techniques[k / 2], k % 2);
        if (result == NOOK_OK)
            result = nook_edge_scene_record(&scene, technique, out_found, "%s, all %s", technique, end);
        if (result == NOOK_OK)
            nook_extreme_worst(out_found, (double)scene.view->outside, "%s, all %s", technique, end);
        nook_extreme_progress(extremes, (double)k / (2.0 * (double)count));
    }
    nook_edge_scene_free(&scene);
    return result;
}

static const nook_extreme cases[] = {
    { .name = "a closed box is closed with 1 to 4096 rays, both steppings, union and product",
      .unit = "1 - A",
      .why = "its rays all hit, also when they take 65535 turns of loops by far: exactly 1 in every pixel",
      .run = run_rays },
    { .name = "few steps or high thresholds lose no more of a closed box than they must",
      .unit = "standard deviations",
      .why = "a step of k layers hits a layer once in k times (C9); 3 deviations of the rays that were cast",
      .limit = "Rays are sure to hit while 2 (1 - threshold) steps are as many as the voxels they cross; beyond, in "
               "that proportion.",
      .run = run_budgets },
    { .name = "an open floor occludes nothing at thresholds of 0.01 to 0.99",
      .unit = "A",
      .why = "rays start above all that the floor's own voxels reach (C7): exactly 0 at every tilt and phase",
      .run = run_floors },
    { .name = "four times the rays, steps or samples come nearer to the technique's own limit",
      .unit = "RMS gained",
      .why =
          "RMS to the picture of the most of them, not to the truth; random error would halve, so none may be gained",
      .run = run_growing },
    { .name = "every parameter of every technique holds at its lowest and its highest value",
      .unit = "pixels outside [0, 1]",
      .why = "a range is a promise: none may be outside",
      .run = run_ends },
    { .name = "all parameters of a technique hold at their lowest and highest values together",
      .unit = "pixels outside [0, 1]",
      .why = "a range is a promise: none may be outside, also of 4 million samples a pixel",
      .run = run_all_ends },
};

const nook_extreme_group nook_extreme_sampling = { "sampling", cases, NOOK_COUNT(cases) };
