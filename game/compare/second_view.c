#include "game/compare/second_view.h"
#include "engine/core/log.h"
#include "game/compare/run.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double turns_degrees[] = { 20.0, 10.0, 5.0 };
static const double enough_shared = 0.25; /* of the pixels with geometry */
static const double radians_per_degree = 3.14159265358979323846 / 180.0;

nook_camera nook_camera_turn(const nook_camera *camera, double distance, double degrees)
{
    double half = -0.5 * degrees * radians_per_degree;
    const double rotation[4] = { 0.0, sin(half), 0.0, cos(half) };
    const double none[3] = { 0.0, 0.0, 0.0 }, one[3] = { 1.0, 1.0, 1.0 };
    nook_matrix turn = nook_matrix_compose(none, rotation, one);
    nook_matrix to_pivot = nook_matrix_translation(0.0, 0.0, distance);
    nook_matrix back = nook_matrix_translation(0.0, 0.0, -distance);
    nook_matrix turned = nook_matrix_multiply(&turn, &to_pivot);
    turned = nook_matrix_multiply(&back, &turned);
    nook_camera second = *camera;
    second.view_from_world = nook_matrix_multiply(&turned, &camera->view_from_world);
    return second;
}

static int compare_floats(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Copies the distances of a part of the picture that shows something. */
static size_t gather(const float *distances, uint32_t width, const uint32_t from[2], const uint32_t to[2], float *out)
{
    size_t count = 0;
    for (uint32_t y = from[1]; y < to[1]; y++) {
        for (uint32_t x = from[0]; x < to[0]; x++) {
            float distance = distances[(size_t)y * width + x];
            if (distance > 0.0f)
                out[count++] = distance;
        }
    }
    return count;
}

nook_result nook_middle_distance(const float *distances, uint32_t width, uint32_t height, double *out_distance)
{
    const uint32_t start[2] = { 0, 0 }, end[2] = { width, height };
    const uint32_t from[2] = { width / 3, height / 3 }, to[2] = { width - width / 3, height - height / 3 };
    float *found = malloc((size_t)width * height * sizeof *found);
    if (!found)
        return nook_fail(NOOK_E_MEMORY, "no memory for the distances of %u x %u pixels", width, height);
    size_t count = gather(distances, width, from, to, found);
    if (count == 0)
        count = gather(distances, width, start, end, found);
    if (count > 0) {
        qsort(found, count, sizeof *found, compare_floats);
        *out_distance = (double)found[count / 2];
    }
    free(found);
    return count > 0 ? NOOK_OK : nook_fail(NOOK_E_NOT_FOUND, "the camera sees nothing of the scene");
}

/* What a camera sees, with the arrays that a nook_seen borrows. */
typedef struct geometry {
    float *distances, *normals;
    nook_seen seen;
} geometry;

static void geometry_free(geometry *g)
{
    free(g->distances);
    free(g->normals);
    *g = (geometry){ 0 };
}

/* As shaders/nook/octahedral.glsl reads it. */
static void decode_normal(const uint16_t stored[2], float out[3])
{
    double x = (stored[0] - 32768.0) / 32767.0, y = (stored[1] - 32768.0) / 32767.0;
    double z = 1.0 - fabs(x) - fabs(y);
    if (z < 0.0) {
        double kept = x;
        x = copysign(1.0 - fabs(y), x);
        y = copysign(1.0 - fabs(kept), y);
    }
    double length = sqrt(x * x + y * y + z * z);
    out[0] = (float)(x / length);
    out[1] = (float)(y / length);
    out[2] = (float)(z / length);
}

static nook_result read_normals(nook_stage *stage, float *out)
{
    size_t pixels = (size_t)stage->width * stage->height;
    uint16_t *stored = malloc(pixels * 2 * sizeof *stored);
    if (!stored)
        return nook_fail(NOOK_E_MEMORY, "no memory to read back %zu normals", pixels);
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).geometric_normal, GL_RG, GL_UNSIGNED_SHORT,
                      stored, pixels * 2 * sizeof *stored);
    for (size_t i = 0; i < pixels; i++)
        decode_normal(&stored[2 * i], &out[3 * i]);
    free(stored);
    return NOOK_OK;
}

/* Draws the G-buffer of a camera and reads it back. */
static nook_result look(nook_stage *stage, const nook_camera *camera, geometry *out)
{
    nook_result result = nook_stage_begin(stage, camera);
    if (result != NOOK_OK)
        return result;
    size_t pixels = (size_t)stage->width * stage->height;
    geometry g = { malloc(pixels * sizeof(float)), malloc(pixels * 3 * sizeof(float)), { .width = 0 } };
    result = g.distances && g.normals ? read_normals(stage, g.normals)
                                      : nook_fail(NOOK_E_MEMORY, "no memory to read back %zu pixels", pixels);
    if (result != NOOK_OK) {
        geometry_free(&g);
        return result;
    }
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT,
                      g.distances, pixels * sizeof(float));
    for (size_t i = 0; i < pixels; i++) /* stored: z_near / distance, 0 where nothing is */
        g.distances[i] = g.distances[i] > 0.0f ? (float)(camera->z_near / (double)g.distances[i]) : 0.0f;
    g.seen = (nook_seen){ .view_from_world = camera->view_from_world,
                          .fov_y_radians = camera->fov_y_radians,
                          .width = stage->width,
                          .height = stage->height,
                          .distances = g.distances,
                          .normals = g.normals };
    *out = g;
    return NOOK_OK;
}

/* Keeps the turn with the most shared points: the match and the view of it. */
static nook_result try_turn(nook_stage *stage, const geometry *first, const nook_camera *camera, double degrees,
                            nook_second_view *best, nook_match *best_match)
{
    nook_second_view view = { .measured = true, .degrees = degrees, .distance = best->distance };
    view.camera = nook_camera_turn(camera, view.distance, degrees);
    geometry second;
    nook_match match;
    nook_result result = look(stage, &view.camera, &second);
    if (result != NOOK_OK)
        return result;
    result = nook_match_create(&first->seen, &second.seen, &match);
    geometry_free(&second);
    if (result != NOOK_OK)
        return result;
    view.shared = match.shared;
    if (!best->measured || view.shared > best->shared) {
        nook_match_free(best_match);
        *best = view;
        *best_match = match;
    } else {
        nook_match_free(&match);
    }
    return NOOK_OK;
}

static nook_result choose_view(nook_stage *stage, const nook_camera *camera, nook_second_view *out_view,
                               nook_match *out_match)
{
    geometry first;
    nook_second_view best = { .measured = false };
    nook_match match = { 0 };
    nook_result result = look(stage, camera, &first);
    if (result != NOOK_OK)
        return result;
    result = nook_middle_distance(first.distances, stage->width, stage->height, &best.distance);
    for (size_t i = 0; i < NOOK_COUNT(turns_degrees) && result == NOOK_OK; i++) {
        if (match.shared > 0 && (double)match.shared >= enough_shared * (double)match.geometry)
            break;
        result = try_turn(stage, &first, camera, turns_degrees[i], &best, &match);
        if (result == NOOK_OK)
            result = try_turn(stage, &first, camera, -turns_degrees[i], &best, &match);
    }
    geometry_free(&first);
    if (result != NOOK_OK) {
        nook_match_free(&match);
        return result;
    }
    *out_view = best;
    *out_match = match;
    return NOOK_OK;
}

static nook_result measure_row(nook_stage *stage, const nook_match *match, nook_compare_row *row)
{
    char what[64];
    nook_grey second;
    snprintf(what, sizeof what, "steadiness of the %s", row->technique->name);
    nook_progress progress = nook_progress_begin(what);
    stage->progress = &progress;
    nook_result result = nook_ao_set_technique(stage->ao, row->technique->name);
    if (result == NOOK_OK)
        result = nook_stage_occlude(stage);
    if (result == NOOK_OK)
        result = nook_compare_read_visibility(stage, &second);
    stage->progress = NULL;
    nook_progress_end(&progress);
    if (result != NOOK_OK)
        return result;
    row->instability = nook_instability_measure(match, row->visibility.values, second.values);
    nook_grey_free(&second);
    return NOOK_OK;
}

nook_result nook_compare_steadiness(nook_stage *stage, nook_comparison *comparison)
{
    nook_camera camera = stage->frame.camera;
    nook_second_view view;
    nook_match match;
    nook_result result = choose_view(stage, &camera, &view, &match);
    if (result != NOOK_OK)
        return result;
    result = nook_stage_begin(stage, &view.camera);
    for (uint32_t i = 0; i < comparison->row_count && result == NOOK_OK; i++)
        result = measure_row(stage, &match, &comparison->rows[i]);
    nook_match_free(&match);
    if (result == NOOK_OK)
        result = nook_stage_begin(stage, &camera);
    if (result == NOOK_OK)
        comparison->second = view;
    return result;
}
