#include "engine/core/file.h"
#include "game/compare/report.h"
#include <math.h>

static void print_number(FILE *stream, int width, const char *format, double value)
{
    char text[32] = "-";
    if (isfinite(value))
        snprintf(text, sizeof text, format, value);
    fprintf(stream, " %*s", width, text);
}

static void print_row(FILE *stream, const nook_compare_row *row, const nook_second_view *second)
{
    fprintf(stream, "%-12s", row->technique->name);
    print_number(stream, 10, "%.1f", row->ms_median);
    print_number(stream, 10, "%.1f", row->ms_min);
    print_number(stream, 10, "%.1f", row->ms_max);
    if (!row->technique->exact) {
        print_number(stream, 8, "%.4f", row->errors.rmse);
        print_number(stream, 8, "%.4f", row->errors.mae);
        print_number(stream, 8, "%+.4f", row->errors.bias);
        print_number(stream, 8, "%.4f", row->errors.p99);
        print_number(stream, 8, "%.4f", row->errors.max);
        print_number(stream, 8, "%.1f", row->fetches_per_pixel);
    } else if (second->measured) {
        fprintf(stream, "%*s", 6 * (8 + 1), "");
    }
    if (second->measured) {
        print_number(stream, 8, "%.4f", row->instability.rms);
        print_number(stream, 8, "%.3f", row->instability.relative);
    }
    fputc('\n', stream);
}

static void print_live_scene(const nook_live_scene *live, FILE *stream)
{
    fprintf(stream, "one live volume of %u x %u x %u voxels, %.1f MB, made anew when something moves\n", live->size[0],
            live->size[1], live->size[2], (double)live->size[0] * live->size[1] * live->size[2] * 1e-6);
}

static void print_volumes(const nook_report *report, FILE *stream)
{
    const nook_live_scene *live = nook_game_world_live_scene(report->stage->world);
    uint32_t count, cached = 0;
    uint64_t bytes = 0;
    double ms = 0.0;
    if (live->volume.id) {
        print_live_scene(live, stream);
        return;
    }
    const nook_world_volume *volumes = nook_game_world_volumes(report->stage->world, &count);
    for (uint32_t i = 0; i < count; i++) {
        nook_world_bake bakes = nook_world_volume_sum(&volumes[i], NOOK_WORLD_EVERY_KIND);
        bytes += bakes.bytes;
        cached += bakes.cached;
        ms += bakes.ms;
    }
    fprintf(stream, "%u volumes, %.1f MB", count, (double)bytes * 1e-6);
    if (cached < count)
        fprintf(stream, ", %u baked in %.0f ms", count - cached, ms);
    fprintf(stream, "%s%s\n", cached == count ? ", all from the cache" : "",
            report->stage->plan.mode == NOOK_PLAN_OFF ? "" : ", planned (./nook plan says why)");
}

static void print_second(const nook_second_view *second, FILE *stream)
{
    if (!second->measured)
        return;
    if (second->shared == 0) {
        fputs("Unsteady: no overlap, no camera to the side sees any of the same points.\n", stream);
        return;
    }
    fprintf(stream,
            "Unsteady: RMS change at the %llu points that a camera %g degrees to the %s sees too; relative: 1 = "
            "unrelated.\n",
            (unsigned long long)second->shared, fabs(second->degrees), second->degrees > 0.0 ? "right" : "left");
}

void nook_report_print_table(const nook_report *report, FILE *stream)
{
    const nook_comparison *comparison = report->comparison;
    char r_max[64], falloff[64];
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    const nook_ao *ao = report->stage->ao;
    fprintf(stream, "%s, %u x %u, camera %s, r_max %s m, falloff %s\n%s\n", nook_path_name(report->scene_path),
            comparison->width, comparison->height, comparison->camera,
            nook_report_param(ao, "ao", nook_param_find(params, count, "r_max"), r_max, sizeof r_max),
            nook_report_param(ao, "ao", nook_param_find(params, count, "falloff"), falloff, sizeof falloff),
            report->stage->gpu->renderer);
    print_volumes(report, stream);
    fprintf(stream, "\n%-12s %10s %10s %10s %8s %8s %8s %8s %8s %8s%s\n", "technique", "ms median", "min", "max",
            "RMSE", "MAE", "bias", "99 %", "largest", "fetches",
            comparison->second.measured ? " unsteady relative" : "");
    for (uint32_t i = 0; i < comparison->row_count; i++)
        print_row(stream, &comparison->rows[i], &comparison->second);
    fprintf(stream, "\nErrors of visibility against the reference; bias + is too bright. Pictures: %s/compare.png\n",
            report->out);
    print_second(&comparison->second, stream);
}
