/* The usual scene drawn by the engine's renderer, far away: by its nodes' matrices, and by its vertices. */
#include "engine/core/order.h"
#include "game/extremes/edge_pictures.h"
#include "game/extremes/edge_render.h"
#include "game/extremes/space_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RAYS = 16, SIDE = 48 }; /* of edge_scene.h, as usual */

static void offset_of(double distance, double out[3])
{
    const double length = distance + 0.123; /* which no float holds */
    out[0] = length, out[1] = -0.7 * length, out[2] = 0.3 * length;
}

/* ---- What was drawn ---- */

/** A G-buffer as the renderer left it, and what every technique makes of it. */
typedef struct drawn {
    float *distance; /* along -Z; 0: background */
    float (*normals)[2];
    nook_edge_pictures pictures;
} drawn;

static void drawn_free(drawn *d)
{
    free(d->distance);
    free(d->normals);
    nook_edge_pictures_free(&d->pictures);
    *d = (drawn){ 0 };
}

static nook_result keep(nook_edge_scene *scene, drawn *out)
{
    const double z_near = scene->view->clip_from_view.m[14];
    out->distance = malloc(scene->pixels * sizeof *out->distance);
    out->normals = malloc(scene->pixels * sizeof *out->normals);
    if (!out->distance || !out->normals)
        return nook_fail(NOOK_E_MEMORY, "extremes: no room for a G-buffer");
    for (size_t i = 0; i < scene->pixels; i++) {
        const float depth = scene->view->device_depth[i];
        out->distance[i] = depth > 0.0f ? (float)(z_near / depth) : 0.0f;
    }
    memcpy(out->normals, scene->view->normals, scene->pixels * sizeof *out->normals);
    return NOOK_OK;
}

/** @param with_pictures  also what the techniques make of it */
static nook_result draw(const nook_extremes *extremes, nook_edge_scene *scene, bool with_pictures,
                        nook_extreme_found *found, const char *where, drawn *out)
{
    nook_edge_render render;
    nook_result result = nook_edge_render_make(extremes, scene, &render);
    if (result != NOOK_OK)
        return result;
    result = nook_edge_render_draw(&render, scene);
    nook_edge_render_free(&render);
    if (result == NOOK_OK)
        result = keep(scene, out);
    if (result == NOOK_OK && with_pictures)
        result = nook_edge_pictures_take(scene, found, where, &out->pictures);
    if (result != NOOK_OK)
        drawn_free(out);
    return result;
}

/** Draws the usual scene `distance` units off, its camera with it, by nodes or by vertices. *out is zero on failure. */
static nook_result draw_off(const nook_extremes *extremes, double distance, bool by_vertices, bool with_pictures,
                            nook_extreme_found *found, drawn *out)
{
    nook_edge_scene scene;
    nook_edge_scene_desc desc = { 0 };
    double offset[3];
    char where[64];
    *out = (drawn){ 0 };
    offset_of(distance, offset);
    if (distance > 0.0 && by_vertices)
        memcpy(desc.vertex_offset, offset, sizeof offset);
    nook_result result = nook_edge_scene_make(extremes, &desc, &scene);
    if (result != NOOK_OK)
        return result;
    const nook_matrix move = nook_matrix_translation(offset[0], offset[1], offset[2]);
    if (distance > 0.0)
        nook_edge_scene_move(&scene, &move);
    snprintf(where, sizeof where, "%g units off", distance);
    result = draw(extremes, &scene, with_pictures, found, where, out);
    nook_edge_scene_free(&scene);
    return result;
}

/* ---- Nodes far away ---- */

static const double node_offsets[] = { 1e7, 1e3, 1e4, 1e5, 1e6 };

/** Steps of a float relative to the distance, and of a normal's code of 16 bits, by which two G-buffers are apart. */
static void compare_buffers(const drawn *a, const drawn *b, double offset, nook_extreme_found *found)
{
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const double from = a->distance[i], to = b->distance[i];
        if ((from > 0.0) != (to > 0.0))
            nook_extreme_worst(found, INFINITY, "%g units off: pixel %zu is seen or not", offset, i);
        if (!(from > 0.0 && to > 0.0))
            continue;
        nook_extreme_worst(found, fabs(to - from) / from * 0x1p23, "%g units off: depth of pixel %zu", offset, i);
        for (int k = 0; k < 2; k++)
            nook_extreme_worst(found, fabs((double)b->normals[i][k] - a->normals[i][k]) * 65535.0,
                               "%g units off: normal of pixel %zu", offset, i);
    }
}

static nook_result compare_nodes(const nook_extremes *extremes, bool pictures, nook_extreme_found *found)
{
    const size_t count = extremes->quick ? 2 : NOOK_COUNT(node_offsets);
    drawn usual, far;
    nook_result result = draw_off(extremes, 0.0, false, pictures, found, &usual);
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        char where[64];
        snprintf(where, sizeof where, "%g units off", node_offsets[i]);
        result = draw_off(extremes, node_offsets[i], false, pictures, found, &far);
        if (result != NOOK_OK)
            break;
        if (pictures)
            nook_edge_pictures_compare_elsewhere(&usual.pictures, &far.pictures, nook_edge_rms, found, where);
        else
            compare_buffers(&usual, &far, node_offsets[i], found);
        drawn_free(&far);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    drawn_free(&usual);
    return result;
}

nook_result nook_space_run_drawn(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = 1.0;
    return compare_nodes(extremes, false, out_found);
}

nook_result nook_space_run_drawn_pictures(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = 3.0 * 2e-6;
    return compare_nodes(extremes, true, out_found);
}

/* ---- Vertices far away ---- */

/** How far what is drawn is from where it should be, the median pixel; NAN when nothing is seen. */
static nook_result median_error(const drawn *usual, const drawn *far, double *out_error)
{
    double *errors = malloc(SIDE * SIDE * sizeof *errors);
    size_t count = 0;
    if (!errors)
        return nook_fail(NOOK_E_MEMORY, "extremes: no room for %d numbers", SIDE * SIDE);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        if (usual->distance[i] > 0.0f && far->distance[i] > 0.0f)
            errors[count++] = fabs((double)far->distance[i] - usual->distance[i]);
    }
    nook_order_numbers(errors, count);
    *out_error = count ? errors[count / 2] : NAN;
    free(errors);
    return NOOK_OK;
}

nook_result nook_space_run_far_vertices(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    drawn usual, far;
    out_found->bound = 3.0;
    nook_result result = draw_off(extremes, 0.0, true, false, out_found, &usual);
    for (double offset = 1.0; offset <= 1.1e6 && result == NOOK_OK; offset *= extremes->quick ? 1e3 : 10.0) {
        double error = NAN, step = ldexp(1.0, ilogb(offset + 2.5) - 23); /* of a float at the farthest vertex */
        result = draw_off(extremes, offset, true, false, out_found, &far);
        if (result != NOOK_OK)
            break;
        result = median_error(&usual, &far, &error);
        drawn_free(&far);
        nook_extreme_worst(out_found, error / step, "vertices %g units off: drawn %.2g off, a float's step is %.2g",
                           offset, error, step);
    }
    drawn_free(&usual);
    return result;
}

/** The largest RMS of the reference, or of the techniques that are not exact and do not hang in the world. */
static double worst_picture(const drawn *a, const drawn *b, bool exact)
{
    const size_t pixels = a->pictures.pixels;
    double worst = 0.0;
    for (size_t i = 0; i < a->pictures.count; i++) {
        if (a->pictures.estimators[i].technique->exact == exact && !a->pictures.estimators[i].hangs)
            worst = fmax(
                worst, nook_edge_rms(a->pictures.visibility + i * pixels, b->pictures.visibility + i * pixels, pixels));
    }
    return worst;
}

nook_result nook_space_run_far_vertices_pictures(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double held = 100.0, beyond[] = { 1e3, 1e4 };
    drawn usual, far = { 0 };
    out_found->bound = 1.0 / (RAYS * SIDE);
    nook_result result = draw_off(extremes, 0.0, true, true, out_found, &usual);
    for (double offset = 1.0; offset <= held && result == NOOK_OK; offset *= 10.0) {
        result = draw_off(extremes, offset, true, true, out_found, &far);
        if (result == NOOK_OK)
            nook_edge_pictures_compare_elsewhere(&usual.pictures, &far.pictures, nook_edge_rms, out_found,
                                                 "100 units off at most");
        drawn_free(&far);
    }
    for (size_t i = 0; i < NOOK_COUNT(beyond) && result == NOOK_OK; i++) {
        result = draw_off(extremes, beyond[i], true, true, out_found, &far);
        if (result != NOOK_OK)
            break;
        nook_extreme_state(out_found, i ? 0.6 : 0.4, 0.05, worst_picture(&usual, &far, true),
                           "reference, vertices %g units off: RMS", beyond[i]);
        nook_extreme_state(out_found, i ? 0.01 : 0.001, i ? 0.005 : 0.001, worst_picture(&usual, &far, false),
                           "the worst of the others, vertices %g units off: RMS", beyond[i]);
        drawn_free(&far);
    }
    drawn_free(&usual);
    nook_extreme_state(out_found, 1.0, 0.0, (double)nextafterf(1e7f, INFINITY) - 1e7, "a float's step 1e7 units off");
    return result;
}
