#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/commands/commands.h"
#include "game/compare/camera.h"
#include "game/level/level_scene.h"
#include "game/moment.h"
#include "game/option_rows.h"
#include "game/plan/plan_report.h"
#include "game/settings/settings_file.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The command line. Parameters that are not given are NaN, or -1. */
typedef struct plan_request {
    const char *scene, *camera, *settings;
    nook_option_size size;
    int32_t resolution, mode, rays;
    double r_max, error, level_error, memory, split;
    bool plays, multiplies;
} plan_request;

static const nook_param *row_of(const char *name)
{
    size_t count;
    const nook_param *rows = nook_plan_param_table(&count);
    return nook_param_find(rows, count, name);
}

typedef char help_text[128];

static const char *print_help(const char *name, help_text out)
{
    const nook_param *row = row_of(name);
    snprintf(out, sizeof(help_text), "%s; default %g", row->help, row->initial);
    return out;
}

static nook_option number_row(const char *option, const char *name, double *target, help_text help)
{
    const nook_param *row = row_of(name);
    return (nook_option){ .name = option,
                          .kind = NOOK_OPTION_NUMBER,
                          .target = target,
                          .placeholder = "X",
                          .help = print_help(name, help),
                          .lowest = row->lowest,
                          .highest = row->highest };
}

static const char details[] =
    "SCENE: a .gltf, .glb or .level file.\n"
    "Applied by plan = on (what is proven) or plan = measured in a settings file, and by compare --plan.\n"
    "The rules, their bounds and how these are derived: docs/plan.md.\n";

static bool read_request(int argc, char **argv, plan_request *out, int *out_exit_code)
{
    *out = (plan_request){
        .size = { 960, 540 }, .mode = -1, .rays = -1, .error = NAN, .level_error = NAN, .memory = NAN, .split = NAN
    };
    help_text helps[6];
    snprintf(helps[5], sizeof helps[5], "voxels along the longest side of what stands still without a plan; default %u",
             NOOK_VOLUMES_RESOLUTION_DEFAULT);
    const nook_option options[] = {
        nook_option_row_settings(
            &out->settings, "resolution, r_max, plan and how volumes combine, of a settings file; options count more"),
        { .name = "plan",
          .kind = NOOK_OPTION_CHOICE,
          .target = &out->mode,
          .placeholder = "MODE",
          .choices = row_of("mode")->choices,
          .help = "off, on: what is proven, or measured: also levels and static volumes; default measured" },
        number_row("error", "error", &out->error, helps[0]),
        number_row("level-error", "level_error", &out->level_error, helps[1]),
        number_row("memory", "memory", &out->memory, helps[2]),
        number_row("split", "split", &out->split, helps[3]),
        nook_option_row_int("rays", &out->rays, (int32_t)row_of("rays")->lowest, (int32_t)row_of("rays")->highest,
                            print_help("rays", helps[4])),
        nook_option_row_text(
            "camera", &out->camera, "NAME|p,t,fov",
            "plan for what this camera can see, as in compare; default: for all surfaces, from anywhere"),
        nook_option_row_size(&out->size, "of the pictures in pixels, with --camera; default 960x540"),
        nook_option_row_flag("plays", &out->plays, "bodies will not stay where they stand: distances prove nothing"),
        nook_option_row_resolution(&out->resolution, helps[5]),
        nook_option_row_r_max(&out->r_max, nook_option_r_max_help),
    };
    const nook_usage usage = { .command = "plan",
                               .summary = "Says which volumes a scene requires and how fine, why, what that saves, and "
                                          "within which error.",
                               .positionals = "SCENE",
                               .positional_min = 1,
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options),
                               .details = details };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    out->scene = arguments.positionals[0];
    return true;
}

/* What the settings file says, and over that what the command line does. */
static nook_result settle(plan_request *request, nook_plan_params *out)
{
    nook_settings_file file = { .plan = nook_plan_params_initial() };
    nook_result result = request->settings ? nook_settings_file_read(request->settings, &file) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    *out = file.plan;
    request->multiplies = request->settings && nook_setting_multiplies(&file.setting);
    if (request->resolution == 0)
        request->resolution = (int32_t)file.setting.resolution;
    if (request->r_max == 0.0)
        request->r_max = file.r_max;
    if (request->mode >= 0)
        out->mode = request->mode;
    else if (out->mode == NOOK_PLAN_OFF)
        out->mode = NOOK_PLAN_MEASURED;
    out->rays = request->rays >= 0 ? request->rays : out->rays;
    out->error = isnan(request->error) ? out->error : (float)request->error;
    out->level_error = isnan(request->level_error) ? out->level_error : (float)request->level_error;
    out->memory = isnan(request->memory) ? out->memory : (float)request->memory;
    out->split = isnan(request->split) ? out->split : (float)request->split;
    return NOOK_OK;
}

static nook_result load(const char *path, nook_scene **out_scene)
{
    const nook_scene_options geometry = { .skip_images = true };
    if (strcmp(nook_path_extension(path), ".level") == 0) {
        nook_level *level;
        nook_result result = nook_level_read(path, &level);
        if (result != NOOK_OK)
            return result;
        result = nook_level_scene_load(level, &geometry, out_scene);
        nook_level_free(level);
        return result;
    }
    nook_result result = nook_scene_load(path, &geometry, out_scene);
    return result == NOOK_OK ? nook_moment_stand_still(*out_scene, &(nook_moment){ .clip = NULL }) : result;
}

static nook_result print_plan(const nook_scene *scene, const nook_scene_volumes *volumes,
                              const nook_plan_params *params, const nook_plan_situation *situation, const char *from)
{
    nook_plan_description description;
    nook_plan plan = { .groups = NULL };
    nook_result result = nook_plan_describe(scene, volumes, (uint32_t)params->rays, situation, &description);
    if (result == NOOK_OK)
        result = nook_plan_make(&description.scene, params, &plan);
    const nook_plan_report report = { scene, volumes, &description.scene, &plan, from };
    if (result == NOOK_OK)
        nook_plan_report_print(&report, stdout);
    nook_plan_free(&plan);
    nook_plan_description_free(&description);
    return result;
}

static nook_result plan_scene(const nook_scene *scene, const plan_request *request, const nook_plan_params *params)
{
    const nook_volumes_desc desc = { .resolution = (uint32_t)request->resolution, .r_max = request->r_max };
    nook_plan_situation situation = { .moves = request->plays,
                                      .multiplies = request->multiplies,
                                      .aspect = (double)request->size.width / request->size.height,
                                      .height = (uint32_t)request->size.height };
    nook_scene_volumes volumes;
    nook_camera camera;
    char label[128] = "anywhere";
    nook_result result = nook_volumes_collect(scene, &desc, &volumes);
    if (result != NOOK_OK)
        return result;
    if (volumes.volume_count == 0)
        result = nook_fail(NOOK_E_FORMAT, "%s: nothing in it is opaque and has an area: there is nothing to plan",
                           scene->path);
    if (result == NOOK_OK && request->camera)
        result = nook_camera_choose(scene, request->camera, situation.aspect, &camera, label, sizeof label);
    if (request->camera)
        situation.camera = &camera;
    if (result == NOOK_OK)
        result = print_plan(scene, &volumes, params, &situation, label);
    nook_volumes_free(&volumes);
    return result;
}

int nook_command_plan(const nook_app *app, int argc, char **argv)
{
    plan_request request;
    nook_plan_params params;
    nook_scene *scene = NULL;
    int exit_code;
    (void)app;
    if (!read_request(argc, argv, &request, &exit_code))
        return exit_code;
    nook_result result = settle(&request, &params);
    if (result == NOOK_OK)
        result = load(request.scene, &scene);
    if (result == NOOK_OK)
        result = plan_scene(scene, &request, &params);
    nook_scene_destroy(scene);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
