/* What ao.reuse and ao.accumulate save and what they cost while the camera moves: on the scene's cameras, standing, walking straight ahead and turning. */
#include "engine/core/angle.h"
#include "engine/core/clock.h"
#include "engine/core/order.h"
#include "engine/core/vector.h"
#include "game/commands/bench_stage.h"
#include "game/commands/benches.h"
#include "game/compare/run.h"
#include "game/measure/scene_hash.h"
#include "game/measure/truth.h"
#include "modules/measure/errors.h"
#include "modules/measure/noise.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES_MAX = 256, JUDGED = 4 /* frames at the end whose pictures are measured */, WARM = 4 };

static const double walk_speed = 1.4, turn_speed = 90.0; /* metres and degrees a second */
static const double frame_rate = 20.0;                   /* frames a second */

/** How values are taken over from frame to frame. */
typedef struct way {
    int32_t reuse, accumulate;
} way;

static const way ways[] = { { 1, 1 }, { 2, 1 }, { 3, 1 }, { 4, 1 }, { 1, 4 }, { 1, 16 }, { 4, 4 } };

typedef enum motion { MOTION_STAND, MOTION_WALK, MOTION_TURN, MOTION_COUNT } motion;

static const char *const motion_names[MOTION_COUNT] = { "stands", "walks", "turns" };

typedef struct reuse_options {
    nook_bench_stage_options stage;
    int32_t frames, rays;
} reuse_options;

/** What a path shows at its end, whatever is recorded there. */
typedef struct path_end {
    nook_surfaces surfaces[JUDGED];
    uint8_t *geometry[JUDGED];
    nook_truth truths[JUDGED];
    nook_match matches[JUDGED - 1]; /**< From each to the next. */
} path_end;

/** What a path measured. */
typedef struct path_result {
    double ms, traced, rmse, flicker;
} path_result;

static bool read_options(const nook_app *app, int argc, char **argv, reuse_options *out, int *out_exit_code)
{
    out->frames = 20;
    out->rays = 64;
    const nook_option options[] = {
        nook_option_row_int("frames", &out->frames, WARM + JUDGED, FRAMES_MAX,
                            "of each path; times are of all but four, the picture of the last four; default 20"),
        nook_option_row_reference_rays(&out->rays, 0, "per pixel; 0: no errors; default 64"),
    };
    const nook_usage usage = {
        .command = "bench reuse",
        .summary = "Measures ao.reuse and ao.accumulate on the cameras of a scene, default the demo level.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details = "The camera stands, walks ahead at 1.4 m/s, turns by 90 degrees/s, at 20 frames a second. ms:\n"
                   "of all threads together, occlusion alone, medians; traced: part of the trace's pixels; rmse:\n"
                   "of visibility; flicker: its change at the same points from a frame to the next, RMS.\n"
    };
    return nook_bench_stage_read(app, &usage, argc, argv, &out->stage, out_exit_code);
}

/* Where the camera is after some frames; it walks on its level and turns about the vertical. */
static nook_camera camera_after(const nook_camera *start, motion how, int32_t frames)
{
    nook_camera camera = *start;
    nook_matrix world_from_view;
    if (how == MOTION_STAND || !nook_matrix_inverse_affine(&start->view_from_world, &world_from_view))
        return camera;
    const double *m = world_from_view.m;
    nook_matrix move;
    if (how == MOTION_WALK) {
        double along = -walk_speed * frames / frame_rate / hypot(m[8], m[10]);
        move = nook_matrix_translation(-along * m[8], 0.0, -along * m[10]);
    } else {
        double half = 0.5 * turn_speed * NOOK_DEGREE * frames / frame_rate;
        const double none[3] = { 0, 0, 0 }, one[3] = { 1, 1, 1 }, rotation[4] = { 0, sin(half), 0, cos(half) };
        nook_matrix turn = nook_matrix_compose(none, rotation, one);
        nook_matrix there = nook_matrix_translation(m[12], m[13], m[14]);
        nook_matrix back = nook_matrix_translation(-m[12], -m[13], -m[14]);
        move = nook_matrix_multiply(&turn, &back);
        move = nook_matrix_multiply(&there, &move);
    }
    camera.view_from_world = nook_matrix_multiply(&start->view_from_world, &move);
    return camera;
}

/* ---- The truth --------------------------------------------------------------------------------------------------- */

static nook_result trace_truth(nook_stage *stage, const reuse_options *options, uint64_t scene_hash, path_end *end,
                               int32_t i)
{
    const nook_truth_desc desc = { .surfaces = &end->surfaces[i],
                                   .geometry = end->geometry[i],
                                   .scene_hash = scene_hash,
                                   .rays_max = (uint32_t)options->rays,
                                   .cache = options->stage.cache };
    nook_result result = nook_truth_open(stage, &desc, &end->truths[i]);
    return result == NOOK_OK ? nook_truth_refine(&end->truths[i], stage, 0.0) : result;
}

static nook_result draw_end(nook_stage *stage, const reuse_options *options, uint64_t scene_hash,
                            const nook_camera *start, motion how, path_end *end)
{
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < JUDGED && result == NOOK_OK; i++) {
        const nook_camera camera = camera_after(start, how, options->frames - JUDGED + i);
        result = nook_surfaces_draw(stage, &camera, &end->surfaces[i]);
        if (result == NOOK_OK)
            result = nook_geometry_read(stage, &end->geometry[i]);
        if (result == NOOK_OK && options->rays > 0)
            result = trace_truth(stage, options, scene_hash, end, i);
        if (result == NOOK_OK && i > 0)
            result = nook_match_create(&end->surfaces[i - 1].seen, &end->surfaces[i].seen, &end->matches[i - 1]);
    }
    return result;
}

static void free_end(path_end *end)
{
    for (int32_t i = 0; i < JUDGED; i++) {
        nook_surfaces_free(&end->surfaces[i]);
        free(end->geometry[i]);
        nook_truth_close(&end->truths[i]);
        if (i > 0)
            nook_match_free(&end->matches[i - 1]);
    }
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static nook_result judge(const nook_stage *stage, const path_end *end, const nook_grey pictures[JUDGED], bool traced,
                         path_result *out)
{
    const float *values[JUDGED];
    double squares = 0.0;
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < JUDGED && result == NOOK_OK; i++) {
        nook_errors errors = { .rmse = 0.0 };
        values[i] = pictures[i].values;
        if (traced)
            result = nook_errors_measure(values[i], end->truths[i].values, end->geometry[i],
                                         (size_t)stage->width * stage->height, &errors);
        squares += errors.rmse * errors.rmse;
    }
    out->rmse = sqrt(squares / JUDGED);
    out->flicker = nook_flicker_measure(end->matches, values, JUDGED).rms;
    return result;
}

static double traced_part(const nook_stage *stage)
{
    nook_ao_statistics statistics;
    double scale = 0.0;
    nook_ao_get_param(stage->ao, "ao.scale", &scale);
    nook_ao_get_statistics(stage->ao, &statistics);
    double side = exp2(scale), pixels = ceil(stage->width / side) * ceil(stage->height / side);
    return statistics.traced == UINT32_MAX ? 1.0 : statistics.traced / pixels;
}

static nook_result run_frame(nook_stage *stage, const nook_camera *camera, double *out_ms, double *out_traced)
{
    nook_result result = nook_stage_begin(stage, camera);
    if (result != NOOK_OK)
        return result;
    nook_gpu_finish(stage->gpu);
    double start = nook_clock_cpu_ms();
    result = nook_stage_occlude(stage);
    nook_gpu_finish(stage->gpu);
    *out_ms = nook_clock_cpu_ms() - start;
    *out_traced = traced_part(stage);
    return result;
}

static nook_result run_path(nook_stage *stage, const reuse_options *options, const nook_camera *start, motion how,
                            const path_end *end, path_result *out)
{
    double ms[FRAMES_MAX], traced = 0.0;
    nook_grey pictures[JUDGED] = { { 0 } };
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < options->frames && result == NOOK_OK; i++) {
        const nook_camera camera = camera_after(start, how, i);
        double part;
        result = run_frame(stage, &camera, &ms[i], &part);
        traced += i >= WARM ? part : 0.0;
        if (result == NOOK_OK && i >= options->frames - JUDGED)
            result = nook_compare_read_visibility(stage, &pictures[i - options->frames + JUDGED]);
    }
    if (result == NOOK_OK)
        result = judge(stage, end, pictures, options->rays > 0, out);
    for (int32_t i = 0; i < JUDGED; i++)
        nook_grey_free(&pictures[i]);
    out->ms = result == NOOK_OK ? nook_median(ms + WARM, (size_t)(options->frames - WARM)) : 0.0;
    out->traced = traced / (options->frames - WARM);
    return result;
}

static nook_result measure_motion(nook_stage *stage, const reuse_options *options, const nook_setting *setting,
                                  uint64_t scene_hash, const char *name, const nook_camera *start, motion how)
{
    path_end end = { .geometry = { NULL } };
    nook_result result = draw_end(stage, options, scene_hash, start, how, &end);
    if (result == NOOK_OK)
        result = nook_setting_apply(stage->ao, setting);
    for (size_t i = 0; i < NOOK_COUNT(ways) && result == NOOK_OK; i++) {
        path_result found = { .ms = 0.0 };
        result = nook_ao_set_param(stage->ao, "ao.reuse", ways[i].reuse);
        if (result == NOOK_OK)
            result = nook_ao_set_param(stage->ao, "ao.accumulate", ways[i].accumulate);
        if (result == NOOK_OK)
            result = run_path(stage, options, start, how, &end, &found);
        if (result != NOOK_OK)
            break;
        printf("  %-12s %-7s %5d %10d %8.2f %8.3f %8.4f %8.4f\n", name, motion_names[how], ways[i].reuse,
               ways[i].accumulate, found.ms, found.traced, found.rmse, found.flicker);
        fflush(stdout);
    }
    free_end(&end);
    return result;
}

static nook_result run(void *user, nook_stage *stage, const nook_settings_file *settings)
{
    const reuse_options *options = user;
    const uint64_t scene_hash = nook_scene_hash(stage->scene);
    const uint32_t count = nook_bench_stage_camera_count(stage);
    nook_result result = NOOK_OK;
    nook_bench_stage_print(&options->stage, stage, settings);
    printf("\n  %-12s %-7s %5s %10s %8s %8s %8s %8s\n", "camera", "", "reuse", "accumulate", "ms", "traced", "rmse",
           "flicker");
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++) {
        nook_camera camera;
        char name[NOOK_BENCH_CAMERA_NAME_SIZE];
        result = nook_bench_stage_camera(stage, i, &camera, name);
        for (motion how = 0; how < MOTION_COUNT && result == NOOK_OK; how++)
            result = measure_motion(stage, options, &settings->setting, scene_hash, name, &camera, how);
    }
    return result;
}

int nook_bench_run_reuse(const nook_app *app, int argc, char **argv)
{
    reuse_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    return nook_bench_stage_run(&options.stage, app->root, true, run, &options);
}
