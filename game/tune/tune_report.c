#include "game/tune/tune_report.h"
#include "engine/core/file.h"
#include "engine/core/json.h"
#include "engine/core/log.h"
#include "game/measure/measure_origin.h"
#include "game/settings/settings_file.h"
#include "modules/ao/technique.h"
#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static const double percent = 100.0;

nook_result nook_tune_report_prepare(const char *path)
{
    char probe[NOOK_TUNE_PATH_MAX + 16];
    if (nook_directory_exists(path))
        return nook_fail(NOOK_E_IO, "%s: a directory; give --out the name of a file", path);
    snprintf(probe, sizeof probe, "%s.probe", path);
    int reason = nook_file_try_write(probe, "", 0);
    if (reason != 0)
        return nook_fail(NOOK_E_IO, "%s: cannot write: %s", path, strerror(reason));
    unlink(probe);
    return NOOK_OK;
}

/* "error 0.05 and 20 ms" */
static const char *print_goal(const nook_tune_goal *goal, char out[96])
{
    char error[40] = "", ms[40] = "";
    if (goal->max_error > 0.0)
        snprintf(error, sizeof error, "error %g", goal->max_error);
    if (goal->max_ms > 0.0)
        snprintf(ms, sizeof ms, "%g ms", goal->max_ms);
    snprintf(out, 96, "%s%s%s", error, *error && *ms ? " and " : "", ms);
    return out;
}

/* ---- The settings file -------------------------------------------------------------------------------------------- */

nook_result nook_tune_report_write(const nook_tune_result *result, const nook_tune_options *options,
                                   const nook_stage *stage)
{
    const nook_tune_estimate *predicted = &result->outcome.estimate, *actual = &result->actual;
    nook_settings_file file = { .setting = result->outcome.best.setting, .r_max = result->r_max };
    char comment[2048], date[NOOK_ORIGIN_DATE_SIZE], machine[NOOK_ORIGIN_MACHINE_SIZE], goal[96];
    snprintf(file.falloff, sizeof file.falloff, "%s", result->falloff);
    snprintf(comment, sizeof comment,
             "Nook settings, found by ./nook tune %.512s\n"
             "date       %s\n"
             "machine    %s\n"
             "budget     %s at %d x %d pixels\n"
             "predicted  error %.4g +- %.2g, %.4g ms (%u cameras)\n"
             "held back  error %.4g +- %.2g, %.4g ms (%u other cameras): %+.1f %%\n"
             "tried      %u of %.0f settings\n"
             "use        ./nook compare SCENE --settings FILE\n\n",
             nook_path_name(options->scene), nook_origin_date(date), nook_origin_machine(stage->gpu, machine),
             print_goal(&options->goal, goal), options->size.width, options->size.height, predicted->cost.error,
             predicted->error_standard, predicted->cost.ms, predicted->views, actual->cost.error,
             actual->error_standard, actual->cost.ms, actual->views, percent * result->difference,
             result->outcome.tried, result->settings);
    return nook_settings_file_write(options->out, &file, comment);
}

/* ---- Text --------------------------------------------------------------------------------------------------------- */

static void print_found(const nook_tune_result *result, FILE *stream)
{
    const nook_tune_estimate *predicted = &result->outcome.estimate, *actual = &result->actual;
    fprintf(stream, "%-10s %22s %22s %12s\n", "", "predicted", "held-back cameras", "difference");
    fprintf(stream, "%-10s %11.4f +- %.4f   %11.4f +- %.4f   %+10.1f %% (standard error %.1f %%)\n", "error",
            predicted->cost.error, predicted->error_standard, actual->cost.error, actual->error_standard,
            percent * result->difference, percent * result->difference_standard);
    fprintf(stream, "%-10s %11.2f %22.2f   %+18.1f %%\n", "ms", predicted->cost.ms, actual->cost.ms,
            percent * (actual->cost.ms / predicted->cost.ms - 1.0));
    fprintf(stream, "%-10s %11u %22u\n\n", "cameras", predicted->views, actual->views);
}

/* What a reader should know before he trusts the numbers. */
static void print_doubts(const nook_tune_result *result, const nook_tune_options *options, FILE *stream)
{
    if (2.0 * result->difference_standard > NOOK_TUNE_TOLERANCE)
        fprintf(stream,
                "The views differ so much that two sets of %u can differ by %.0f %% by chance; more: --cameras N\n",
                result->actual.views, percent * 2.0 * result->difference_standard);
    if (!result->holds)
        fprintf(stream,
                "The error on the held-back cameras is %+.1f %% off the predicted one, over the %.0f %% that "
                "are allowed: nothing is written.\n",
                percent * result->difference, percent * NOOK_TUNE_TOLERANCE);
    if (options->goal.max_error > 0.0 && result->actual.cost.error > options->goal.max_error)
        fprintf(stream, "On the held-back cameras the error is %.1f %% over the budget.\n",
                percent * (result->actual.cost.error / options->goal.max_error - 1.0));
    if (options->goal.max_ms > 0.0 && result->actual.cost.ms > options->goal.max_ms)
        fprintf(stream, "On the held-back cameras the time is %.1f %% over the budget.\n",
                percent * (result->actual.cost.ms / options->goal.max_ms - 1.0));
    if (fabs(log(result->actual.cost.ms / result->outcome.estimate.cost.ms)) > log(1.0 + NOOK_TUNE_TOLERANCE))
        fprintf(stream, "The times differ by more than %.0f %%: was the machine busy with other things?\n",
                percent * NOOK_TUNE_TOLERANCE);
    if (result->noise_worst > 0.5 * result->outcome.estimate.cost.error)
        fprintf(stream, "The truth's own noise is up to %.4f and was subtracted; less of it: --reference-rays N\n",
                result->noise_worst);
}

void nook_tune_report_print(const nook_tune_result *result, const nook_tune_options *options, FILE *stream)
{
    const nook_tune_outcome *outcome = &result->outcome;
    const nook_tune_cost *cost = &outcome->estimate.cost;
    char text[NOOK_SETTING_TEXT_MAX], goal[96];
    nook_setting_print(&outcome->best.setting, text);
    print_goal(&options->goal, goal);
    if (outcome->fits) {
        fprintf(stream, "%s\n\n", text);
        print_found(result, stream);
        print_doubts(result, options, stream);
        if (result->holds)
            fprintf(stream, "Written: %s\n", options->out);
        fprintf(stream, "%s: ", text);
    } else {
        fprintf(stream, "nothing within %s; nearest %s: ", goal, text);
    }
    fprintf(stream, "error %.4f, %.2f ms", cost->error, cost->ms);
    if (outcome->fits)
        fprintf(stream, "; held back %.4f (%+.1f %%), %.2f ms", result->actual.cost.error, percent * result->difference,
                result->actual.cost.ms);
    fprintf(stream, "; %u of %.0f settings tried, %.0f s\n", outcome->tried, result->settings, result->seconds);
}

/* ---- JSON --------------------------------------------------------------------------------------------------------- */

static void write_estimate(nook_json *json, const char *key, const nook_tune_estimate *estimate)
{
    nook_json_key(json, key);
    nook_json_begin_object(json);
    nook_json_member_number(json, "error", estimate->cost.error);
    nook_json_member_number(json, "error_standard_error", estimate->error_standard);
    nook_json_member_number(json, "ms", estimate->cost.ms);
    nook_json_member_integer(json, "cameras", estimate->views);
    nook_json_end_object(json);
}

static void write_limit(nook_json *json, const char *key, double limit)
{
    nook_json_member_number(json, key, limit > 0.0 ? limit : NAN); /* null: none */
}

nook_result nook_tune_report_print_json(const nook_tune_result *result, const nook_tune_options *options,
                                        const nook_stage *stage, FILE *stream)
{
    nook_json json = { 0 };
    char text[NOOK_SETTING_TEXT_MAX], machine[NOOK_ORIGIN_MACHINE_SIZE];
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "scene", options->scene);
    nook_json_member_string(&json, "machine", nook_origin_machine(stage->gpu, machine));
    nook_json_key(&json, "size");
    nook_json_numbers(&json, (double[]){ options->size.width, options->size.height }, 2);
    nook_json_member_number(&json, "r_max", result->r_max);
    nook_json_member_string(&json, "falloff", result->falloff);
    write_limit(&json, "max_error", options->goal.max_error);
    write_limit(&json, "max_ms", options->goal.max_ms);
    nook_json_member_bool(&json, "fits", result->outcome.fits);
    nook_json_member_string(&json, "setting", nook_setting_print(&result->outcome.best.setting, text));
    write_estimate(&json, "predicted", &result->outcome.estimate);
    if (result->outcome.fits) {
        write_estimate(&json, "held_back", &result->actual);
        nook_json_member_number(&json, "difference", result->difference);
        nook_json_member_number(&json, "difference_standard_error", result->difference_standard);
    }
    nook_json_member_bool(&json, "holds", result->holds);
    nook_json_member_number(&json, "truth_noise", result->noise_worst);
    nook_json_member_integer(&json, "tried", result->outcome.tried);
    nook_json_member_integer(&json, "measurements", result->outcome.measurements);
    nook_json_member_number(&json, "settings", result->settings);
    nook_json_member_number(&json, "seconds", result->seconds);
    nook_json_end_object(&json);
    nook_result printed = nook_json_print(&json, stream);
    nook_json_free(&json);
    return printed;
}
