/* Depths that a host may give, and those that it should not; images of any size. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/surface_internal.h"
#include <math.h>
#include <stdio.h>

/* ---- Rubbish ---- */

static void spoil(nook_edge_scene *scene)
{
    static const float depths[] = { NAN,  INFINITY, -INFINITY, -1.0f,  0.0f,   -0.0f,  1.0f,
                                    2.0f, 1e30f,    -1e30f,    1e-30f, 1e-45f, 3.4e38f };
    for (size_t i = 0; i < scene->pixels; i += 2)
        scene->view->device_depth[i] = depths[i / 2 % NOOK_COUNT(depths)];
}

/** Distances from the near plane to 1e15 times as far, each beside each. */
static void draw_any_distance(nook_edge_scene *scene)
{
    nook_fixture_view *view = scene->view;
    for (uint32_t i = 0; i < scene->pixels; i++) {
        double near = view->clip_from_view.m[14], normal[3] = { 0, 0, 1 };
        double distance = near * pow(10.0, (double)(i * 7u % 61u) * 0.35);
        nook_fixture_view_set_pixel(view, i % view->width, i / view->width, distance, normal);
    }
}

nook_result nook_surface_run_rubbish_depths(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const nook_edge_scene_desc kinds[] = { { .z_near = 1e-6 },
                                           { .z_near = 1e-6, .normal_z = true },
                                           { .z_near = 1e-6, .z_far = 1e9 },
                                           { .z_near = 0.1, .z_far = 100.0, .normal_z = true },
                                           { .rows_down = true } };
    const uint32_t side = extremes->quick ? 24 : 48;
    nook_result result = NOOK_OK;
    out_found->bound = 0.0;
    for (size_t k = 0; result == NOOK_OK && k < 2 * NOOK_COUNT(kinds); k++) {
        nook_edge_scene_desc desc = kinds[k / 2];
        nook_edge_scene scene;
        desc.width = desc.height = side, desc.resolution = 24;
        result = nook_edge_scene_make(extremes, &desc, &scene);
        if (result != NOOK_OK)
            break;
        scene.view->without_normals = k % 2 == 1;
        spoil(&scene);
        result = nook_edge_scene_record_all(&scene, out_found, "rubbish among depths");
        if (result == NOOK_OK && !desc.normal_z) {
            draw_any_distance(&scene);
            result = nook_edge_scene_record_all(&scene, out_found, "distances of 1e-6 to 1e15 side by side");
        }
        nook_edge_scene_free(&scene);
        nook_extreme_progress(extremes, (double)(k + 1) / (2.0 * NOOK_COUNT(kinds)));
    }
    return result;
}

/* ---- Background ---- */

/** Pixels whose visibility is not exactly 1. */
static double count_not_open(const nook_edge_scene *scene, size_t step)
{
    double count = 0.0;
    for (size_t i = 0; i < scene->pixels; i += step)
        count += scene->view->visibility[i] != 1.0f;
    return count;
}

/** All background; then every fourth pixel background, or too near or too far for floats, among what the scene has. */
static nook_result look_at_nothing(nook_edge_scene *scene, const char *technique, nook_extreme_found *found)
{
    nook_fixture_view_clear(scene->view);
    nook_result result = nook_edge_scene_record(scene, technique, found, "nothing in sight");
    nook_extreme_worst(found, count_not_open(scene, 1), "%s, nothing in sight", technique);
    if (result == NOOK_OK)
        result = nook_edge_scene_draw(scene);
    const float none[] = { 0.0f, 1e20f, 1e-17f, NAN }; /* of a reversed depth with its near plane at 0.1 */
    for (size_t i = 0; i < scene->pixels; i += 4)
        scene->view->device_depth[i] = none[i / 4 % NOOK_COUNT(none)];
    if (result == NOOK_OK)
        result = nook_edge_scene_record(scene, technique, found, "holes");
    nook_extreme_worst(found, count_not_open(scene, 4), "%s, holes in the picture", technique);
    return result;
}

nook_result nook_surface_run_background(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_edge_scene scene;
    const nook_edge_scene_desc desc = { .width = 24, .height = 24, .resolution = 24 };
    nook_result result = nook_edge_scene_make(extremes, &desc, &scene);
    out_found->bound = 0.0;
    for (size_t i = 0; result == NOOK_OK && i < count * NOOK_FIXTURE_SCALES; i++) {
        result = nook_ao_parse_param(scene.view->ao, "ao.scale", nook_fixture_scales[i % NOOK_FIXTURE_SCALES]);
        if (result == NOOK_OK)
            result = look_at_nothing(&scene, estimators[i / NOOK_FIXTURE_SCALES].name, out_found);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- Sizes of images ---- */

static nook_result record_size(nook_edge_scene *scene, nook_extreme_found *found)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < NOOK_FIXTURE_SCALES * NOOK_FIXTURE_FILTERS; i++) {
        char what[64];
        snprintf(what, sizeof what, "%u x %u pixels, scale %s, filter %s", scene->view->width, scene->view->height,
                 nook_fixture_scales[i % 3], nook_fixture_filters[i / 3]);
        result = nook_ao_parse_param(scene->view->ao, "ao.scale", nook_fixture_scales[i % 3]);
        if (result == NOOK_OK)
            result = nook_ao_parse_param(scene->view->ao, "ao.filter", nook_fixture_filters[i / 3]);
        if (result == NOOK_OK)
            result = nook_edge_scene_record_all(scene, found, what);
    }
    return result;
}

nook_result nook_surface_run_sizes(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const uint32_t sizes[][2] = { { 1, 1 }, { 1, 37 }, { 37, 1 }, { 2, 2 }, { 3, 5 }, { 1, 2048 }, { 2048, 1 } };
    const size_t count = extremes->quick ? 4 : NOOK_COUNT(sizes);
    nook_result result = NOOK_OK;
    out_found->bound = 0.0;
    for (size_t i = 0; result == NOOK_OK && i < count; i++) {
        nook_edge_scene scene;
        const nook_edge_scene_desc desc = { .width = sizes[i][0], .height = sizes[i][1], .resolution = 24 };
        result = nook_edge_scene_make(extremes, &desc, &scene);
        if (result != NOOK_OK)
            break;
        result = record_size(&scene, out_found);
        scene.view->without_normals = true;
        if (result == NOOK_OK)
            result = record_size(&scene, out_found);
        nook_edge_scene_free(&scene);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    return result;
}
