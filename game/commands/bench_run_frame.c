/* Where the milliseconds of a frame go: each pass between two glFinish, on the scene's cameras, with one body that moves a
   little in every frame, as in a game. */
#include "engine/core/clock.h"
#include "engine/core/order.h"
#include "game/commands/bench_stage.h"
#include "game/commands/benches.h"

enum { FRAMES_MAX = 1000 };

typedef enum step {
    STEP_BEGIN_STILL,  /**< Systems, culling, G-buffer; nothing has moved. */
    STEP_BEGIN_MOVING, /**< The same after a body has moved: its shadow is drawn anew. */
    STEP_OCCLUDE,
    STEP_FINISH, /**< Light, tone mapping. */
    STEP_COUNT
} step;

static const char *const step_names[STEP_COUNT] = { "gbuffer", "gbuffer_shadow", "occlusion", "light" };

typedef struct frame_options {
    nook_bench_stage_options stage;
    int32_t frames;
    bool cpu, quick;
} frame_options;

static bool read_options(const nook_app *app, int argc, char **argv, frame_options *out, int *out_exit_code)
{
    out->frames = 20;
    out->cpu = out->quick = false;
    const nook_option options[] = {
        nook_option_row_int("frames", &out->frames, 1, FRAMES_MAX,
                            "timed of each camera, after two to warm up; default 20"),
        nook_option_row_cpu(&out->cpu),
        nook_option_row_flag("quick", &out->quick, "draws as ./nook play does, not as for measuring"),
    };
    const nook_usage usage = {
        .command = "bench frame",
        .summary = "Times the passes of a frame on the cameras of a scene, default the demo level.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details = "Milliseconds of wall time around glFinish, medians over the frames; gbuffer_shadow: the\n"
                   "same as gbuffer in a frame in which a body has moved.\n"
    };
    return nook_bench_stage_read(app, &usage, argc, argv, &out->stage, out_exit_code);
}

/* Moves the first body by a centimetre and back. */
static void nudge(nook_stage *stage, bool there)
{
    for (uint32_t i = 0; i < stage->scene->node_count; i++) {
        if (!stage->scene->nodes[i].moving || stage->scene->nodes[i].mesh == NOOK_NONE)
            continue;
        nook_entity entity = nook_game_world_entity_of_node(stage->world, i);
        nook_transform *transform = nook_entity_find(nook_game_world_entities(stage->world), entity,
                                                     nook_game_world_components(stage->world)->transform);
        transform->world_from_local[12] = stage->scene->nodes[i].world_from_local.m[12] + (there ? 0.01 : 0.0);
        return;
    }
}

/* Runs one step and tells how long it took. */
static nook_result timed(nook_stage *stage, const nook_camera *camera, step which, bool cpu, double *out_ms)
{
    double (*clock)(void) = cpu ? nook_clock_cpu_ms : nook_clock_ms;
    nook_gpu_finish(stage->gpu);
    double start = clock();
    nook_result result = NOOK_OK;
    if (which == STEP_BEGIN_STILL || which == STEP_BEGIN_MOVING)
        result = nook_stage_begin(stage, camera);
    else if (which == STEP_OCCLUDE)
        result = nook_stage_occlude(stage);
    else
        result = nook_stage_finish(stage, true, NOOK_VIEW_LIT);
    nook_gpu_finish(stage->gpu);
    *out_ms = clock() - start;
    return result;
}

static nook_result time_camera(nook_stage *stage, const nook_camera *camera, int32_t frames, bool cpu,
                               double out_ms[STEP_COUNT])
{
    static const int32_t warm = 2;
    double ms[STEP_COUNT][FRAMES_MAX + 2];
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < warm + frames && result == NOOK_OK; i++) {
        for (step which = 0; which < STEP_COUNT && result == NOOK_OK; which++) {
            if (which == STEP_BEGIN_MOVING)
                nudge(stage, i % 2 == 0);
            result = timed(stage, camera, which, cpu, &ms[which][i]);
        }
        stage->frame_index++;
    }
    for (step which = 0; which < STEP_COUNT && result == NOOK_OK; which++)
        out_ms[which] = nook_median(ms[which] + warm, (size_t)frames);
    return result;
}

static void print_head(const frame_options *options, const nook_stage *stage, const nook_settings_file *settings)
{
    nook_bench_stage_print(&options->stage, stage, settings);
    printf("milliseconds of %s\n\n  %-20s", options->cpu ? "all threads together" : "wall time", "camera");
    for (step which = 0; which < STEP_COUNT; which++)
        printf(" %14s", step_names[which]);
    printf(" %14s\n", "sum_moving");
}

static void print_camera(const char *name, const double ms[STEP_COUNT])
{
    double sum = 0.0;
    printf("  %-20s", name);
    for (step which = 0; which < STEP_COUNT; which++) {
        printf(" %14.2f", ms[which]);
        sum += which == STEP_BEGIN_STILL ? 0.0 : ms[which];
    }
    printf(" %14.2f\n", sum);
}

static nook_result run(void *user, nook_stage *stage, const nook_settings_file *settings)
{
    const frame_options *options = user;
    const uint32_t count = nook_bench_stage_camera_count(stage);
    nook_result result = NOOK_OK;
    print_head(options, stage, settings);
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++) {
        nook_camera camera;
        char name[NOOK_BENCH_CAMERA_NAME_SIZE];
        double ms[STEP_COUNT];
        result = nook_bench_stage_camera(stage, i, &camera, name);
        if (result == NOOK_OK)
            result = time_camera(stage, &camera, options->frames, options->cpu, ms);
        if (result == NOOK_OK)
            print_camera(name, ms);
    }
    return result;
}

int nook_bench_run_frame(const nook_app *app, int argc, char **argv)
{
    frame_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    return nook_bench_stage_run(&options.stage, app->root, options.quick, run, &options);
}
