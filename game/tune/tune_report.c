#include "game/tune/tune_report.h"
#include "engine/core/file.h"
#include "engine/core/json.h"
#include "engine/core/log.h"
#include "game/measure/measure_origin.h"
#include "game/settings/settings_file.h"
#include "modules/ao/technique.h"
#include <math.h>
#include <string.h>

static const double percent = 100.0;

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
    const nook_tune_estimate *predicted = &result->predicted, *actual = &result->actual;
    nook_settings_file file = { .setting = result->outcome.best.setting, .r_max = result->r_max };
    char comment[2048], date[NOOK_ORIGIN_DATE_SIZE], machine[NOOK_ORIGIN_MACHINE_SIZE], goal[96];
    snprintf(file.falloff, sizeof file.falloff, "%s", result->falloff);
    snprintf(comment, sizeof comment,
             "Nook settings, found by ./nook tune %.512s\n"
             "date       %s\n"
             "machine    %s\n"
             "budget     %s at %d x %d pixels\n"
             "predicted  error %.4g +- %.2g, %.4g ms (%u cameras)\n"
             "held back  error %.4g +- %.2g, %.4g ms (%u other cameras): %+.1f +- %.1f %%\n"
             "tried      %u of %.0f settings\n"
             "use        ./nook compare SCENE --settings FILE\n\n",
             nook_path_name(options->scene), nook_origin_date(date), nook_origin_machine(stage->gpu, machine),
             print_goal(&options->goal, goal), options->size.width, options->size.height, predicted->cost.error,
             predicted->error_standard, predicted->cost.ms, predicted->views, actual->cost.error,
             actual->error_standard, actual->cost.ms, actual->views, percent * result->difference,
             percent * result->difference_standard, result->outcome.tried, result->settings);
    return nook_settings_file_write(options->out, &file, comment);
}

/* ---- Text --------------------------------------------------------------------------------------------------------- */

static const char *over(double value, double limit)
{
    return limit > 0.0 && value > limit ? "  over budget" : "";
}

static void print_found(const nook_tune_result *result, const nook_tune_goal *goal, FILE *stream)
{
    const nook_tune_estimate *predicted = &result->predicted, *actual = &result->actual;
    fprintf(stream, "%-10s %22s %22s %12s\n", "", "predicted", "held-back cameras", "difference");
    fprintf(stream, "%-10s %11.4f +- %.4f   %11.4f +- %.4f   %+10.1f %% (standard error %.1f %%)%s\n", "error",
            predicted->cost.error, predicted->error_standard, actual->cost.error, actual->error_standard,
            percent * result->difference, percent * result->difference_standard,
            over(actual->cost.error, goal->max_error));
    fprintf(stream, "%-10s %11.2f +- %-6.2f   %11.2f +- %-6.2f   %+10.1f %% (+-: of its own turns)%s\n", "ms",
            predicted->cost.ms, predicted->ms_spread, actual->cost.ms, actual->ms_spread,
            percent * (actual->cost.ms / predicted->cost.ms - 1.0),
            over(fmax(actual->cost.ms, predicted->cost.ms), goal->max_ms));
    fprintf(stream, "%-10s %11u %22u\n", "cameras", predicted->views, actual->views);
    fprintf(
        stream,
        "Held back: the other one of each pair of near views, none of them used to choose. They show that the setting\n"
        "does in such views what it did where it was chosen; not what it does in views of another kind. The predicted\n"
        "error is that of the best of %u settings, so rather too small; its ms were taken afresh.\n\n",
        result->outcome.tried);
}

/* Why nothing is written, and what to do. */
static void print_failures(const nook_tune_result *result, const nook_tune_goal *goal, FILE *stream)
{
    const nook_tune_estimate *actual = &result->actual;
    if (!result->near)
        fprintf(stream,
                "The error on the held-back cameras is %+.1f %% off the predicted one, over the %.0f %% that "
                "are allowed: nothing is written; give more --cameras.\n",
                percent * result->difference, percent * NOOK_TUNE_TOLERANCE);
    if (!result->error_holds)
        fprintf(
            stream,
            "The error on the held-back cameras is %.1f %% over the budget, more than its standard error of %.1f %%: "
            "nothing is written; give a smaller --max-error or more --cameras.\n",
            percent * (actual->cost.error / goal->max_error - 1.0), percent * actual->error_standard / goal->max_error);
    if (!result->ms_holds)
        fprintf(stream,
                "The time is over the budget of %g ms by more than its own frames differ: nothing is written; give a "
                "smaller --max-ms, or an idle machine.\n",
                goal->max_ms);
}

/* What a reader should know before he trusts the numbers. */
static void print_doubts(const nook_tune_result *result, FILE *stream)
{
    const nook_tune_estimate *predicted = &result->predicted;
    if (2.0 * result->difference_standard > NOOK_TUNE_TOLERANCE)
        fprintf(stream,
                "The views differ so much that sets of %u and %u can differ by %.0f %% by chance; more: --cameras N\n",
                predicted->views, result->actual.views, percent * 2.0 * result->difference_standard);
    if (fabs(nook_tune_log_ratio(result->actual.cost.ms, predicted->cost.ms)) > log(1.0 + NOOK_TUNE_TOLERANCE))
        fprintf(stream, "The times differ by more than %.0f %%: was the machine busy with other things?\n",
                percent * NOOK_TUNE_TOLERANCE);
    if (fmax(predicted->noise, result->actual.noise) > NOOK_TUNE_TRUTH_NOISE * predicted->cost.error)
        fprintf(stream,
                "The truth's own noise is %.4f, over a quarter of the error, and was subtracted; less of it: "
                "--reference-rays N\n",
                fmax(predicted->noise, result->actual.noise));
    if (!result->outcome.settled)
        fprintf(stream,
                "To the last, others promised more that did not hold in more views: there may be better ones.\n");
}

static void print_proof(const nook_tune_result *result, const nook_tune_options *options, const char *setting,
                        FILE *stream)
{
    fprintf(stream, "%s\n\n", setting);
    print_found(result, &options->goal, stream);
    print_doubts(result, stream);
    print_failures(result, &options->goal, stream);
    if (result->holds)
        fprintf(stream, "Written: %s\n", options->out);
}

/* What was measured in one view has no standard error. */
static const char *print_standard(const char *format, double standard, char out[32])
{
    if (!isfinite(standard))
        return "unknown";
    snprintf(out, 32, format, standard);
    return out;
}

void nook_tune_report_print(const nook_tune_result *result, const nook_tune_options *options, FILE *stream)
{
    const nook_tune_outcome *outcome = &result->outcome;
    const nook_tune_estimate *predicted = &result->predicted;
    char text[NOOK_SETTING_TEXT_MAX], goal[96], error[32], ms[32];
    nook_setting_print(&outcome->best.setting, text);
    print_goal(&options->goal, goal);
    if (outcome->fits)
        print_proof(result, options, text, stream);
    if (outcome->fits)
        fprintf(stream, "%s%s: ", result->holds ? "" : "not proven: ", text);
    else
        fprintf(stream, "nothing within %s; nearest %s: ", goal, text);
    fprintf(stream, "error %.4f, %.2f ms", predicted->cost.error, predicted->cost.ms);
    if (outcome->fits)
        fprintf(stream, "; held back %.4f (%+.1f %% +- %.1f %%), %.2f ms", result->actual.cost.error,
                percent * result->difference, percent * result->difference_standard, result->actual.cost.ms);
    else
        fprintf(stream, " (+- %s and %s, which must be within too)",
                print_standard("%.4f", predicted->error_standard, error),
                print_standard("%.2f", predicted->ms_standard, ms));
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
    nook_json_member_number(json, "ms_standard_error", estimate->ms_standard);
    nook_json_member_number(json, "ms_spread", estimate->ms_spread);
    nook_json_member_number(json, "truth_noise", estimate->noise);
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
    write_estimate(&json, "predicted", &result->predicted);
    if (result->outcome.fits) {
        write_estimate(&json, "held_back", &result->actual);
        nook_json_member_number(&json, "difference", result->difference);
        nook_json_member_number(&json, "difference_standard_error", result->difference_standard);
        nook_json_member_number(&json, "ms_chosen_by", result->outcome.estimate.cost.ms);
        nook_json_member_bool(&json, "error_holds", result->error_holds);
        nook_json_member_bool(&json, "ms_holds", result->ms_holds);
    }
    nook_json_member_bool(&json, "holds", result->holds);
    nook_json_member_bool(&json, "settled", result->outcome.settled);
    nook_json_member_integer(&json, "tried", result->outcome.tried);
    nook_json_member_integer(&json, "measurements", result->outcome.measurements);
    nook_json_member_number(&json, "settings", result->settings);
    nook_json_member_number(&json, "seconds", result->seconds);
    nook_json_end_object(&json);
    nook_result printed = nook_json_print(&json, stream);
    nook_json_free(&json);
    return printed;
}
