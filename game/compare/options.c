#include "game/compare/options.h"
#include "engine/core/result.h"
#include "game/volumes.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The names that ao.scale knows, and the other ways to say them. */
static bool read_scale(void *target, const char *text)
{
    static const char *const spellings[][5] = { { "full", "1", "1/1", "1.0", "full" },
                                                { "half", "2", "1/2", "0.5", "half" },
                                                { "quarter", "4", "1/4", "0.25", "quarter" } };
    for (size_t i = 0; i < NOOK_COUNT(spellings); i++) {
        for (size_t j = 0; j < NOOK_COUNT(spellings[i]); j++) {
            if (strcmp(text, spellings[i][j]) == 0) {
                *(const char **)target = spellings[i][0];
                return true;
            }
        }
    }
    return false;
}

static bool read_time(void *target, const char *text)
{
    nook_moment *moment = target;
    char *end;
    double seconds = strtod(text, &end);
    if (end == text || *end || !isfinite(seconds))
        return false;
    moment->seconds = seconds;
    moment->timed = true;
    return true;
}

static bool read_views(void *target, const char *text)
{
    return nook_view_list_read(text, target);
}

bool nook_compare_options_read(const nook_app *app, int argc, char **argv, nook_compare_options *out,
                               int *out_exit_code)
{
    *out = (nook_compare_options){
        .size = { 960, 540 }, .out = "out", .backend = NOOK_BACKEND_AUTO, .plan = -1, .volumes = -1
    };
    out->scene = nook_option_default_scene(app, out->default_scene);
    out->cache = nook_option_default_cache(app, out->default_cache);
    char view_help[512], view_names[512], view_expects[600], resolution_help[128];
    snprintf(view_help, sizeof view_help,
             "also writes view_<name>.png of the frame, names with commas between:\n%29s%s", "",
             nook_view_list_names(6, view_names, sizeof view_names));
    snprintf(view_expects, sizeof view_expects, "names with commas between, of %s",
             nook_view_list_names(0, view_names, sizeof view_names));
    snprintf(resolution_help, sizeof resolution_help,
             "voxels along the longest side of what stands still; a body has at most half; default %u",
             NOOK_VOLUMES_RESOLUTION_DEFAULT);
    const nook_option options[] = {
        nook_option_row_settings(
            &out->settings,
            "a setting, as ./nook tune writes it, beside the reference; options given here count more;\n"
            "                             measure and bake take it too; verify, extremes and tune take none"),
        { .name = "camera",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->camera,
          .placeholder = "NAME|p,t,fov",
          .help = "a camera of the scene (./nook info SCENE names them), or px,py,pz,tx,ty,tz,fov: eye, target,\n"
                  "                             degrees; default: the scene's first" },
        { .name = "time",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->moment,
          .placeholder = "S",
          .read = read_time,
          .expects = "seconds",
          .help = "poses the scene at this time of its clip, volumes and reference too; default: at rest" },
        { .name = "clip",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->moment.clip,
          .placeholder = "NAME",
          .help = "which clip --time is of (./nook info SCENE names them); default: the first" },
        nook_option_row_size(&out->size, "of the pictures in pixels; default 960x540"),
        nook_option_row_r_max(&out->r_max, nook_option_r_max_help),
        nook_option_row_falloff(&out->falloff),
        nook_option_row_techniques(&out->techniques, "which ones; default: all, or that of --settings"),
        { .name = "ao-scale",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->ao_scale,
          .placeholder = "S",
          .read = read_scale,
          .expects = "full, half or quarter (1, 1/2, 1/4)",
          .help = "resolution of the trace: full, half or quarter" },
        { .name = "plan",
          .kind = NOOK_OPTION_CHOICE,
          .target = &out->plan,
          .placeholder = "MODE",
          .choices = "off|on|measured",
          .help = "march only the volumes that the scene requires (docs/plan.md): off, on or measured; default off" },
        { .name = "volumes",
          .kind = NOOK_OPTION_CHOICE,
          .target = &out->volumes,
          .placeholder = "MADE",
          .choices = "baked|live",
          .help =
              "live: one for all that is rigid, voxelised on the GPU as it moves; nothing is baked; default baked" },
        { .name = "param",
          .kind = NOOK_OPTION_LIST,
          .target = &out->params,
          .placeholder = "technique.name=V",
          .help = "sets a parameter; technique ao: those that all share" },
        { .name = "list-params",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->list_params,
          .help = "print every parameter that --param takes: initial value, range, unit; and do nothing else" },
        nook_option_row_reference_rays(
            &out->reference_rays, 1,
            "rays per pixel of the ray-traced reference; default 256. Its noise adds to every error"),
        { .name = "frames",
          .kind = NOOK_OPTION_INT,
          .target = &out->frames,
          .placeholder = "N",
          .lowest = 1,
          .highest = 10000,
          .help = "timed frames of each technique; default: 5, fewer when they take seconds" },
        { .name = "no-instability",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->no_instability,
          .help = "no second view, which costs every technique another frame" },
        { .name = "view",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->views,
          .placeholder = "NAME[,NAME...]",
          .read = read_views,
          .expects = view_expects,
          .help = view_help },
        { .name = "out",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->out,
          .placeholder = "DIR",
          .help = "where the pictures and compare.json go; default out" },
        nook_option_row_backend(&out->backend),
        nook_option_row_resolution(&out->resolution, resolution_help),
        nook_option_row_cache(&out->cache, "where baked volumes are kept; default: cache/ of Nook"),
        { .name = "no-window",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->no_window,
          .help = "write the files only, also where there is a display" },
        nook_option_row_json(&out->json, "print compare.json instead of the table"),
    };
    const nook_usage usage = {
        .command = "compare",
        .summary =
            "Compares the ambient-occlusion techniques on a glTF scene, default the demo level, with a ray-traced\n"
            "reference: pictures, errors and times into --out. With a display it then opens a window.",
        .positionals = "[SCENE]",
        .positional_max = 1,
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "Files: compare.png (everything on one sheet), <technique>.png and .pfm (visibility, 1 = open),\n"
            "lit_<technique>.png, error_<technique>.png (blue: too bright, red: too dark), view_<name>.png (--view),\n"
            "compare.json. They appear all at once, in the place of those of an older comparison.\n"
            "Instability (unsteady): RMS change of visibility at the same world points, seen from a second camera "
            "turned 20\n"
            "degrees around what stands in the picture's middle (10 or 5 where that shows too little of the same).\n"
            "Window: drag left to orbit, right to pan, scroll to zoom; 1-9 choose the technique, 0 none, V the view,\n"
            "C the camera, M what is shown, + and - views side by side; F1 lists all keys; Esc quits.\n",
    };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->scene = arguments.positionals[0];
    return true;
}
