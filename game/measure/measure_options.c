#include "game/measure/measure_options.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/result.h"
#include <stdio.h>

/* Paths that follow from where the program's data is. */
static void fill_defaults(const nook_app *app, nook_measure_options *out)
{
    *out = (nook_measure_options){ .out = "measured", .backend = NOOK_BACKEND_AUTO };
    out->cache = nook_option_default_cache(app, out->default_cache);
    nook_option_default_scene(app, out->default_scene);
}

static void choose_suite(const nook_app *app, nook_measure_options *out)
{
    const char *file = out->suite == 0 ? "content/suites/quick.txt" : "content/suites/full.txt";
    nook_path_join(out->suite_path, sizeof out->suite_path, app->root, file);
    if (!out->sweep)
        out->sweep = out->suite_path;
}

static void take_scenes(const nook_arguments *arguments, nook_measure_options *out)
{
    for (int i = 0; i < arguments->positional_count; i++)
        out->scenes[out->scene_count++] = arguments->positionals[i];
    if (out->scene_count == 0 && !out->scene_folder)
        out->scenes[out->scene_count++] = out->default_scene;
}

/* What --tables would not look at. @param sweep  as it was given; NULL: it was not */
static bool refuse_with_tables(const nook_measure_options *options, const char *sweep, int scene_count)
{
    const char *ignored = scene_count > 0         ? "a scene"
                          : options->scene_folder ? "--scenes"
                          : sweep                 ? "--sweep"
                          : options->params.count ? "--param"
                          : options->settings     ? "--settings"
                                                  : NULL;
    if (options->tables && ignored)
        nook_fail(NOOK_E_ARG, "measure: --tables measures nothing, so that %s is of no use; leave one of them out",
                  ignored);
    return options->tables && ignored;
}

bool nook_measure_options_read(const nook_app *app, int argc, char **argv, nook_measure_options *out,
                               int *out_exit_code)
{
    fill_defaults(app, out);
    const nook_option options[] = {
        { .name = "suite",
          .kind = NOOK_OPTION_CHOICE,
          .target = &out->suite,
          .placeholder = "NAME",
          .choices = "quick|full",
          .help = "quick (minutes) or full; default quick" },
        { .name = "sweep",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->sweep,
          .placeholder = "FILE",
          .help = "settings and views of one's own; content/suites/ has examples" },
        { .name = "param",
          .kind = NOOK_OPTION_LIST,
          .target = &out->params,
          .placeholder = "NAME=VALUE",
          .help = "in every setting of that technique: volume.kind=surfel; names: ./nook compare "
                  "--list-params" },
        nook_option_row_settings(
            &out->settings,
            "measure this setting, as ./nook tune writes it, beside those of the sweep; compare and bake take it\n"
            "                             too; verify, extremes and tune take none"),
        { .name = "scenes",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->scene_folder,
          .placeholder = "DIR",
          .help = "measure every .glb and .gltf in it and in the folders in it" },
        { .name = "out",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->out,
          .placeholder = "DIR",
          .help = "journal, tables, report and pictures; default measured" },
        { .name = "merge",
          .kind = NOOK_OPTION_LIST,
          .target = &out->merge,
          .placeholder = "DIR",
          .help = "take in what was measured into that folder; may be given again" },
        { .name = "keep",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->keep,
          .help = "rows that another build measured count too" },
        { .name = "tables",
          .kind = NOOK_OPTION_FLAG,
          .target = &out->tables,
          .help = "measure nothing: write tables and report of what is there" },
        { .name = "document",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->document,
          .placeholder = "FILE",
          .help = "put the tables into it, between its lines \"measured: begin\" and \"measured: end\"" },
        nook_option_row_cache(&out->cache, "where the truths are kept; default: cache/ of Nook"),
        nook_option_row_backend(&out->backend),
    };
    const nook_usage usage = {
        .command = "measure",
        .summary =
            "Measures what each setting costs and how wrong it is, on scenes (default: the demo level), cameras and\n"
            "reaches, against rays traced until their own noise is under a quarter of the error.",
        .positionals = "[SCENE...]",
        .positional_max = NOOK_POSITIONAL_MAX,
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "Files: measure.csv, measure.json, report.html (open it in a browser), pictures/, and journal.jsonl: what "
            "was\n"
            "measured so far. Interrupted (Ctrl-C), the same command goes on from there; nothing is measured twice.\n"
            "Exit code 1 when a scene could not be measured, a pixel was not finite, or the truth's noise is over a\n"
            "quarter of an error.\n",
    };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (refuse_with_tables(out, out->sweep, arguments.positional_count)) {
        *out_exit_code = NOOK_EXIT_USAGE;
        return false;
    }
    choose_suite(app, out);
    take_scenes(&arguments, out);
    return true;
}
