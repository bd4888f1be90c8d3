/* G-buffers without normals, and those whose rows run the other way. */
#include "game/extremes/buffer_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- No normals ---- */

/* What half a step of 16 bits turns a normal by changes A by half: cost_of_normals of buffer_cases.c. */
static const double HALF_A_CODE = 0.5 * 0.5 * 4.2427 * 2.0 / 65535.0;
enum { AROUND = 3 }; /* pixels: 2 of the filter, 1 of the slope */

/** View position and normal of a pixel. @return false for background */
static bool pixel_surface(const nook_edge_scene *scene, int x, int y, double out_point[3], double out_normal[3])
{
    const nook_fixture_view *view = scene->view;
    const size_t i = (size_t)y * view->width + (size_t)x;
    const float depth = view->device_depth[i];
    if (depth == 0.0f)
        return false;
    nook_fixture_view_position(view, x, y, view->clip_from_view.m[14] / (double)depth, out_point);
    nook_fixture_decode_normal(view->normals[i], out_normal);
    nook_matrix_apply_vector(&view->view_from_world, out_normal, out_normal);
    return true;
}

/** Is all that is within AROUND pixels of one plane? */
static bool is_plain(const nook_edge_scene *scene, int x, int y)
{
    const int width = (int)scene->view->width, height = (int)scene->view->height;
    double p[3], n[3];
    if (x < AROUND || y < AROUND || x >= width - AROUND || y >= height - AROUND || !pixel_surface(scene, x, y, p, n))
        return false;
    for (int dy = -AROUND; dy <= AROUND; dy++) {
        for (int dx = -AROUND; dx <= AROUND; dx++) {
            double q[3], m[3], off = 0.0, cosine = 0.0;
            if (!pixel_surface(scene, x + dx, y + dy, q, m))
                return false;
            for (int axis = 0; axis < 3; axis++)
                off += n[axis] * (q[axis] - p[axis]), cosine += n[axis] * m[axis];
            if (fabs(off) > 1e-3 || cosine < 0.9999)
                return false;
        }
    }
    return true;
}

/** Keeps the plain pixels of a picture, in their order. @return how many */
static size_t pick_plain(const nook_edge_scene *scene, const float *picture, float *out)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->pixels; i++) {
        const int width = (int)scene->view->width;
        if (is_plain(scene, (int)i % width, (int)i / width))
            out[count++] = picture[i];
    }
    return count;
}

/** One technique with and without the host's normals. @param with, without  room for two pictures @param whole  with the edges */
static nook_result compare_plain(nook_edge_scene *scene, const char *technique, float *with, float *without,
                                 nook_extreme_found *found, double *whole)
{
    scene->view->without_normals = false;
    nook_result result = nook_edge_scene_record(scene, technique, found, "normals");
    if (result != NOOK_OK)
        return result;
    memcpy(with, scene->view->visibility, scene->pixels * sizeof *with);
    scene->view->without_normals = true;
    result = nook_edge_scene_record(scene, technique, found, "no normals");
    if (result != NOOK_OK)
        return result;
    *whole = fmax(*whole, nook_edge_rms(with, scene->view->visibility, scene->pixels));
    pick_plain(scene, with, with); /* only ever moves forward */
    const size_t count = pick_plain(scene, scene->view->visibility, without);
    nook_extreme_worst(found, count ? nook_edge_rms(with, without, count) : NAN, "%s, %zu of %zu pixels", technique,
                       count, scene->pixels);
    return NOOK_OK;
}

nook_result nook_buffer_run_no_normals(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_edge_scene scene;
    double whole = 0.0;
    out_found->bound = HALF_A_CODE;
    nook_result result = nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ 0 }, &scene);
    if (result != NOOK_OK)
        return result;
    float *pictures = malloc(2 * scene.pixels * sizeof *pictures);
    if (!pictures)
        result = nook_fail(NOOK_E_MEMORY, "extremes: no room for two pictures");
    for (size_t i = 0; result == NOOK_OK && i < count; i++)
        result = compare_plain(&scene, estimators[i].name, pictures, pictures + scene.pixels, out_found, &whole);
    free(pictures);
    nook_extreme_state(out_found, 0.04, 0.01, whole, "RMS of the worst technique, with the edges");
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- Rows from the top ---- */

static void flip_rows(float *picture, size_t side)
{
    for (size_t y = 0; y < side / 2; y++) {
        for (size_t x = 0; x < side; x++) {
            float *a = picture + y * side + x, *b = picture + (side - 1 - y) * side + x, kept = *a;
            *a = *b, *b = kept;
        }
    }
}

enum { SEEDS = 5 }; /* the first is the usual one */

static void compare_flipped(const nook_edge_pictures seeded[SEEDS], nook_edge_pictures *flipped,
                            nook_extreme_found *found)
{
    const size_t pixels = flipped->pixels, side = (size_t)sqrt((double)pixels);
    for (size_t i = 0; i < flipped->count; i++) {
        const float *usual = seeded[0].visibility + i * pixels;
        float *picture = flipped->visibility + i * pixels;
        double seeds = 0.0;
        flip_rows(picture, side);
        for (size_t k = 1; k < SEEDS; k++)
            seeds = fmax(seeds, nook_edge_rms(usual, seeded[k].visibility + i * pixels, pixels));
        const double rows = nook_edge_rms(usual, picture, pixels);
        nook_extreme_worst(found, rows / seeds, "%s: %.4f by %.4f", flipped->estimators[i].name, rows, seeds);
    }
}

nook_result nook_buffer_run_flipped(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_edge_pictures seeded[SEEDS] = { { .count = 0 } }, flipped = { .count = 0 };
    nook_result result = NOOK_OK;
    out_found->bound = 1.25;
    for (uint32_t k = 0; result == NOOK_OK && k < SEEDS; k++)
        result =
            nook_buffer_take(extremes, &(nook_edge_scene_desc){ .frame_index = k }, out_found, "a seed", &seeded[k]);
    if (result == NOOK_OK)
        result =
            nook_buffer_take(extremes, &(nook_edge_scene_desc){ .rows_down = true }, out_found, "flipped", &flipped);
    if (result == NOOK_OK)
        compare_flipped(seeded, &flipped, out_found);
    for (size_t k = 0; k < SEEDS; k++)
        nook_edge_pictures_free(&seeded[k]);
    nook_edge_pictures_free(&flipped);
    return result;
}
