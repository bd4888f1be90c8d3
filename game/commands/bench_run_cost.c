/* What occlusion costs by the number of pixels, by its reach and by the size of the volumes: figure 11 and section 6.4 of the volume paper,
   each of the three alone, in a scene. */
#include "engine/core/clock.h"
#include "engine/core/order.h"
#include "game/commands/bench_line.h"
#include "game/commands/bench_stage.h"
#include "game/commands/bench_ways.h"
#include "game/commands/benches.h"
#include "game/compare/camera.h"
#include <math.h>

enum { FRAMES_MAX = 1000, POINTS_MAX = 8 };

typedef struct cost_options {
    nook_bench_stage_options stage;
    int32_t frames;
    bool cpu;
} cost_options;

/* What was measured at some points of one quantity. */
typedef struct cost_series {
    double x[POINTS_MAX];
    double ms[NOOK_BENCH_WAYS_MAX][POINTS_MAX];
    size_t count;
} cost_series;

typedef struct cost_bench {
    const cost_options *options;
    nook_stage *stage;
    const nook_ao_technique *technique;
    const nook_bench_way *ways;
    size_t way_count;
    nook_camera camera;
    double r_max; /**< Metres, as set. */
    double ms[FRAMES_MAX];
} cost_bench;

/* ---- one point --------------------------------------------------------------------------------------------------- */

/* Of all that a record reads, per pixel with geometry. */
static nook_result count_fetches(cost_bench *b, double *out_fetches)
{
    nook_ao_statistics statistics;
    nook_result result = nook_ao_set_param(b->stage->ao, "ao.count", 1);
    if (result == NOOK_OK)
        result = nook_stage_occlude(b->stage);
    nook_ao_get_statistics(b->stage->ao, &statistics);
    *out_fetches = statistics.fetches_per_pixel;
    return result == NOOK_OK ? nook_ao_set_param(b->stage->ao, "ao.count", 0) : result;
}

static nook_result time_way(cost_bench *b, const nook_bench_way *way, double *out_ms)
{
    double (*clock)(void) = b->options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    nook_result result = nook_bench_way_apply(b->stage->ao, b->technique, way);
    for (int32_t i = -1; i < b->options->frames && result == NOOK_OK; i++) {
        nook_gpu_finish(b->stage->gpu);
        double start = clock();
        result = nook_stage_occlude(b->stage);
        nook_gpu_finish(b->stage->gpu);
        if (i >= 0)
            b->ms[i] = clock() - start;
    }
    *out_ms = nook_median(b->ms, (size_t)b->options->frames);
    return result;
}

/* Draws the G-buffer, times each way and prints a row. */
static nook_result measure(cost_bench *b, const char *label, double x, cost_series *series)
{
    double fetches[NOOK_BENCH_WAYS_MAX];
    nook_result result = nook_stage_begin(b->stage, &b->camera);
    series->x[series->count] = x;
    for (size_t way = 0; way < b->way_count && result == NOOK_OK; way++) {
        result = time_way(b, &b->ways[way], &series->ms[way][series->count]);
        if (result == NOOK_OK)
            result = count_fetches(b, &fetches[way]);
    }
    if (result != NOOK_OK)
        return result;
    printf("  %12s", label);
    for (size_t way = 0; way < b->way_count; way++)
        printf(" %10.2f %10.1f", series->ms[way][series->count], fetches[way]);
    printf("\n");
    fflush(stdout);
    series->count++;
    return NOOK_OK;
}

static void print_head(const cost_bench *b, const char *title, const char *quantity)
{
    printf("\n%s\n  %12s", title, quantity);
    for (size_t way = 0; way < b->way_count; way++)
        printf(" %10s %10s", b->ways[way].name, "fetches");
    printf("\n");
}

/* @param unit, unit_name  of the slope: milliseconds for so much of the quantity */
static void print_lines(const cost_bench *b, const cost_series *series, double unit, const char *unit_name)
{
    for (size_t way = 0; way < b->way_count && series->count > 1; way++) {
        const nook_bench_line line = nook_bench_line_fit(series->x, series->ms[way], series->count);
        printf("  %s: %.2f ms + %.3f ms %s; off by %.1f %% (RMS), R2 %.4f\n", b->ways[way].name, line.start,
               line.slope * unit, unit_name, 100.0 * line.residual, line.determination);
    }
}

/* ---- the series -------------------------------------------------------------------------------------------------- */

/* Areas in equal steps. */
static nook_result cost_by_pixels(cost_bench *b)
{
    enum { STEPS = 6 };
    const nook_option_size whole = b->options->stage.size;
    cost_series series = { .count = 0 };
    nook_result result = NOOK_OK;
    print_head(b, "By the number of pixels", "size");
    for (int i = 1; i <= STEPS && result == NOOK_OK; i++) {
        const double side = sqrt((double)i / STEPS);
        const uint32_t width = (uint32_t)fmax(round(whole.width * side), 1.0);
        const uint32_t height = (uint32_t)fmax(round(whole.height * side), 1.0);
        char label[32];
        snprintf(label, sizeof label, "%ux%u", width, height);
        result = nook_stage_set_size(b->stage, width, height);
        if (result == NOOK_OK)
            result = measure(b, label, (double)width * height, &series);
    }
    print_lines(b, &series, 1e4, "per 10,000 pixels");
    return result;
}

/* In parts of the scene's diagonal; the volumes stay as they are. */
static nook_result cost_by_reach(cost_bench *b)
{
    static const double parts[] = { 0.0125, 0.025, 0.05, 0.1, 0.2, 0.4 };
    const double diagonal = nook_scene_diagonal(b->stage->scene);
    cost_series series = { .count = 0 };
    nook_result result = NOOK_OK;
    print_head(b, "By the reach, in parts of the scene's diagonal", "r_max");
    for (size_t i = 0; i < NOOK_COUNT(parts) && result == NOOK_OK; i++) {
        char label[32];
        snprintf(label, sizeof label, "%g", parts[i]);
        result = nook_ao_set_param(b->stage->ao, "ao.r_max", parts[i] * diagonal);
        if (result == NOOK_OK)
            result = measure(b, label, parts[i], &series);
    }
    print_lines(b, &series, 0.1, "per tenth of the diagonal");
    return result == NOOK_OK ? nook_ao_set_param(b->stage->ao, "ao.r_max", b->r_max) : result;
}

static nook_result cost_by_volume_size(cost_bench *b)
{
    static const uint32_t sides[] = { 64, 128, 256, 512 };
    cost_series series = { .count = 0 };
    nook_result result = NOOK_OK;
    print_head(b, "By the size of the volumes", "voxels, MB");
    for (size_t i = 0; i < NOOK_COUNT(sides) && result == NOOK_OK; i++) {
        nook_game_world_desc desc = b->stage->volumes;
        nook_ao_statistics statistics;
        char label[32];
        desc.resolution = sides[i];
        result = nook_stage_fill(b->stage, &desc);
        if (result == NOOK_OK)
            result = nook_stage_begin(b->stage, &b->camera);
        if (result == NOOK_OK)
            result = nook_stage_occlude(b->stage);
        if (result != NOOK_OK)
            break;
        nook_ao_get_statistics(b->stage->ao, &statistics);
        snprintf(label, sizeof label, "%u, %.1f", sides[i], (double)statistics.volume_bytes / 1e6);
        result = measure(b, label, sides[i], &series);
    }
    return result;
}

/* ---- the command ------------------------------------------------------------------------------------------------- */

static nook_result run(void *user, nook_stage *stage, const nook_settings_file *settings)
{
    const cost_options *options = user;
    char camera[NOOK_BENCH_CAMERA_NAME_SIZE];
    cost_bench bench = { .options = options, .stage = stage, .technique = settings->setting.technique }, *b = &bench;
    b->way_count = nook_bench_ways(b->technique, &b->ways);
    nook_result result = nook_bench_stage_camera(stage, 0, &b->camera, camera);
    if (result == NOOK_OK)
        result = nook_ao_get_param(stage->ao, "ao.r_max", &b->r_max);
    if (result != NOOK_OK)
        return result;
    nook_bench_stage_print(&options->stage, stage, settings);
    printf("camera %s; milliseconds of %s, and texture fetches of a pixel\n", camera,
           options->cpu ? "all threads together" : "wall time");
    result = cost_by_pixels(b);
    if (result == NOOK_OK)
        result = cost_by_reach(b);
    if (result == NOOK_OK && b->technique->inputs & NOOK_AO_IN_VOLUMES)
        result = cost_by_volume_size(b);
    return result;
}

static bool read_options(const nook_app *app, int argc, char **argv, cost_options *out, int *out_exit_code)
{
    out->frames = 5;
    out->cpu = false;
    const nook_option options[] = {
        nook_option_row_int("frames", &out->frames, 1, FRAMES_MAX,
                            "timed of each row, after one to warm up; default 5"),
        nook_option_row_cpu(&out->cpu),
    };
    const nook_usage usage = {
        .command = "bench cost",
        .summary = "Times occlusion by pixels, reach and size of volumes in a scene, default the demo level.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details = "Six sizes up to --size, six reaches, volumes of 64 to 512 voxels; of the first two the straight "
                   "line that\n"
                   "is nearest, and how far the points are off it. Of \"volume\": union, product, and raster\n"
                   "(volume.combine, volume.path). A record: all of it, filter and upscaling too.\n"
    };
    return nook_bench_stage_read(app, &usage, argc, argv, &out->stage, out_exit_code);
}

int nook_bench_run_cost(const nook_app *app, int argc, char **argv)
{
    cost_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    return nook_bench_stage_run(&options.stage, app->root, false, run, &options);
}
