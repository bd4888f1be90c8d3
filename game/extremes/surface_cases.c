/* What stands in the G-buffer: normals that are none, depths that are none, surfaces seen along themselves, images of one pixel. */
#include "engine/core/angle.h"
#include "game/extremes/edge_pictures.h"
#include "game/extremes/groups.h"
#include "game/extremes/surface_internal.h"
#include "modules/ao/sampling.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- Rays ---- */

static nook_result run_flattest_ray(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const uint32_t most = extremes->quick ? 1024 : 4096, seeds = extremes->quick ? 2 : 16;
    float *directions = malloc((size_t)NOOK_DIRECTION_BLOCKS * most * 4 * sizeof *directions);
    if (!directions)
        return nook_fail(NOOK_E_MEMORY, "extremes: no room for %u directions", most);
    out_found->bound = 0.0;
    double flattest = 1.0;
    for (uint32_t seed = 0; seed < seeds; seed++) {
        nook_fill_directions(most, seed, 0, directions);
        for (size_t i = 0; i < (size_t)NOOK_DIRECTION_BLOCKS * most; i++) {
            const float *d = directions + 4 * i;
            double length = sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
            bool good = d[2] > 0.0f && fabs(length - 1.0) < 1e-6;
            flattest = fmin(flattest, d[2]);
            if (!good)
                nook_extreme_worst(out_found, out_found->measured + 1.0, "seed %u, direction %zu: cosine %g, length %g",
                                   seed, i, (double)d[2], length);
        }
    }
    nook_extreme_worst(out_found, 0.0, "%u seeds of 16 x %u rays; the flattest has a cosine of %.2g", seeds, most,
                       flattest);
    free(directions);
    return NOOK_OK;
}

/* ---- Surfaces seen along themselves ---- */

/** A wide floor seen from `elevation` above it; nothing else. Its occlusion is 0. */
static nook_result look_along(const nook_extremes *extremes, double elevation, nook_edge_scene *out_scene)
{
    const uint32_t side = extremes->quick ? 16 : 32;
    nook_result result =
        nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = side, .height = side }, out_scene);
    if (result != NOOK_OK)
        return result;
    nook_fixture_view *view = out_scene->view;
    const double eye[3] = { 0, -cos(elevation), sin(elevation) }, target[3] = { 0, 0, 0 }, up[3] = { 0, 0, 1 };
    nook_fixture_mesh floor = { 0 };
    nook_fixture_add_quad(&floor, (double[]){ -10, -10, 0 }, (double[]){ 20, 0, 0 }, (double[]){ 0, 20, 0 });
    nook_fixture_view_drop_occluders(view);
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    view->clip_from_view = nook_matrix_perspective_reversed(0.5 * elevation, 1.0, 1e-3); /* no pixel over the horizon */
    nook_fixture_mesh_free(&out_scene->world);
    out_scene->world = floor;
    result = nook_fixture_view_add(view, &floor, 64, NULL, NULL);
    if (result == NOOK_OK)
        result = nook_edge_scene_draw(out_scene);
    if (result != NOOK_OK)
        nook_edge_scene_free(out_scene);
    return result;
}

/** Every technique (exact and volume ones, or those of the screen) on that floor, with and without the host's normals. */
static nook_result measure_floor(nook_edge_scene *scene, bool screen, const char *where, nook_extreme_found *found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < 2 * count; i++) {
        const nook_edge_estimator *estimator = &estimators[i / 2];
        if ((estimator->technique->inputs == 0) != screen)
            continue;
        scene->view->without_normals = i % 2 == 1;
        result = nook_edge_scene_record(scene, estimator->name, found, "%s", where);
        if (result == NOOK_OK)
            nook_extreme_worst(found, nook_edge_occlusion(scene->view->visibility, scene->pixels), "%s %s%s",
                               estimator->name, where, i % 2 ? ", normals rebuilt" : "");
    }
    return result;
}

/** Of r_max, so that what screen space meets is in the picture. */
static const double reaches_pixels[] = { 16.0, 0.25, 1.0, 4.0 };

static nook_result measure_along(const nook_extremes *extremes, double degrees, bool screen, nook_extreme_found *found)
{
    const size_t count = screen ? NOOK_COUNT(reaches_pixels) : 1;
    nook_edge_scene scene;
    nook_result result = look_along(extremes, degrees / 180.0 * NOOK_PI, &scene);
    if (result != NOOK_OK)
        return result;
    const double pixel = 2.0 / (scene.view->clip_from_view.m[5] * scene.view->height);
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        char where[96];
        snprintf(where, sizeof where, "at %g degrees over the floor", degrees);
        if (screen) {
            snprintf(where, sizeof where, "at %g degrees over the floor, a reach of %g pixels", degrees,
                     reaches_pixels[i]);
            result = nook_edge_scene_reach(&scene, reaches_pixels[i] * pixel);
        }
        if (result == NOOK_OK)
            result = measure_floor(&scene, screen, where, found);
    }
    nook_edge_scene_free(&scene);
    return result;
}

static nook_result run_along(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double degrees[] = { 0.1, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5 };
    const size_t count = extremes->quick ? 2 : NOOK_COUNT(degrees);
    nook_result result = NOOK_OK;
    out_found->bound = 0.0;
    for (size_t i = 0; result == NOOK_OK && i < count; i++)
        result = measure_along(extremes, degrees[i], false, out_found);
    return result;
}

static nook_result run_screen_along(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double degrees[] = { 0.1, 60.0, 90.0, 40.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2 };
    const size_t count = extremes->quick ? 2 : NOOK_COUNT(degrees);
    nook_result result = NOOK_OK;
    out_found->bound = 1e-4;
    for (size_t i = 0; result == NOOK_OK && i < count; i++)
        result = measure_along(extremes, degrees[i], true, out_found);
    return result;
}

static const nook_extreme cases[] = {
    { .name = "every ray of 16 x 4096 leaves the surface: its cosine is above 0",
      .unit = "rays",
      .why = "A ray along the surface or into it meets the surface itself.",
      .run = run_flattest_ray },
    { .name = "volume, reference: an open floor seen at 20 to 0.1 degrees is open",
      .unit = "mean A",
      .why = "The slab and the lift take up all rounding: a plane never darkens itself, with rebuilt normals neither.",
      .run = run_along },
    { .name = "screen space: an open floor seen at 90 to 0.1 degrees is open, r_max 1/4 to 16 pixels",
      .unit = "mean A",
      .why = "Nothing on or under a receiver's plane occludes it; what rounding lifts off it is a ten-thousandth.",
      .run = run_screen_along },
    { .name = "any RG16 normal code reaches techniques turned into view space to half a step",
      .unit = "radians",
      .why = "Half a step of 1/32767 in both directions turns a normal by at most sqrt(18)/2 of them.",
      .run = nook_surface_run_codes },
    { .name = "normals that are NaN or infinite are rebuilt from depth",
      .unit = "radians",
      .why = "On a plane the slope of depth is exact to the rounding of 24 bits over one pixel: 1e-4.",
      .run = nook_surface_run_rebuilt },
    { .name = "normals of any float, or turned along and into the surface, keep visibility in [0, 1]",
      .unit = "visibilities",
      .why = "Visibility outside of [0, 1] is wrong whatever the input.",
      .run = nook_surface_run_rubbish_normals },
    { .name = "depths of any float, and from a near plane of 1e-6 to 1e15, keep visibility in [0, 1]",
      .unit = "visibilities",
      .why = "Visibility outside of [0, 1] is wrong whatever the input.",
      .run = nook_surface_run_rubbish_depths },
    { .name = "background, and what is nearer than 1e-15 or beyond 1e15, is open",
      .unit = "visibilities",
      .why = "There is no surface: exactly 1.",
      .run = nook_surface_run_background },
    { .name = "images of 1 x 1, 1 x N and N x 1 pixels at every scale and filter keep to [0, 1]",
      .unit = "visibilities",
      .why = "Filters and tiles read beyond such images; visibility outside of [0, 1] is wrong whatever the input.",
      .run = nook_surface_run_sizes },
};

const nook_extreme_group nook_extreme_surfaces = { .name = "surfaces", .cases = cases, .count = NOOK_COUNT(cases) };
