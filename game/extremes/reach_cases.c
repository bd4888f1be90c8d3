/* r_max from a billionth of a unit to a billion of them. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/groups.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 48, SIDE_QUICK = 24 };
#define LOWEST 1e-9 /* of ao.r_max */
#define HIGHEST 1e9

/** The usual scene, with a truth of few shades. */
static nook_result make_scene(const nook_extremes *extremes, int rays, nook_edge_scene *out_scene)
{
    const uint32_t side = extremes->quick ? SIDE_QUICK : SIDE;
    nook_result result =
        nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = side, .height = side }, out_scene);
    if (result != NOOK_OK)
        return result;
    result = nook_ao_set_param(out_scene->view->ao, "reference.rays", rays);
    if (result != NOOK_OK)
        nook_edge_scene_free(out_scene);
    return result;
}

/** World units that a pixel covers where the camera looks at. */
static double pixel_footprint(const nook_edge_scene *scene)
{
    const nook_fixture_view *view = scene->view;
    double distance = 0.0;
    for (int axis = 0; axis < 3; axis++)
        distance += view->view_from_world.m[12 + axis] * view->view_from_world.m[12 + axis];
    return 2.0 * sqrt(distance) / (view->clip_from_view.m[5] * view->height);
}

static nook_result record(nook_edge_scene *scene, const char *technique, double r_max, nook_extreme_found *found)
{
    nook_result result = nook_edge_scene_reach(scene, r_max);
    return result == NOOK_OK ? nook_edge_scene_record(scene, technique, found, "r_max %g", r_max) : result;
}

/** @return the picture of `technique`, to be freed; NULL with *out_result on failure */
static float *take(nook_edge_scene *scene, const char *technique, double r_max, nook_extreme_found *found,
                   nook_result *out_result)
{
    *out_result = record(scene, technique, r_max, found);
    if (*out_result != NOOK_OK)
        return NULL;
    float *picture = malloc(scene->pixels * sizeof *picture);
    if (picture)
        memcpy(picture, scene->view->visibility, scene->pixels * sizeof *picture);
    else
        *out_result = nook_fail(NOOK_E_MEMORY, "extremes: no room for a picture");
    return picture;
}

/* ---- The limits of the parameter ---- */

/** Rays meet surfels sooner than their surface, by the initial volume.lift and volume.tolerance at most. Voxels. */
static const double SURFELS_SOONER = 0.15 + 0.1;

/** How much a technique darkens what the truth at this reach leaves open. */
static nook_result compare_with_open(nook_edge_scene *scene, double r_max, nook_extreme_found *found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_result result;
    float *truth = take(scene, "reference", r_max, found, &result), *farther = NULL;
    if (result == NOOK_OK)
        farther = take(scene, "reference", r_max + SURFELS_SOONER * scene->voxel_size, found, &result);
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        const float *open = strcmp(estimators[i].name, "volume.surfel") == 0 ? farther : truth;
        result = record(scene, estimators[i].name, r_max, found);
        for (size_t k = 0; result == NOOK_OK && k < scene->pixels; k++) {
            if (open[k] == 1.0f)
                nook_extreme_worst(found, 1.0 - scene->view->visibility[k], "%s, r_max %g, pixel %zu",
                                   estimators[i].name, r_max, k);
        }
    }
    free(truth);
    free(farther);
    return result;
}

static nook_result run_nothing(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double reaches[] = { LOWEST, 1e-6, 1e-4, 1e-2 };
    nook_edge_scene scene;
    out_found->bound = 0.0;
    nook_result result = make_scene(extremes, 16, &scene);
    if (result != NOOK_OK)
        return result;
    result = nook_ao_parse_param(scene.view->ao, "ao.filter", "none"); /* a pixel beside may rightly be dark */
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(reaches); i++)
        result = compare_with_open(&scene, reaches[i], out_found);
    nook_edge_scene_free(&scene);
    return result;
}

static nook_result run_everything(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const char *const techniques[] = { "volume", "volume.density", "volume.surfel", "volume.distance",
                                              "reference" };
    nook_edge_scene scene;
    out_found->bound = 0.0;
    nook_result result = make_scene(extremes, 16, &scene);
    if (result != NOOK_OK)
        return result;
    const double reaches[] = { 10.0 * scene.diagonal, 100.0 * scene.diagonal, HIGHEST };
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(techniques); i++) {
        float *diagonal = take(&scene, techniques[i], scene.diagonal, out_found, &result);
        for (size_t k = 0; result == NOOK_OK && k < NOOK_COUNT(reaches); k++) {
            result = record(&scene, techniques[i], reaches[k], out_found);
            if (result == NOOK_OK)
                nook_extreme_worst(out_found, nook_edge_different(diagonal, scene.view->visibility, scene.pixels),
                                   "%s, r_max %g", techniques[i], reaches[k]);
        }
        free(diagonal);
    }
    nook_edge_scene_free(&scene);
    return result;
}

static nook_result run_range(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    const double step = extremes->quick ? 1e3 : 10.0;
    nook_edge_scene scene;
    out_found->bound = 0.0;
    nook_result result = make_scene(extremes, 16, &scene);
    if (result != NOOK_OK)
        return result;
    for (double r_max = LOWEST; result == NOOK_OK && r_max <= HIGHEST * 1.001; r_max *= step) {
        for (size_t i = 0; result == NOOK_OK && i < count; i++)
            result = record(&scene, estimators[i].name, fmin(r_max, HIGHEST), out_found);
        nook_extreme_progress(extremes, log(r_max / LOWEST) / log(HIGHEST / LOWEST));
    }
    nook_extreme_worst(out_found, (double)out_found->outside, "%zu estimators, r_max %g to %g", count, LOWEST, HIGHEST);
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- Growth ---- */

static nook_result run_monotone(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_scene scene;
    nook_result result = make_scene(extremes, 64, &scene);
    float *before = NULL;
    out_found->bound = 0.0;
    if (result != NOOK_OK)
        return result;
    for (double share = 1e-3; result == NOOK_OK && share < 200.0; share *= extremes->quick ? 10.0 : 2.0) {
        float *now = take(&scene, "reference", share * scene.diagonal, out_found, &result);
        for (size_t i = 0; now && before && i < scene.pixels; i++)
            nook_extreme_worst(out_found, fmax(0.0, (double)now[i] - before[i]), "pixel %zu, r_max %g", i,
                               share * scene.diagonal);
        free(before);
        before = now;
    }
    free(before);
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- The volume, in voxels ---- */

/** How much of the true occlusion the volume has too little (positive) or too much, as a part of the truth. */
static nook_result measure_share(nook_edge_scene *scene, double r_max, nook_extreme_found *found, double *out_share)
{
    nook_result result;
    float *truth = take(scene, "reference", r_max, found, &result);
    if (result == NOOK_OK)
        result = record(scene, "volume", r_max, found);
    if (result == NOOK_OK)
        *out_share =
            nook_edge_bias(scene->view->visibility, truth, scene->pixels) / nook_edge_occlusion(truth, scene->pixels);
    free(truth);
    return result;
}

/** Of r_max, in voxels of the coarsest volume; the last ones are the diagonal and 100 of it. */
static const double reaches_voxels[] = { 2, 8, 3, 4, 6, 12, 16, 32, 93, 9300 };
enum { REACHES_QUICK = 2 };

static nook_result run_lost_reach(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const size_t count = extremes->quick ? REACHES_QUICK : NOOK_COUNT(reaches_voxels);
    nook_edge_scene scene;
    nook_result result = make_scene(extremes, 256, &scene);
    out_found->bound = 1.0;
    if (result != NOOK_OK)
        return result;
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        double r_max = reaches_voxels[i] * scene.voxel_size, share = NAN;
        result = measure_share(&scene, r_max, out_found, &share);
        /* Beyond the scene nothing more is reached. */
        nook_extreme_worst(out_found, fabs(share) * fmin(r_max, scene.diagonal) / scene.voxel_size,
                           "r_max of %g voxels, %.1f %% of the occlusion", reaches_voxels[i], -100.0 * share);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/** What is missed where r_max is a voxel or less, and the surface's own slab is most of it. */
static nook_result state_short_reaches(const nook_extremes *extremes, nook_edge_scene *scene, nook_extreme_found *found)
{
    static const struct {
        double voxels, missed, tolerance;
    } short_reaches[] = { { 0.1, 1.0, 0.0 }, { 0.5, 0.8, 0.03 }, { 1.0, 0.62, 0.03 }, { 1.5, 0.28, 0.03 } };
    const double few_pixels = extremes->quick ? 4.0 : 1.0; /* how much of the floor is near an edge depends on them */
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(short_reaches); i++) {
        double share = NAN;
        result = measure_share(scene, short_reaches[i].voxels * scene->voxel_size, found, &share);
        nook_extreme_state(found, short_reaches[i].missed, few_pixels * short_reaches[i].tolerance, share,
                           "part of A that is missed at an r_max of %g voxels", short_reaches[i].voxels);
    }
    return result;
}

static nook_result run_two_voxels(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const size_t count = extremes->quick ? REACHES_QUICK : NOOK_COUNT(reaches_voxels);
    nook_edge_scene scene;
    nook_result result = make_scene(extremes, 256, &scene);
    out_found->bound = 0.25;
    if (result != NOOK_OK)
        return result;
    result = state_short_reaches(extremes, &scene, out_found);
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        double share = NAN;
        result = measure_share(&scene, reaches_voxels[i] * scene.voxel_size, out_found, &share);
        nook_extreme_worst(out_found, share, "r_max of %g voxels", reaches_voxels[i]);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- Screen space, in pixels ---- */

/** RMSE of every technique but the reference as a part of that of no occlusion at all. */
static nook_result compare_with_none(nook_edge_scene *scene, double r_max, const char *where, nook_extreme_found *found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_result result;
    float *truth = take(scene, "reference", r_max, found, &result);
    double none = 0.0;
    for (size_t i = 0; truth && i < scene->pixels; i++)
        none += (1.0 - truth[i]) * (1.0 - truth[i]) / (double)scene->pixels;
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        if (estimators[i].technique->exact)
            continue;
        result = record(scene, estimators[i].name, r_max, found);
        if (result == NOOK_OK)
            nook_extreme_worst(found, nook_edge_rms(truth, scene->view->visibility, scene->pixels) / sqrt(none),
                               "%s, r_max of %s", estimators[i].name, where);
    }
    free(truth);
    return result;
}

/** What part of A the technique in screen space that finds most finds. @param truth  A at that reach */
static nook_result state_found(nook_edge_scene *scene, double r_max, double stated, double truth, const char *where,
                               nook_extreme_found *found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    double most = 0.0;
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        if (estimators[i].technique->inputs != 0)
            continue;
        result = record(scene, estimators[i].name, r_max, found);
        most = fmax(most, nook_edge_occlusion(scene->view->visibility, scene->pixels));
    }
    nook_extreme_state(found, stated, 0.02, most / truth,
                       "part of A found in screen space, at the most, at an r_max of %s", where);
    return result;
}

static nook_result state_ends(nook_edge_scene *scene, double pixel, nook_extreme_found *found)
{
    const double reaches[] = { 0.5 * pixel, 100.0 * scene->diagonal }, stated[] = { 0.0, 0.11 };
    const char *const names[] = { "half a pixel", "100 diagonals" };
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(reaches); i++) {
        result = record(scene, "reference", reaches[i], found);
        const double truth = nook_edge_occlusion(scene->view->visibility, scene->pixels);
        if (result == NOOK_OK)
            result = state_found(scene, reaches[i], stated[i], truth, names[i], found);
    }
    return result;
}

static nook_result run_better_than_none(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_scene scene;
    nook_result result = make_scene(extremes, 256, &scene);
    out_found->bound = 1.0;
    if (result != NOOK_OK)
        return result;
    const double pixel = pixel_footprint(&scene);
    result = compare_with_none(&scene, scene.diagonal, "the diagonal", out_found);
    for (double pixels = 1.0; result == NOOK_OK && pixels * pixel < scene.diagonal; pixels *= 2.0) {
        char where[32];
        snprintf(where, sizeof where, "%g pixels", pixels);
        result = compare_with_none(&scene, pixels * pixel, where, out_found);
        nook_extreme_progress(extremes, log(pixels) / log(scene.diagonal / pixel));
    }
    if (result == NOOK_OK)
        result = state_ends(&scene, pixel, out_found);
    nook_edge_scene_free(&scene);
    return result;
}

static const nook_extreme cases[] = {
    { .name = "an r_max of 1e-9, the lowest, to 0.01, part of a pixel, darkens nothing that is open",
      .unit = "A",
      .why = "Where 16 rays meet nothing within part of a pixel, whatever darkens is the pixel's own surface. "
             "Surfels are met a quarter voxel sooner: where rays meet nothing within that more.",
      .run = run_nothing },
    { .name = "volumes, reference: an r_max from the diagonal to 1e9, the highest, changes no bit",
      .unit = "pixels",
      .why = "There is nothing more to reach, and no step of theirs grows with r_max.",
      .run = run_everything },
    { .name = "every technique keeps to [0, 1] from an r_max of 1e-9 to one of 1e9",
      .unit = "visibilities",
      .why = "Visibility outside of [0, 1] is wrong whatever the input.",
      .run = run_range },
    { .name = "reference: no pixel gets lighter when r_max grows from a thousandth to 200 diagonals",
      .unit = "visibility",
      .why = "Hard falloff and the same rays, which reach further: what was hit is still hit.",
      .run = run_monotone },
    { .name = "volume: what it misses or adds is less than a voxel of its reach, 2 voxels to 100 scenes",
      .unit = "voxels of reach",
      .why = "A surface lies within a voxel of its filtered image; a voxel of r_max is that part of A.",
      .run = run_lost_reach },
    { .name = "volume: from an r_max of 2 voxels on at most a quarter of the occlusion is missed",
      .unit = "part of A",
      .why = "Half a voxel of two, where the surface's own slab lies: what a shell one voxel thick can lose.",
      .limit =
          "volume: r_max of at least 2 voxels; at 1.5 it misses 28 % of the occlusion, at 1 62 %, at half of one 80 %, "
          "at a tenth all.",
      .run = run_two_voxels },
    { .name = "every technique is nearer to the truth than no occlusion, from a pixel to the diagonal",
      .unit = "RMSE by RMSE of none",
      .why = "1 is where ambient occlusion does more harm than good.",
      .limit = "screen space: r_max from a pixel to the scene's diagonal; at half a pixel nothing is found, at 100 "
               "diagonals "
               "11 % at the most.",
      .run = run_better_than_none },
};

const nook_extreme_group nook_extreme_reach = { .name = "reach", .cases = cases, .count = NOOK_COUNT(cases) };
