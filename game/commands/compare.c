#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/commands/commands.h"
#include "game/compare/camera.h"
#include "game/compare/options.h"
#include "game/compare/output.h"
#include "game/compare/param_list.h"
#include "game/compare/report.h"
#include "game/compare/run.h"
#include "game/exposure.h"
#include "game/view/viewer.h"
#include "game/volumes.h"
#include <stdlib.h>
#include <string.h>

/* One assignment of --param; those of the plan belong to the stage. */
static nook_result set_param(nook_stage *stage, const char *text)
{
    char name[256];
    const char *equals = strchr(text, '='); /* checked with the options */
    snprintf(name, sizeof name, "%.*s", (int)(equals - text), text);
    if (strncmp(name, "plan.", 5) == 0)
        return nook_plan_params_assign("--param", &stage->plan, name, equals + 1);
    return nook_ao_parse_param(stage->ao, name, equals + 1);
}

/* Sets "ao.x" and "technique.x" from the settings file, then from the command line; what is set in two ways was refused with the options. */
static nook_result set_params(nook_stage *stage, const nook_compare_options *options)
{
    nook_ao *ao = stage->ao;
    double r_max = options->r_max > 0.0 ? options->r_max : nook_volumes_default_r_max(stage->scene);
    if (r_max == 0.0)
        return nook_fail(NOOK_E_FORMAT, "%s: what it draws has no size, so there is nothing to compare",
                         stage->scene->path);
    nook_result result = options->settings ? nook_setting_apply(ao, &options->file.setting) : NOOK_OK;
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.r_max", r_max);
    if (result == NOOK_OK && options->falloff)
        result = nook_ao_parse_param(ao, "ao.falloff", options->falloff);
    if (result == NOOK_OK && options->ao_scale)
        result = nook_ao_parse_param(ao, "ao.scale", options->ao_scale);
    if (result == NOOK_OK && options->reference_rays > 0)
        result = nook_ao_set_param(ao, "reference.rays", options->reference_rays);
    stage->plan = options->settings ? options->file.plan : nook_plan_params_initial();
    for (size_t i = 0; i < options->params.count && result == NOOK_OK; i++)
        result = set_param(stage, options->params.items[i]);
    if (options->plan >= 0)
        stage->plan.mode = options->plan;
    stage->live_scene = options->volumes >= 0 ? options->volumes == 1 : options->settings && options->file.live;
    return result;
}

static nook_result print(const nook_report *report, const nook_compare_options *options)
{
    if (!options->json) {
        nook_report_print_table(report, stdout);
        return NOOK_OK;
    }
    char *text;
    size_t size;
    nook_result result = nook_report_json(report, &text, &size);
    if (result != NOOK_OK)
        return result;
    fwrite(text, 1, size, stdout);
    free(text);
    return NOOK_OK;
}

/* A picture that is not numbers is no result, whatever else came out well. */
static nook_result check_finite(const nook_comparison *comparison)
{
    for (uint32_t i = 0; i < comparison->row_count; i++) {
        const nook_compare_row *row = &comparison->rows[i];
        if (!row->errors.valid)
            return nook_fail(NOOK_E_DEVICE, "%s: %llu pixels are not finite; its errors mean nothing",
                             row->technique->name, (unsigned long long)row->errors.non_finite);
        if (row->instability.non_finite > 0)
            return nook_fail(NOOK_E_DEVICE,
                             "%s: %llu points of the second view are not finite; its instability is nothing",
                             row->technique->name, (unsigned long long)row->instability.non_finite);
    }
    return NOOK_OK;
}

static nook_result report(const nook_stage *stage, const nook_compare_options *options, nook_comparison *comparison)
{
    const nook_report told = { comparison, stage, options->scene, options->out };
    nook_result result = nook_report_write(&told);
    if (result == NOOK_OK)
        result = print(&told, options);
    fflush(stdout);
    return result == NOOK_OK ? check_finite(comparison) : result;
}

static nook_result compare(nook_stage *stage, const nook_compare_options *options, const nook_compare_choice *choice,
                           nook_camera *out_camera)
{
    nook_comparison comparison;
    char label[sizeof comparison.camera];
    nook_result result = set_params(stage, options);
    if (result == NOOK_OK)
        result = nook_camera_choose(stage->scene, options->camera, (double)stage->width / stage->height, out_camera,
                                    label, sizeof label);
    if (result == NOOK_OK)
        result = nook_output_prepare(options->out);
    if (result != NOOK_OK)
        return result;
    double r_max;
    nook_ao_get_param(stage->ao, "ao.r_max", &r_max);
    const nook_game_world_desc world = { (uint32_t)options->resolution, r_max, options->cache };
    result = nook_stage_fill(stage, &world);
    if (result == NOOK_OK)
        result = nook_stage_expose(stage, out_camera);
    if (result == NOOK_OK)
        result = nook_compare_run(stage, out_camera, choice, (uint32_t)options->frames, &comparison);
    if (result != NOOK_OK)
        return result;
    memcpy(comparison.camera, label, sizeof label);
    result = nook_view_pictures_draw(stage, &options->views, &comparison.views);
    if (result == NOOK_OK && !options->no_instability)
        result = nook_compare_steadiness(stage, &comparison);
    if (result == NOOK_OK)
        result = report(stage, options, &comparison);
    nook_comparison_free(&comparison);
    return result;
}

int nook_command_compare(const nook_app *app, int argc, char **argv)
{
    nook_compare_options options;
    nook_compare_choice choice;
    int exit_code;
    if (!nook_compare_options_read(app, argc, argv, &options, &exit_code))
        return exit_code;
    if (options.list_params) {
        nook_compare_list_params(stdout);
        return NOOK_EXIT_OK;
    }
    if (nook_compare_options_check(&options, &choice) != NOOK_OK)
        return NOOK_EXIT_USAGE;
    if (nook_compare_options_settle(&options, &choice) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    const nook_stage_desc desc = { .root = app->root,
                                   .scene_path = options.scene,
                                   .backend = options.backend,
                                   .want_window = !options.no_window,
                                   .moment = options.moment,
                                   .width = (uint32_t)options.size.width,
                                   .height = (uint32_t)options.size.height };
    nook_stage stage;
    nook_camera camera;
    nook_result result = nook_stage_open(&desc, &stage);
    if (result == NOOK_OK)
        result = compare(&stage, &options, &choice, &camera);
    if (result == NOOK_OK && stage.shows && !stage.stop_asked)
        result = nook_view_run(&stage, &camera, &choice, nook_path_name(options.scene));
    nook_stage_close(&stage);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
