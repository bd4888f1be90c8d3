#include "game/tune/tune_options.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/compare/choice.h"
#include "game/tune/search.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

enum { RAYS_DEFAULT = 128, OPTIONS_MAX = 16 };

/* The techniques to choose among: those of the list, else all; never an exact one, which is what they are measured against. */
static nook_result make_space(const char *list, nook_tune_space *out)
{
    nook_compare_choice choice;
    nook_result result = nook_compare_choose(list, &choice);
    for (uint32_t i = 0; i < choice.count && result == NOOK_OK; i++) {
        if (!choice.techniques[i]->exact)
            nook_tune_space_add(out, choice.techniques[i]);
    }
    if (result == NOOK_OK && out->technique_count == 0)
        return nook_fail(NOOK_E_ARG, "--techniques %s: that is the truth itself; give others to choose among", list);
    return result;
}

static nook_result check(nook_tune_options *options)
{
    static const char falloff[] = "ao.falloff";
    if (options->goal.max_error == 0.0 && options->goal.max_ms == 0.0)
        return nook_fail(NOOK_E_ARG, "tune: no budget; give --max-error E, --max-ms T or both");
    if (options->falloff && nook_compare_check_param(falloff, strlen(falloff), options->falloff) != NOOK_OK)
        return NOOK_E_ARG;
    return make_space(options->techniques, &options->space);
}

/* tuned_<scene>.txt, here. */
static const char *default_out(const char *scene, char out[NOOK_OPTION_PATH_MAX])
{
    const char *name = nook_path_name(scene), *extension = nook_path_extension(name);
    snprintf(out, NOOK_OPTION_PATH_MAX, "tuned_%.*s.txt", (int)(extension - name), name);
    return out;
}

/* The options of the command, as they are put together. */
typedef struct option_list {
    nook_option items[OPTIONS_MAX];
    size_t count;
} option_list;

static void append(option_list *list, const nook_option *options, size_t count)
{
    assert(list->count + count <= OPTIONS_MAX);
    memcpy(&list->items[list->count], options, count * sizeof *options);
    list->count += count;
}

static void add_budget(option_list *list, nook_tune_options *out)
{
    const nook_option options[] = {
        { .name = "max-error",
          .kind = NOOK_OPTION_NUMBER,
          .target = &out->goal.max_error,
          .placeholder = "E",
          .lowest = 1e-6,
          .highest = 1.0,
          .help = "budget: root mean square error of visibility over all cameras, and one standard error" },
        { .name = "max-ms",
          .kind = NOOK_OPTION_NUMBER,
          .target = &out->goal.max_ms,
          .placeholder = "T",
          .lowest = 1e-6,
          .highest = 1e6,
          .help = "budget: ms a frame, mean of all cameras and one standard error, on this machine at --size" },
    };
    append(list, options, NOOK_COUNT(options));
}

/* What is looked at: size and what occlusion means. */
static void add_picture(option_list *list, nook_tune_options *out)
{
    const nook_option options[] = {
        nook_option_row_size(&out->size, "of the pictures in pixels; default 384x216"),
        nook_option_row_r_max(&out->r_max, nook_option_r_max_help),
        nook_option_row_falloff(&out->falloff),
    };
    append(list, options, NOOK_COUNT(options));
}

static void add_search(option_list *list, nook_tune_options *out)
{
    const nook_option options[] = {
        nook_option_row_techniques(&out->techniques, "to choose among; default: all"),
        { .name = "cameras",
          .kind = NOOK_OPTION_INT,
          .target = &out->cameras,
          .placeholder = "N",
          .lowest = 2,
          .highest = NOOK_TUNE_VIEWS_MAX,
          .help = "to choose by, and as many others for the proof; default: as many as the proof needs" },
        { .name = "tries",
          .kind = NOOK_OPTION_INT,
          .target = &out->tries,
          .placeholder = "N",
          .lowest = 1,
          .highest = NOOK_TUNE_TRIALS_MAX,
          .help = "settings to try at most; default 70" },
        nook_option_row_reference_rays(&out->reference_rays, 2, "rays per pixel of the truth at most; default 128"),
    };
    append(list, options, NOOK_COUNT(options));
}

static void add_files(option_list *list, nook_tune_options *out)
{
    const nook_option options[] = {
        { .name = "out",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->out,
          .placeholder = "FILE",
          .help = "the settings file; default tuned_<scene>.txt" },
        nook_option_row_backend(&out->backend),
        nook_option_row_cache(&out->cache, "where baked volumes and truths are kept; default: cache/ of Nook"),
        nook_option_row_json(&out->json, "print the result as JSON"),
    };
    append(list, options, NOOK_COUNT(options));
}

static option_list list_options(nook_tune_options *out)
{
    option_list list = { .count = 0 };
    add_budget(&list, out);
    add_picture(&list, out);
    add_search(&list, out);
    add_files(&list, out);
    return list;
}

static const char summary[] =
    "Finds the cheapest setting within an error, or the most accurate within a time, for a glTF scene (default\n"
    "the demo level): technique, rays, steps, resolution of volumes, scale, filter. Chooses by sampled cameras,\n"
    "proves it on others, and writes a settings file.";

static const char details[] =
    "With both budgets: the most accurate setting within both. Within a budget is what is so with one standard\n"
    "error on top, as views differ. Then the winner is timed afresh and measured on held-back cameras: the other\n"
    "one of each pair of near views, none of them used to choose. Exit code 1, and nothing written, when nothing\n"
    "fits (the nearest is told), or when there the error is over 15 % off the predicted one, or over the budget by\n"
    "more than its own standard error, or the time is over the budget by more than its frames differ.\n"
    "Use the file: ./nook compare SCENE --settings FILE; measure and bake take it too. verify, extremes and tune\n"
    "take none: they hold techniques as they come, or find the setting themselves.\n";

bool nook_tune_options_read(const nook_app *app, int argc, char **argv, nook_tune_options *out, int *out_exit_code)
{
    *out = (nook_tune_options){ .size = { 384, 216 },
                                .backend = NOOK_BACKEND_AUTO,
                                .tries = NOOK_TUNE_TRIES_DEFAULT,
                                .reference_rays = RAYS_DEFAULT };
    out->scene = nook_option_default_scene(app, out->default_scene);
    out->cache = nook_option_default_cache(app, out->default_cache);
    const option_list list = list_options(out);
    const nook_usage usage = { .command = "tune",
                               .summary = summary,
                               .positionals = "[SCENE]",
                               .positional_max = 1,
                               .options = list.items,
                               .option_count = list.count,
                               .details = details };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->scene = arguments.positionals[0];
    if (!out->out)
        out->out = default_out(out->scene, out->default_out);
    *out_exit_code = NOOK_EXIT_USAGE;
    return check(out) == NOOK_OK;
}
