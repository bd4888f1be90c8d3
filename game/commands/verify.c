#include "engine/core/clock.h"
#include "game/commands/commands.h"
#include "game/commands/findings.h"
#include "game/option_rows.h"
#include "game/verify/verify_report.h"
#include "game/verify/verify_run.h"
#include <string.h>

typedef struct verify_options {
    const char *techniques, *fixtures, *out;
    nook_backend backend;
    int32_t rays;
    bool json, quick;
} verify_options;

/** Each row as soon as it is known. */
typedef struct table {
    nook_verify_row before;
    bool begun;
} table;

static void print_row(void *user, const nook_verify_row *row)
{
    table *printed = user;
    nook_verify_print_row(stdout, row, printed->begun ? &printed->before : NULL);
    fflush(stdout);
    printed->before = *row, printed->begun = true;
}

static nook_result report(const verify_options *options, const nook_gpu *gpu, const nook_verify_rows *rows,
                          double seconds)
{
    nook_json json = { 0 };
    nook_verify_write_json(&json, rows, gpu->renderer, seconds);
    nook_result result = nook_findings_put_json(&json, options->out, options->json);
    if (!options->json) {
        nook_verify_print_notes(stdout, rows);
        nook_verify_print_summary(stdout, rows, seconds);
    }
    return result;
}

/* What is asked for. */
typedef struct verify_request {
    const verify_options *options;
    nook_verify_desc desc;
} verify_request;

static nook_result run_on(void *user, nook_gpu *gpu, bool *out_hold)
{
    verify_request *request = user;
    const verify_options *options = request->options;
    table printed = { .begun = false };
    nook_verify_rows rows = { 0 };
    double started = nook_clock_ms();
    if (!options->json) {
        rows.listener = (nook_verify_listener){ print_row, &printed };
        nook_verify_print_head(stdout);
    }
    request->desc.gpu = gpu;
    nook_result result = nook_verify_run(&request->desc, &rows);
    if (result == NOOK_OK)
        result = report(options, gpu, &rows, (nook_clock_ms() - started) / 1000.0);
    nook_verify_summary sum = nook_verify_summarize(&rows);
    *out_hold = sum.verdicts[NOOK_VERDICT_OFF] == 0 && sum.checks > 0;
    nook_verify_rows_free(&rows);
    return result;
}

/** @return false: *out_exit_code says how to end */
static bool read_options(int argc, char **argv, verify_options *out_settings, int *out_exit_code)
{
    const nook_option options[] = {
        nook_option_row_techniques(&out_settings->techniques, "which ones, and filter; default: all"),
        { .name = "fixtures",
          .kind = NOOK_OPTION_TEXT,
          .target = &out_settings->fixtures,
          .placeholder = "a,b,c",
          .help = "names (pit, wall, ...) or numbers of rows, 1 to 20; default: all" },
        nook_option_row_int("rays", &out_settings->rays, 1, 4096,
                            "for techniques that trace rays; default: what the claims are made for"),
        nook_option_row_flag("quick", &out_settings->quick, "every fixture at fewer points of its parameters"),
        nook_option_row_json_file(&out_settings->out),
        nook_option_row_json(&out_settings->json, "print that JSON instead of the table"),
        nook_option_row_backend(&out_settings->backend),
    };
    const nook_usage usage = {
        .command = "verify",
        .summary = "Holds every technique to closed forms: geometry made by code whose occlusion is known exactly.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "Verdicts: ok and off are checks of what the technique claims; unseen: the depth buffer does not hold "
            "what\n"
            "occludes; unresolved: it does, in too few pixels; not claimed: the technique does not say that it "
            "computes this.\n"
            "The last line is the summary. Exit code 0 only when nothing is off. See docs/measuring.md, Verify.\n",
    };
    nook_arguments arguments;
    return nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code);
}

int nook_command_verify(const nook_app *app, int argc, char **argv)
{
    verify_options settings = { .backend = NOOK_BACKEND_AUTO };
    int exit_code;
    if (!read_options(argc, argv, &settings, &exit_code))
        return exit_code;
    verify_request request = { &settings, { .rays = (uint32_t)settings.rays, .quick = settings.quick } };
    char fixtures[1024];
    if (nook_verify_choose_techniques(settings.techniques, &request.desc) != NOOK_OK ||
        nook_verify_choose_fixtures(settings.fixtures, &request.desc, fixtures, sizeof fixtures) != NOOK_OK)
        return NOOK_EXIT_USAGE;
    return nook_findings_with_device(app, settings.backend, settings.out, run_on, &request);
}
