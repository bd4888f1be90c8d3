#include "game/compare/second_view.h"
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/compare/run.h"
#include "game/compare/surfaces.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double turns_degrees[] = { 20.0, 10.0, 5.0 };
static const double enough_shared = 0.25; /* of the pixels with geometry */

nook_camera nook_camera_turn(const nook_camera *camera, double distance, double degrees)
{
    double half = -0.5 * degrees * NOOK_DEGREE;
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
        nook_order_floats(found, count);
        *out_distance = (double)found[count / 2];
    }
    free(found);
    return count > 0 ? NOOK_OK : nook_fail(NOOK_E_NOT_FOUND, "the camera sees nothing of the scene");
}

/* Keeps the turn with the most shared points: the match and the view of it. */
static nook_result try_turn(nook_stage *stage, const nook_surfaces *first, const nook_camera *camera, double degrees,
                            nook_second_view *best, nook_match *best_match)
{
    nook_second_view view = { .measured = true, .degrees = degrees, .distance = best->distance };
    view.camera = nook_camera_turn(camera, view.distance, degrees);
    nook_surfaces second;
    nook_match match;
    nook_result result = nook_surfaces_draw(stage, &view.camera, &second);
    if (result != NOOK_OK)
        return result;
    result = nook_match_create(&first->seen, &second.seen, &match);
    nook_surfaces_free(&second);
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

nook_result nook_second_view_choose(nook_stage *stage, const nook_camera *camera, nook_second_view *out_view,
                                    nook_match *out_match)
{
    nook_surfaces first;
    nook_second_view best = { .measured = false };
    nook_match match = { 0 };
    nook_result result = nook_surfaces_draw(stage, camera, &first);
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
    nook_surfaces_free(&first);
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
        result = nook_stage_settle(stage);
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
    nook_result result = nook_second_view_choose(stage, &camera, &view, &match);
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
