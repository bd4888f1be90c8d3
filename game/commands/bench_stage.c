#include "game/commands/bench_stage.h"
#include "game/compare/camera.h"
#include <assert.h>
#include <stdio.h>

bool nook_bench_stage_read(const nook_app *app, const nook_usage *usage, int argc, char **argv,
                           nook_bench_stage_options *out, int *out_exit_code)
{
    *out = (nook_bench_stage_options){ .size = { 640, 360 }, .backend = NOOK_BACKEND_AUTO };
    out->scene = nook_option_default_scene(app, out->default_scene);
    out->cache = nook_option_default_cache(app, out->default_cache);
    nook_option options[NOOK_BENCH_OPTIONS_MAX];
    size_t count = 0;
    assert(usage->option_count + 4 <= NOOK_BENCH_OPTIONS_MAX);
    options[count++] = nook_option_row_size(&out->size, "of the pictures in pixels; default 640x360");
    options[count++] =
        nook_option_row_settings(&out->settings, "technique and parameters; default: volume as it comes");
    for (size_t i = 0; i < usage->option_count; i++)
        options[count++] = usage->options[i];
    options[count++] = nook_option_row_backend(&out->backend);
    options[count++] = nook_option_row_cache(&out->cache, "where baked volumes are kept; default: cache/ of Nook");
    nook_usage whole = *usage;
    whole.positionals = "[SCENE]";
    whole.positional_max = 1;
    whole.options = options;
    whole.option_count = count;
    nook_arguments arguments;
    if (!nook_arguments_read(&whole, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->scene = arguments.positionals[0];
    return true;
}

nook_result nook_bench_stage_open(const nook_bench_stage_options *options, const char *root, bool quick,
                                  nook_stage *out_stage, nook_settings_file *out_settings)
{
    const nook_stage_desc desc = { .root = root,
                                   .scene_path = options->scene,
                                   .backend = options->backend,
                                   .plays = options->plays,
                                   .width = (uint32_t)options->size.width,
                                   .height = (uint32_t)options->size.height };
    nook_settings_file settings;
    nook_result result = nook_stage_settings_read(options->settings, &settings);
    if (result == NOOK_OK)
        result = nook_stage_open(&desc, out_stage);
    if (result != NOOK_OK)
        return result;
    out_stage->quick = quick;
    result = nook_stage_fill_as_set(out_stage, &settings, options->cache);
    if (result != NOOK_OK)
        nook_stage_close(out_stage);
    else if (out_settings)
        *out_settings = settings;
    return result;
}

int nook_bench_stage_run(const nook_bench_stage_options *options, const char *root, bool quick,
                         nook_bench_stage_work work, void *user)
{
    nook_settings_file settings;
    nook_stage stage;
    if (nook_bench_stage_open(options, root, quick, &stage, &settings) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    nook_result result = work(user, &stage, &settings);
    nook_stage_close(&stage);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

void nook_bench_stage_print(const nook_bench_stage_options *options, const nook_stage *stage,
                            const nook_settings_file *settings)
{
    char setting[NOOK_SETTING_TEXT_MAX];
    printf("%s, %u x %u, %s, r_max %.3g m, %s\n", options->scene, stage->width, stage->height, stage->gpu->renderer,
           stage->volumes.r_max, nook_setting_print(&settings->setting, setting));
}

uint32_t nook_bench_stage_camera_count(const nook_stage *stage)
{
    uint32_t count = 0;
    while (nook_camera_at(stage->scene, count))
        count++;
    return count > 0 ? count : 1;
}

nook_result nook_bench_stage_camera(const nook_stage *stage, uint32_t index, nook_camera *out_camera,
                                    char out_name[NOOK_BENCH_CAMERA_NAME_SIZE])
{
    const nook_scene_camera *found = nook_camera_at(stage->scene, index);
    if (!found)
        return nook_camera_choose(stage->scene, NULL, (double)stage->width / stage->height, out_camera, out_name,
                                  NOOK_BENCH_CAMERA_NAME_SIZE);
    *out_camera = nook_camera_from_scene(found);
    snprintf(out_name, NOOK_BENCH_CAMERA_NAME_SIZE, "%s", found->name);
    return NOOK_OK;
}
