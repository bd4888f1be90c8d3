#include "game/commands/commands.h"
#include "game/commands/findings.h"
#include "game/extremes/extreme_report.h"
#include "game/option_rows.h"
#include "game/progress.h"
#include "game/scratch_folder.h"

typedef struct extremes_options {
    const char *only, *out;
    nook_backend backend;
    bool list, json, quick;
} extremes_options;

/* What the callbacks of a run share. */
typedef struct extremes_run {
    const nook_extreme_group *group; /* of the last row printed */
    nook_progress progress;
    char what[256];
    size_t index, count;
    bool table;
} extremes_run;

static void begin_case(void *user, const nook_extreme_group *group, const nook_extreme *extreme)
{
    extremes_run *run = user;
    snprintf(run->what, sizeof run->what, "[%zu/%zu] %s: %s", ++run->index, run->count, group->name, extreme->name);
    run->progress = nook_progress_begin(run->what);
}

static void tell_progress(void *user, double fraction)
{
    extremes_run *run = user;
    nook_progress_update(&run->progress, fraction);
}

static void end_case(void *user, const nook_extreme_row *row)
{
    extremes_run *run = user;
    nook_progress_end(&run->progress);
    if (!run->table)
        return;
    nook_extreme_print_row(stdout, row, row->group != run->group);
    fflush(stdout); /* each row as soon as it is known */
    run->group = row->group;
}

/* The table is printed as it is made; JSON goes to standard output or to a file at the end. */
static nook_result report(const extremes_options *options, const nook_gpu *gpu, const nook_extreme_rows *rows)
{
    nook_json json = { 0 };
    nook_extreme_write_json(&json, rows, gpu->renderer, options->quick);
    nook_result result = nook_findings_put_json(&json, options->out, options->json);
    if (!options->json)
        nook_extreme_print_summary(stdout, rows);
    return result;
}

static nook_result run_on(void *user, nook_gpu *gpu, bool *out_hold)
{
    const extremes_options *options = user;
    nook_scratch_folder scratch;
    nook_result result = nook_scratch_folder_make(&scratch);
    if (result != NOOK_OK)
        return result;
    extremes_run run = { .count = nook_extreme_count(options->only), .table = !options->json };
    const nook_extremes extremes = {
        .gpu = gpu, .scratch = scratch.path, .quick = options->quick, .progress = tell_progress, .progress_user = &run
    };
    nook_extreme_rows rows;
    if (run.table)
        nook_extreme_print_head(stdout);
    result = nook_extreme_run_all(&extremes, options->only, begin_case, end_case, &run, &rows);
    nook_scratch_folder_remove(&scratch);
    if (result != NOOK_OK)
        return result;
    *out_hold = nook_extreme_summarize(&rows).failing == 0;
    result = report(options, gpu, &rows);
    nook_extreme_rows_free(&rows);
    return result;
}

int nook_command_extremes(const nook_app *app, int argc, char **argv)
{
    extremes_options settings = { .backend = NOOK_BACKEND_AUTO };
    const nook_option options[] = {
        { .name = "only",
          .kind = NOOK_OPTION_TEXT,
          .target = &settings.only,
          .placeholder = "TEXT",
          .help = "only the group of that name, or else the groups and cases whose name holds TEXT" },
        nook_option_row_flag("list", &settings.list,
                             "print what must hold, why the bound is what it is, and the limits; run nothing"),
        nook_option_row_flag("quick", &settings.quick, "fewer samples of the same cases, as the tests take"),
        nook_option_row_json_file(&settings.out),
        nook_option_row_json(&settings.json, "print that JSON instead of the table"),
        nook_option_row_backend(&settings.backend),
    };
    const nook_usage usage = {
        .command = "extremes",
        .summary = "Runs the cases at the edge: scale, distance, matrices, inputs that are wrong. Each says what must\n"
                   "hold, measures it, and compares that with its bound.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details = "The last line is the summary. Exit code 0 only when every case that ran holds.\n"
                   "What each case is for, and the limits: docs/measuring.md, Extremes.\n",
    };
    nook_arguments arguments;
    int exit_code;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, &exit_code))
        return exit_code;
    if (nook_extreme_count(settings.only) == 0) {
        fprintf(stderr, "nook: extremes: no case's name holds \"%s\"; --list names them\n", settings.only);
        return NOOK_EXIT_USAGE;
    }
    if (settings.list) {
        nook_extreme_print_list(stdout, settings.only);
        return NOOK_EXIT_OK;
    }
    return nook_findings_with_device(app, settings.backend, settings.out, run_on, &settings);
}
