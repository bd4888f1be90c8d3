#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/platform/context.h"
#include "game/commands/commands.h"
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
    const char *text;
    size_t size;
    nook_verify_write_json(&json, rows, gpu->renderer, seconds);
    nook_result result = nook_json_finish(&json, &text, &size);
    if (result == NOOK_OK && options->out)
        result = nook_file_write(options->out, text, size);
    if (result == NOOK_OK && options->json)
        result = nook_json_print(&json, stdout);
    nook_json_free(&json);
    if (result == NOOK_OK && !options->json) {
        nook_verify_print_notes(stdout, rows);
        nook_verify_print_summary(stdout, rows, seconds);
    }
    return result;
}

static nook_result run_on(const verify_options *options, nook_verify_desc *desc, bool *out_hold)
{
    table printed = { .begun = false };
    nook_verify_rows rows = { 0 };
    double started = nook_clock_ms();
    if (!options->json) {
        rows.listener = (nook_verify_listener){ print_row, &printed };
        nook_verify_print_head(stdout);
    }
    nook_result result = nook_verify_run(desc, &rows);
    if (result == NOOK_OK)
        result = report(options, desc->gpu, &rows, (nook_clock_ms() - started) / 1000.0);
    nook_verify_summary sum = nook_verify_summarize(&rows);
    *out_hold = sum.verdicts[NOOK_VERDICT_OFF] == 0 && sum.checks > 0;
    nook_verify_rows_free(&rows);
    return result;
}

static int run_with_device(const nook_app *app, const verify_options *options, nook_verify_desc *desc)
{
    bool hold = false;
    nook_context *context;
    const nook_context_desc context_desc = { .backend = options->backend };
    if (nook_context_create(&context_desc, &context) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    const nook_gpu_desc gpu_desc = { nook_context_get_proc(context), app->root, .log_debug_output = true };
    nook_result result = nook_gpu_create(&gpu_desc, &desc->gpu);
    if (result == NOOK_OK)
        result = run_on(options, desc, &hold);
    nook_gpu_destroy(desc->gpu);
    nook_context_destroy(context);
    return result == NOOK_OK && hold ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
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
        { .name = "rays",
          .kind = NOOK_OPTION_INT,
          .target = &out_settings->rays,
          .placeholder = "N",
          .lowest = 1,
          .highest = 4096,
          .help = "for techniques that trace rays; default: what the claims are made for" },
        { .name = "quick",
          .kind = NOOK_OPTION_FLAG,
          .target = &out_settings->quick,
          .help = "every fixture at fewer points of its parameters" },
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
    nook_verify_desc desc = { .rays = (uint32_t)settings.rays, .quick = settings.quick };
    char fixtures[1024];
    if (nook_verify_choose_techniques(settings.techniques, &desc) != NOOK_OK ||
        nook_verify_choose_fixtures(settings.fixtures, &desc, fixtures, sizeof fixtures) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    return run_with_device(app, &settings, &desc);
}
