/* Where the milliseconds of a frame go: each pass between two glFinish, on the scene's cameras, with one body that moves a
   little in every frame, as in a game. */
#include "engine/core/clock.h"
#include "game/commands/benches.h"
#include "game/compare/camera.h"
#include "game/option_rows.h"
#include "game/settings/settings_file.h"
#include "game/stage.h"
#include "game/techniques.h"
#include "game/volumes.h"
#include <stdlib.h>

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
    const char *scene, *settings, *cache;
    nook_option_size size;
    nook_backend backend;
    int32_t frames;
    bool cpu, quick;
    char default_scene[NOOK_OPTION_PATH_MAX], default_cache[NOOK_OPTION_PATH_MAX];
} frame_options;

static bool read_options(const nook_app *app, int argc, char **argv, frame_options *out, int *out_exit_code)
{
    *out = (frame_options){ .size = { 640, 360 }, .frames = 20, .backend = NOOK_BACKEND_AUTO };
    out->scene = nook_option_default_scene(app, out->default_scene);
    out->cache = nook_option_default_cache(app, out->default_cache);
    const nook_option options[] = {
        nook_option_row_size(&out->size, "of the pictures in pixels; default 640x360"),
        nook_option_row_settings(&out->settings, "technique and parameters; default: volume as it comes"),
        { .name = "frames",
          .kind = NOOK_OPTION_INT,
          .target = &out->frames,
          .placeholder = "N",
          .lowest = 1,
          .highest = FRAMES_MAX,
          .help = "timed of each camera, after two to warm up; default 20" },
        { .name = "cpu",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->cpu,
          .help = "time that all threads have computed, which a busy machine stretches less; software GL only" },
        { .name = "quick",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->quick,
          .help = "draws as ./nook play does, not as for measuring" },
        nook_option_row_backend(&out->backend),
        nook_option_row_cache(&out->cache, "where baked volumes are kept; default: cache/ of Nook"),
    };
    const nook_usage usage = {
        .command = "bench frame",
        .summary = "Times the passes of a frame on the cameras of a scene, default the demo level.",
        .positionals = "[SCENE]",
        .positional_max = 1,
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details = "Milliseconds of wall time around glFinish, medians over the frames; gbuffer_shadow: the\n"
                   "same as gbuffer in a frame in which a body has moved.\n"
    };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->scene = arguments.positionals[0];
    return true;
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

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int32_t count)
{
    qsort(values, (size_t)count, sizeof *values, by_size);
    return values[count / 2];
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
        out_ms[which] = median(ms[which] + warm, frames);
    return result;
}

static nook_result run(nook_stage *stage, const frame_options *options, const nook_settings_file *settings)
{
    const nook_game_world_desc world = { settings->setting.resolution, settings->r_max, options->cache };
    nook_result result = nook_setting_apply(stage->ao, &settings->setting);
    double r_max = settings->r_max > 0.0 ? settings->r_max : nook_volumes_default_r_max(stage->scene);
    if (result == NOOK_OK)
        result = nook_ao_set_param(stage->ao, "ao.r_max", r_max);
    if (result == NOOK_OK && settings->falloff[0])
        result = nook_ao_parse_param(stage->ao, "ao.falloff", settings->falloff);
    if (result == NOOK_OK)
        result = nook_stage_fill(stage, &world);
    char setting[NOOK_SETTING_TEXT_MAX];
    if (result != NOOK_OK)
        return result;
    printf("%s, %u x %u, %s, r_max %.3g m, %s\nmilliseconds of %s\n\n  %-20s", options->scene, stage->width,
           stage->height, stage->gpu->renderer, r_max, nook_setting_print(&settings->setting, setting),
           options->cpu ? "all threads together" : "wall time", "camera");
    for (step which = 0; which < STEP_COUNT; which++)
        printf(" %14s", step_names[which]);
    printf(" %14s\n", "sum_moving");
    for (uint32_t i = 0; result == NOOK_OK; i++) {
        const nook_scene_camera *found = nook_camera_at(stage->scene, i);
        nook_camera camera = found ? nook_camera_from_scene(found) : (nook_camera){ 0 };
        char label[128];
        double ms[STEP_COUNT], sum = 0.0;
        if (!found && i > 0)
            break;
        if (!found)
            result = nook_camera_choose(stage->scene, NULL, (double)stage->width / stage->height, &camera, label,
                                        sizeof label);
        if (result == NOOK_OK)
            result = time_camera(stage, &camera, options->frames, options->cpu, ms);
        if (result != NOOK_OK)
            break;
        printf("  %-20s", found ? found->name : label);
        for (step which = 0; which < STEP_COUNT; which++) {
            printf(" %14.2f", ms[which]);
            sum += which == STEP_BEGIN_STILL ? 0.0 : ms[which];
        }
        printf(" %14.2f\n", sum);
    }
    return result;
}

int nook_bench_run_frame(const nook_app *app, int argc, char **argv)
{
    frame_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    nook_settings_file settings = { .setting = nook_setting_initial(nook_technique_find("volume")) };
    if (options.settings && nook_settings_file_read(options.settings, &settings) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    const nook_stage_desc desc = { .root = app->root,
                                   .scene_path = options.scene,
                                   .backend = options.backend,
                                   .width = (uint32_t)options.size.width,
                                   .height = (uint32_t)options.size.height };
    nook_stage stage;
    nook_result result = nook_stage_open(&desc, &stage);
    if (result == NOOK_OK)
        stage.quick = options.quick;
    if (result == NOOK_OK)
        result = run(&stage, &options, &settings);
    nook_stage_close(&stage);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
