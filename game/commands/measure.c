#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/command_line.h"
#include "game/commands/commands.h"
#include "game/interrupt.h"
#include "game/measure/measure_merge.h"
#include "game/measure/measure_options.h"
#include "game/measure/measure_origin.h"
#include "game/measure/measure_run.h"
#include "game/measure/measure_verdict.h"
#include "game/measure/report.h"
#include <stdio.h>
#include <string.h>

enum { COMMAND_CAPACITY = 2048 };

/* What is in the folder, and what other folders have to add. */
static nook_result gather(const nook_measure_options *options, const char *build, nook_journal *journal,
                          nook_results *results)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < options->merge.count && result == NOOK_OK; i++) {
        size_t taken = 0, left = 0;
        result = nook_measure_merge(options->merge.items[i], options->out, build, results, journal, &taken, &left);
        if (result == NOOK_OK)
            nook_log_info("%s: %zu rows taken in, %zu left out that are here already", options->merge.items[i], taken,
                          left);
    }
    size_t dropped = options->keep || options->tables ? 0 : nook_measure_drop_other_builds(results, build);
    if (dropped > 0)
        nook_log_info("%zu rows were measured by another build and do not count; --keep takes them", dropped);
    return result;
}

/* ---- Before the work ---------------------------------------------------------------------------------------------- */

/* What is to be measured. */
typedef struct plan {
    nook_scene_list scenes;
    nook_sweep sweep;
} plan;

static void free_plan(plan *p)
{
    nook_scene_list_free(&p->scenes);
    nook_sweep_free(&p->sweep);
}

static nook_result list_scenes(const nook_measure_options *options, nook_scene_list *list)
{
    nook_result result = NOOK_OK;
    for (int i = 0; i < options->scene_count && result == NOOK_OK; i++) {
        if (!nook_file_exists(options->scenes[i]))
            result = nook_fail(NOOK_E_NOT_FOUND, "%s: no such file; nothing was measured", options->scenes[i]);
        else
            result = nook_scene_list_add(list, options->scenes[i]);
    }
    if (result == NOOK_OK && options->scene_folder)
        result = nook_scene_list_add_folder(list, options->scene_folder);
    return result;
}

/* The settings of the sweep, with what --param says, and that of the settings file as it is. */
static nook_result read_sweep(nook_measure_options *options, nook_sweep *out)
{
    nook_result result = options->settings ? nook_settings_file_read(options->settings, &options->file) : NOOK_OK;
    if (result == NOOK_OK && (options->file.plan.mode != NOOK_PLAN_OFF || options->file.live))
        nook_log_warning("%s: its plan and live volumes are left out: what is measured is the technique",
                         options->settings);
    if (result == NOOK_OK)
        result = nook_sweep_read(options->sweep, out);
    for (size_t i = 0; i < options->params.count && result == NOOK_OK; i++)
        result = nook_sweep_param(out, options->params.items[i]);
    if (result == NOOK_OK && options->settings)
        result = nook_sweep_add(options->settings, out, &options->file.setting);
    return result;
}

/* All that can be wrong with paths, before hours of work: @param out  to be freed, also on failure */
static nook_result prepare(nook_measure_options *options, plan *out)
{
    nook_result result = options->document ? nook_report_document_check(options->document) : NOOK_OK;
    if (options->tables)
        return result;
    if (result == NOOK_OK)
        result = read_sweep(options, &out->sweep);
    return result == NOOK_OK ? list_scenes(options, &out->scenes) : result;
}

/* ---- The work ----------------------------------------------------------------------------------------------------- */

static void measure(const nook_app *app, const nook_measure_options *options, const plan *p, nook_measure_run *run)
{
    run->root = app->root;
    run->folder = options->out;
    run->cache = options->cache;
    run->backend = options->backend;
    run->sweep = &p->sweep;
    nook_measure_run_scenes(run, &p->scenes);
    run->sweep = NULL;
}

static nook_result write_all(const nook_app *app, const nook_measure_options *options, const char *command,
                             const nook_results *results)
{
    nook_result result = nook_results_write(results, options->out, command);
    if (result == NOOK_OK)
        result = nook_report_html_write(app->root, results, options->out, command);
    if (result == NOOK_OK && options->document)
        result = nook_report_document_write(results, command, options->document);
    return result;
}

/* The last line. @return whether the results can be believed */
static bool print_summary(const nook_measure_options *options, const nook_measure_run *run)
{
    nook_measure_verdict verdict = nook_measure_judge(run->results);
    bool holds = verdict.over == 0 && verdict.non_finite == 0 && verdict.outside == 0 && verdict.worst;
    if (verdict.over > 0)
        nook_log_warning("%zu rows have a truth whose noise is over a quarter of an error; raise rays_max",
                         verdict.over);
    printf("%s: %zu rows measured, %zu reused, %zu sites; ", options->out, run->progress.measured, run->reused,
           run->sites);
    if (verdict.worst)
        printf("noise of the truth at most %.3f of an error (%s of %s, %s, %.3g m: %s), %s a quarter; ",
               verdict.largest_part, verdict.worst_error, verdict.worst->scene, verdict.worst->camera,
               verdict.worst->r_max, verdict.worst->setting, verdict.over > 0 ? "over" : "everywhere under");
    if (run->failures > 0)
        printf("%zu scenes failed; ", run->failures);
    printf("%llu pixels not finite, %llu clamped\n", (unsigned long long)verdict.non_finite,
           (unsigned long long)verdict.outside);
    return holds;
}

static int run_measurement(const nook_app *app, const nook_measure_options *options, const plan *p, const char *command,
                           nook_measure_run *run)
{
    nook_interrupt_hold();
    nook_result result = nook_results_read(options->out, run->results);
    if (result == NOOK_OK)
        result = gather(options, run->build, run->journal, run->results);
    if (result == NOOK_OK && options->tables && run->results->row_count == 0)
        result = nook_fail(NOOK_E_NOT_FOUND,
                           "%s: nothing was measured into it yet; leave out --tables, or give --merge", options->out);
    bool ready = result == NOOK_OK;
    if (ready && !options->tables)
        measure(app, options, p, run);
    bool interrupted = nook_interrupt_asked();
    nook_interrupt_answer();
    if (ready)
        result = write_all(app, options, command, run->results);
    nook_interrupt_release();
    if (!ready)
        return NOOK_EXIT_FAILED;
    if (result == NOOK_OK && run->results->row_count > 0)
        printf("Report: %s/report.html\n", options->out);
    if (interrupted)
        nook_log_warning("interrupted; what was measured is kept, and the same command goes on from there");
    bool holds = print_summary(options, run); /* also when the tables could not be written */
    return result == NOOK_OK && holds && !interrupted && run->failures == 0 ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

static int open_and_run(const nook_app *app, const nook_measure_options *options, const plan *p, const char *command)
{
    char build[NOOK_ORIGIN_BUILD_SIZE];
    nook_results results = { 0 };
    nook_journal journal;
    if (nook_origin_build(app->root, build) != NOOK_OK || nook_journal_open(options->out, &journal) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    nook_measure_run run = { .build = build, .results = &results, .journal = &journal };
    int exit_code = run_measurement(app, options, p, command, &run);
    nook_journal_close(&journal);
    nook_results_free(&results);
    return exit_code;
}

int nook_command_measure(const nook_app *app, int argc, char **argv)
{
    nook_measure_options options;
    char command[COMMAND_CAPACITY];
    plan p = { 0 };
    int exit_code;
    if (!nook_measure_options_read(app, argc, argv, &options, &exit_code))
        return exit_code;
    exit_code = prepare(&options, &p) == NOOK_OK
                    ? open_and_run(app, &options, &p, nook_command_line_join(argc, argv, command, sizeof command))
                    : NOOK_EXIT_FAILED;
    free_plan(&p);
    return exit_code;
}
