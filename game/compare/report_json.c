#include "engine/core/angle.h"
#include "engine/core/json.h"
#include "engine/core/log.h"
#include "game/compare/report.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double param_value(const nook_ao *ao, const char *technique, const nook_param *param)
{
    char name[128];
    double value = NAN;
    snprintf(name, sizeof name, "%s.%s", technique, param->name);
    nook_ao_get_param(ao, name, &value);
    return value;
}

const char *nook_report_param(const nook_ao *ao, const char *technique, const nook_param *param, char *out,
                              size_t capacity)
{
    return nook_param_print_value(param, param_value(ao, technique, param), out, capacity);
}

static void write_param(nook_json *json, const nook_ao *ao, const char *technique, const nook_param *param)
{
    char text[64];
    if (param->type == NOOK_PARAM_CHOICE) {
        nook_json_member_string(json, param->name, nook_report_param(ao, technique, param, text, sizeof text));
        return;
    }
    nook_json_key(json, param->name);
    if (param->type == NOOK_PARAM_FLOAT)
        nook_json_float(json, (float)param_value(ao, technique, param));
    else
        nook_json_integer(json, (int64_t)param_value(ao, technique, param));
}

static void write_params(nook_json *json, const char *key, const nook_ao *ao, const char *technique,
                         const nook_param *params, size_t count)
{
    nook_json_key(json, key);
    nook_json_begin_object(json);
    for (size_t i = 0; i < count; i++)
        write_param(json, ao, technique, &params[i]);
    nook_json_end_object(json);
}

static void write_errors(nook_json *json, const nook_errors *errors)
{
    nook_json_member_number(json, "rmse", errors->rmse);
    nook_json_member_number(json, "mae", errors->mae);
    nook_json_member_number(json, "bias", errors->bias);
    nook_json_member_number(json, "p99", errors->p99);
    nook_json_member_number(json, "max", errors->max);
    nook_json_member_integer(json, "non_finite", (int64_t)errors->non_finite);
}

static void write_instability(nook_json *json, const nook_instability *instability)
{
    nook_json_member_number(json, "instability", instability->rms);
    nook_json_member_number(json, "instability_relative", instability->relative);
    nook_json_member_integer(json, "instability_pixels", (int64_t)instability->pixels);
}

static void write_row(nook_json *json, const nook_report *report, const nook_compare_row *row)
{
    nook_json_begin_object(json);
    nook_json_member_string(json, "name", row->technique->name);
    nook_json_member_number(json, "ms_median", row->ms_median);
    nook_json_member_number(json, "ms_min", row->ms_min);
    nook_json_member_number(json, "ms_max", row->ms_max);
    if (!isnan(row->gpu_ms_median))
        nook_json_member_number(json, "gpu_ms_median", row->gpu_ms_median);
    nook_json_member_integer(json, "frames", row->frames);
    if (!row->technique->exact) {
        write_errors(json, &row->errors);
        nook_json_member_number(json, "texture_fetches_per_pixel", row->fetches_per_pixel);
    }
    if (report->comparison->second.measured)
        write_instability(json, &row->instability);
    write_params(json, "params", report->stage->ao, row->technique->name, row->technique->params,
                 row->technique->param_count);
    nook_json_end_object(json);
}

static void write_camera(nook_json *json, const nook_report *report)
{
    const nook_camera *camera = &report->stage->frame.camera;
    nook_json_key(json, "camera");
    nook_json_begin_object(json);
    nook_json_member_string(json, "name", report->comparison->camera);
    nook_json_member_number(json, "fov_y_degrees", camera->fov_y_radians * 180.0 / NOOK_PI);
    nook_json_member_number(json, "z_near", camera->z_near);
    nook_json_key(json, "view_from_world");
    nook_json_numbers(json, camera->view_from_world.m, 16);
    nook_json_end_object(json);
}

static void write_second_camera(nook_json *json, const nook_second_view *second)
{
    if (!second->measured)
        return;
    nook_json_key(json, "second_camera");
    nook_json_begin_object(json);
    nook_json_member_number(json, "turn_degrees", second->degrees);
    nook_json_member_number(json, "turn_distance", second->distance);
    nook_json_key(json, "view_from_world");
    nook_json_numbers(json, second->camera.view_from_world.m, 16);
    nook_json_end_object(json);
}

static void write_volumes(nook_json *json, const nook_game_world *world)
{
    uint32_t count;
    const nook_world_volume *volumes = nook_game_world_volumes(world, &count);
    nook_json_key(json, "volumes");
    nook_json_begin_array(json);
    for (uint32_t i = 0; i < count; i++) {
        const double dimensions[] = { volumes[i].width, volumes[i].height, volumes[i].depth };
        const nook_world_bake bakes = nook_world_volume_sum(&volumes[i], NOOK_WORLD_EVERY_KIND);
        nook_json_begin_object(json);
        nook_json_member_string(json, "name", volumes[i].name);
        nook_json_key(json, "dimensions");
        nook_json_numbers(json, dimensions, 3);
        nook_json_member_number(json, "voxel_size", volumes[i].voxel_size);
        nook_json_member_integer(json, "bytes", (int64_t)bakes.bytes);
        nook_json_member_integer(json, "instances", volumes[i].instances);
        nook_json_member_number(json, "bake_ms", bakes.ms);
        nook_json_member_bool(json, "cached", bakes.cached);
        nook_json_end_object(json);
    }
    nook_json_end_array(json);
}

/* Nothing of what stands in "volumes" was baked then. */
static void write_live_scene(nook_json *json, const nook_live_scene *live)
{
    const double dimensions[] = { live->size[0], live->size[1], live->size[2] };
    if (!live->volume.id)
        return;
    nook_json_key(json, "live_volume");
    nook_json_begin_object(json);
    nook_json_key(json, "dimensions");
    nook_json_numbers(json, dimensions, 3);
    nook_json_member_number(json, "voxel_size", live->voxel_size);
    nook_json_end_object(json);
}

static void write_shared(nook_json *json, const nook_ao *ao)
{
    size_t count;
    const nook_param *params = nook_ao_shared_params(&count);
    write_param(json, ao, "ao", nook_param_find(params, count, "r_max"));
    write_param(json, ao, "ao", nook_param_find(params, count, "falloff"));
    write_params(json, "shared_params", ao, "ao", params, count);
}

/* What was asked of the planner, where anything was. */
static void write_plan(nook_json *json, const nook_plan_params *plan)
{
    size_t count;
    char mode[32];
    const nook_param *rows = nook_plan_param_table(&count);
    if (plan->mode == NOOK_PLAN_OFF)
        return;
    nook_json_key(json, "plan");
    nook_json_begin_object(json);
    for (size_t i = 0; i < count; i++) {
        if (rows[i].type == NOOK_PARAM_CHOICE)
            nook_json_member_string(json, rows[i].name, nook_param_print(&rows[i], plan, mode, sizeof mode));
        else
            nook_json_member_number(json, rows[i].name, nook_param_get(&rows[i], plan));
    }
    nook_json_end_object(json);
}

static void write_all(nook_json *json, const nook_report *report)
{
    const nook_comparison *comparison = report->comparison;
    const double size[] = { comparison->width, comparison->height };
    nook_json_begin_object(json);
    nook_json_member_string(json, "scene", report->scene_path);
    if (report->stage->moment.timed || report->stage->moment.clip) {
        if (report->stage->moment.clip)
            nook_json_member_string(json, "clip", report->stage->moment.clip);
        nook_json_member_number(json, "time", report->stage->moment.seconds);
    }
    nook_json_key(json, "size");
    nook_json_numbers(json, size, 2);
    write_camera(json, report);
    write_second_camera(json, &comparison->second);
    write_shared(json, report->stage->ao);
    nook_json_member_string(json, "renderer", report->stage->gpu->renderer);
    nook_json_member_integer(json, "triangles", (int64_t)report->stage->scene->triangle_count);
    nook_json_member_integer(json, "pixels_with_geometry", (int64_t)comparison->rows[0].errors.count);
    write_plan(json, &report->stage->plan);
    write_volumes(json, report->stage->world);
    write_live_scene(json, nook_game_world_live_scene(report->stage->world));
    nook_json_key(json, "reference");
    write_row(json, report, &comparison->rows[0]);
    nook_json_key(json, "techniques");
    nook_json_begin_array(json);
    for (uint32_t i = 1; i < comparison->row_count; i++)
        write_row(json, report, &comparison->rows[i]);
    nook_json_end_array(json);
    nook_json_end_object(json);
}

nook_result nook_report_json(const nook_report *report, char **out_text, size_t *out_size)
{
    nook_json json = { 0 };
    const char *text;
    size_t size;
    write_all(&json, report);
    nook_result result = nook_json_finish(&json, &text, &size);
    char *copy = result == NOOK_OK ? malloc(size + 1) : NULL;
    if (copy) {
        memcpy(copy, text, size + 1);
        *out_text = copy;
        *out_size = size;
    } else if (result == NOOK_OK) {
        result = nook_fail(NOOK_E_MEMORY, "no memory for the report");
    }
    nook_json_free(&json);
    return result;
}
