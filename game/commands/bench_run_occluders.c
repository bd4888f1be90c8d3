/* What occlusion costs by the number of occluders: boxes over a floor, apart from each other or all in one place, as volumes of their own
   or as one that holds them all; joined by union, by the product, and by the product of boxes that are drawn. Everything scales with the
   boxes, so that every row has as many voxels along a ray. */
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/commands/bench_ways.h"
#include "game/commands/benches.h"
#include "game/commands/findings.h"
#include "game/option_rows.h"
#include "game/settings/setting.h"
#include "game/techniques.h"
#include "modules/bake/voxelize.h"
#include "modules/fixture/draw.h"
#include <math.h>
#include <stdio.h>

enum { FRAMES_MAX = 1000, COUNT_MAX = 4096, VOXELS = 16 };
/* In widths of a box's cell on the floor. */
static const double half_side = 0.2, bottom = 0.05, top = 0.45, reach = 0.3;
static const double fov_y = 0.8; /* radians: the camera looks straight down on all of the floor */

typedef struct occluders_options {
    const char *setting;
    nook_option_size size;
    nook_backend backend;
    int32_t frames, most, pile;
    bool cpu;
} occluders_options;

typedef struct occluders_bench {
    const occluders_options *options;
    nook_setting setting;
    const nook_bench_way *ways;
    size_t way_count;
    nook_fixture_view *view;
    double ms[FRAMES_MAX];
} occluders_bench;

/* ---- the scene: `side` by `side` cells around the origin, one wide each, on the floor z = 0 ---------------------- */

static void add_box(nook_fixture_mesh *mesh, double x, double y)
{
    nook_fixture_add_box(mesh, (double[]){ x - half_side, y - half_side, bottom },
                         (double[]){ x + half_side, y + half_side, top }, 63);
}

static double cell_centre(double cell, uint32_t side)
{
    return cell + 0.5 - 0.5 * side;
}

/* Nearest of the floor and the boxes: a ray leans so little that it meets only those around where it meets the floor. */
static nook_fixture_hit cast(uint32_t side, const nook_fixture_mesh *box, double height, const double ray[3])
{
    nook_fixture_hit hit = { .distance = height, .normal = { 0, 0, 1 } }; /* ray[2] is -1 */
    for (int i = 0; i < 9; i++) {
        const double column = floor(ray[0] * height + 0.5 * side) + i % 3 - 1;
        const double row = floor(ray[1] * height + 0.5 * side) + i / 3 - 1;
        if (column < 0 || row < 0 || column >= side || row >= side)
            continue;
        const double eye[3] = { -cell_centre(column, side), -cell_centre(row, side), height };
        nook_fixture_cast(box, eye, ray, &hit);
    }
    return hit;
}

/* The floor of `side` cells, seen from above. */
static void draw(nook_fixture_view *view, uint32_t side, const nook_fixture_mesh *box)
{
    const double height = 0.5 * side / tan(0.5 * fov_y) + top;
    const nook_fixture_projection projection = { .fov_y_radians = fov_y,
                                                 .aspect = (double)view->width / view->height,
                                                 .z_near = 0.1 };
    view->view_from_world =
        nook_matrix_look_at((double[]){ 0, 0, height }, (double[]){ 0, 0, 0 }, (double[]){ 0, 1, 0 });
    view->clip_from_view = nook_fixture_projection_matrix(&projection);
    nook_fixture_view_clear(view);
    for (uint32_t y = 0; y < view->height; y++) {
        for (uint32_t x = 0; x < view->width; x++) {
            double ray[3];
            nook_fixture_view_position(view, x, y, 1.0,
                                       ray); /* in the world's directions: the camera looks down its z */
            nook_fixture_hit hit = cast(side, box, height, ray);
            nook_fixture_view_set_pixel(view, x, y, hit.distance, hit.normal);
        }
    }
}

/* A volume for each of side * side boxes; `pile`: that many in the only cell instead. */
static nook_result add_each(nook_fixture_view *view, uint32_t side, uint32_t pile, const nook_fixture_mesh *box)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < (pile ? pile : side * side) && result == NOOK_OK; i++) {
        const double still[4] = { 0, 0, 0, 1 }, size[3] = { 1, 1, 1 };
        const double at[3] = { pile ? 0.0 : cell_centre(i % side, side), pile ? 0.0 : cell_centre(i / side, side), 0 };
        const nook_matrix place = nook_matrix_compose(at, still, size);
        result = i == 0 ? nook_fixture_view_add(view, box, VOXELS, &place, NULL)
                        : nook_fixture_view_add_instance(view, 0, &place);
    }
    return result;
}

/* One volume of all, its voxels as small as far as 512 go. */
static nook_result add_as_one(nook_fixture_view *view, uint32_t side)
{
    nook_fixture_mesh all = { 0 };
    for (uint32_t i = 0; i < side * side; i++)
        add_box(&all, cell_centre(i % side, side), cell_centre(i / side, side));
    double wanted = VOXELS * (side - 1 + 2 * half_side) / (2 * half_side);
    nook_result result =
        nook_fixture_view_add(view, &all, (uint32_t)fmin(wanted, NOOK_VOXELIZE_RESOLUTION_MAX), NULL, NULL);
    nook_fixture_mesh_free(&all);
    return result;
}

/* ---- timing ------------------------------------------------------------------------------------------------------ */

/* Median milliseconds of a record, of each way. */
typedef struct way_times {
    double ms[NOOK_BENCH_WAYS_MAX];
} way_times;

static nook_result time_way(occluders_bench *b, const nook_bench_way *way, double *out_ms)
{
    double (*clock)(void) = b->options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    nook_fixture_view *view = b->view;
    const nook_ao_frame frame = nook_fixture_view_frame(view);
    nook_result result = nook_bench_way_apply(view->ao, b->setting.technique, way);
    for (int32_t i = -1; i < b->options->frames && result == NOOK_OK; i++) {
        nook_gpu_finish(view->gpu);
        double start = clock();
        result = nook_ao_submit_occluders(view->ao, view->occluders, view->occluder_count);
        if (result == NOOK_OK)
            result = nook_ao_record(view->ao, &frame);
        nook_gpu_finish(view->gpu);
        if (i >= 0)
            b->ms[i] = clock() - start;
    }
    *out_ms = nook_median(b->ms, (size_t)b->options->frames);
    return result;
}

/* The first record writes what the others read. */
static nook_result time_records(occluders_bench *b, way_times *out)
{
    nook_result result = nook_fixture_view_record(b->view, b->setting.technique->name);
    for (size_t way = 0; way < b->way_count && result == NOOK_OK; way++)
        result = time_way(b, &b->ways[way], &out->ms[way]);
    nook_fixture_view_drop_occluders(b->view);
    return result;
}

/* ---- the tables -------------------------------------------------------------------------------------------------- */

static void print_names(const occluders_bench *b, const char *before)
{
    char name[64];
    for (size_t way = 0; way < b->way_count; way++) {
        snprintf(name, sizeof name, "%s%s", before, b->ways[way].name);
        printf(" %12s", name);
    }
}

static void print_times(const occluders_bench *b, const way_times *times)
{
    for (size_t way = 0; way < b->way_count; way++)
        printf(" %12.2f", times->ms[way]);
}

static void print_ratios(const occluders_bench *b, const way_times *times, const way_times *first)
{
    for (size_t way = 0; way < b->way_count; way++)
        printf(" %12.2f", times->ms[way] / first->ms[way]);
}

static nook_result time_apart(occluders_bench *b, const nook_fixture_mesh *box)
{
    way_times first = { { 0 } };
    nook_result result = NOOK_OK;
    printf("apart: milliseconds, times those of one, and of one volume that holds all\n  %9s", "occluders");
    print_names(b, "");
    print_names(b, "x ");
    print_names(b, "one: ");
    printf("\n");
    for (uint32_t side = 1; side * side <= (uint32_t)b->options->most && result == NOOK_OK; side *= 2) {
        way_times each = { { 0 } }, one = { { 0 } };
        draw(b->view, side, box);
        result = add_each(b->view, side, 0, box);
        if (result == NOOK_OK)
            result = time_records(b, &each);
        if (result == NOOK_OK)
            result = add_as_one(b->view, side);
        if (result == NOOK_OK)
            result = time_records(b, &one);
        first = side == 1 ? each : first;
        if (result != NOOK_OK)
            break;
        printf("  %9u", side * side);
        print_times(b, &each);
        print_ratios(b, &each, &first);
        print_times(b, &one);
        printf("\n");
        fflush(stdout);
    }
    return result;
}

static nook_result time_piled(occluders_bench *b, const nook_fixture_mesh *box)
{
    way_times first = { { 0 } };
    nook_result result = NOOK_OK;
    draw(b->view, 1, box);
    printf("piled up in one place\n  %9s", "occluders");
    print_names(b, "");
    print_names(b, "x ");
    printf("\n");
    for (uint32_t count = 1; count <= (uint32_t)b->options->pile && result == NOOK_OK; count *= 2) {
        way_times times = { { 0 } };
        result = add_each(b->view, 1, count, box);
        if (result == NOOK_OK)
            result = time_records(b, &times);
        first = count == 1 ? times : first;
        if (result != NOOK_OK)
            break;
        printf("  %9u", count);
        print_times(b, &times);
        print_ratios(b, &times, &first);
        printf("\n");
        fflush(stdout);
    }
    return result;
}

static nook_result open_view(occluders_bench *b, nook_gpu *gpu)
{
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    const nook_fixture_view_desc desc = { .gpu = gpu,
                                          .width = (uint32_t)b->options->size.width,
                                          .height = (uint32_t)b->options->size.height,
                                          .techniques = techniques,
                                          .technique_count = count,
                                          .max_occluders = COUNT_MAX };
    nook_result result = nook_fixture_view_create(&desc, &b->view);
    if (result == NOOK_OK)
        result = nook_setting_apply(b->view->ao, &b->setting);
    return result == NOOK_OK ? nook_ao_set_param(b->view->ao, "ao.r_max", reach) : result;
}

static nook_result run(void *user, nook_gpu *gpu, bool *out_hold)
{
    occluders_bench *b = user;
    nook_fixture_mesh box = { 0 };
    char setting[NOOK_SETTING_TEXT_MAX];
    nook_result result = open_view(b, gpu);
    add_box(&box, 0.0, 0.0);
    printf("%d x %d, %s, %s, boxes of %d voxels, r_max %.3g of the gap between them\nmilliseconds of %s\n\n",
           b->options->size.width, b->options->size.height, gpu->renderer, nook_setting_print(&b->setting, setting),
           VOXELS, reach / (1.0 - 2.0 * half_side), b->options->cpu ? "all threads together" : "wall time");
    if (result == NOOK_OK)
        result = time_apart(b, &box);
    if (result == NOOK_OK)
        result = time_piled(b, &box);
    nook_fixture_mesh_free(&box);
    nook_fixture_view_destroy(b->view);
    *out_hold = result == NOOK_OK;
    return result;
}

static bool read_options(int argc, char **argv, occluders_options *out, int *out_exit_code)
{
    *out = (occluders_options){ .setting = "volume", .size = { 512, 512 }, .frames = 9, .most = COUNT_MAX, .pile = 64 };
    const nook_option options[] = {
        nook_option_row_size(&out->size, "of the picture in pixels; default 512x512"),
        nook_option_row_int("most", &out->most, 1, COUNT_MAX, "occluders apart; default 4096"),
        nook_option_row_int("pile", &out->pile, 1, COUNT_MAX, "occluders piled up; default 64"),
        nook_option_row_int("frames", &out->frames, 1, FRAMES_MAX, "timed of each row; default 9"),
        nook_option_row_cpu(&out->cpu),
        nook_option_row_backend(&out->backend),
    };
    const nook_usage usage = {
        .command = "bench occluders",
        .summary = "Times occlusion by many volumes.",
        .positionals = "[SETTING]",
        .positional_max = 1,
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "SETTING: a technique and parameters in one argument, default \"volume\"; as \"volume kind=surfel "
            "rays=4\".\n"
            "apart: boxes over a floor, each in reach of its own surroundings, as volumes of their own and as one\n"
            "volume of them all, with voxels of the same size as far as 512 go; piled up: all in one place. Of\n"
            "\"volume\": union: exact, ray by ray; product: of visibilities; raster: the same, each box drawn and\n"
            "blended (volume.combine, volume.path).\n"
    };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->setting = arguments.positionals[0];
    return true;
}

int nook_bench_run_occluders(const nook_app *app, int argc, char **argv)
{
    occluders_options options;
    int exit_code;
    if (!read_options(argc, argv, &options, &exit_code))
        return exit_code;
    occluders_bench bench = { .options = &options };
    if (nook_setting_parse("bench occluders", options.setting, &bench.setting) != NOOK_OK)
        return NOOK_EXIT_USAGE;
    bench.way_count = nook_bench_ways(bench.setting.technique, &bench.ways);
    return nook_findings_with_device(app, options.backend, NULL, run, &bench);
}
