#include "tests/support/results_fixture.h"
#include "engine/core/file.h"
#include "modules/measure/picture.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const techniques[] = { "volume", "gtao", "ssao" };

/* ---- pictures: a floor with a dark corner and a ball on it; a sky without geometry above ---- */

static double unit_noise(uint32_t seed)
{
    seed ^= seed >> 16;
    seed *= 0x7feb352du;
    seed ^= seed >> 15;
    seed *= 0x846ca68bu;
    seed ^= seed >> 16;
    return seed / 4294967296.0;
}

static bool has_geometry(double x, double y)
{
    return y > 0.2 + 0.1 * x;
}

double nook_results_fixture_visibility(uint32_t camera, uint32_t setting, double x, double y)
{
    double shift = 0.1 * camera, ball = hypot(x - 0.5 - shift, 1.4 * (y - 0.6));
    double truth = ball < 0.16 ? 0.95 - 1.5 * fmax(0.0, y - 0.55) : 0.3 + 0.7 * fmin(1.0, 2.0 * fmin(x, ball));
    if (setting == 0)
        return truth;
    double grain =
        0.2 * (unit_noise((uint32_t)(x * 4096.0) * 7919u + (uint32_t)(y * 4096.0) * 104729u + setting) - 0.5);
    return truth + 0.06 * sin(9.0 * x + setting) + grain / setting;
}

/* @param kind  'g' the mask, 's' the truth of the depth buffer, else visibility of the setting */
static void write_picture(const nook_results_fixture *fixture, const char *name, char kind, uint32_t camera,
                          uint32_t setting)
{
    char path[4096];
    nook_picture picture;
    if (nook_picture_create(fixture->width, fixture->height, &picture) != NOOK_OK)
        abort();
    for (uint32_t row = 0; row < fixture->height; row++) {
        for (uint32_t column = 0; column < fixture->width; column++) {
            double x = (column + 0.5) / fixture->width, y = (row + 0.5) / fixture->height;
            double value = nook_results_fixture_visibility(camera, setting, x, y);
            if (kind == 's')
                value = 0.5 + 0.5 * value;
            if (!has_geometry(x, y))
                value = kind == 'g' ? 0.0 : 1.0;
            else if (kind == 'g')
                value = 1.0;
            uint8_t grey = (uint8_t)lrint(255.0 * fmin(fmax(value, 0.0), 1.0));
            picture.pixels[row * fixture->width + column] = (nook_rgb){ grey, grey, grey };
        }
    }
    if (nook_picture_write_png(&picture, nook_path_join(path, sizeof path, fixture->folder, name)) != NOOK_OK)
        abort();
    nook_picture_free(&picture);
}

/* The name of a picture, written; "" without a folder. @return owned */
static char *make_picture(const nook_results_fixture *fixture, uint32_t scene, char kind, uint32_t camera,
                          uint32_t setting)
{
    char name[64];
    if (!fixture->folder)
        return strdup("");
    snprintf(name, sizeof name, "%u_%u_%c%u.png", scene, camera, kind, setting);
    write_picture(fixture, name, kind, camera, setting);
    return strdup(name);
}

/* ---- rows ---- */

static nook_errors make_errors(double rmse, double bias)
{
    return (nook_errors){ .count = 10000,
                          .valid = true,
                          .rmse = rmse,
                          .mae = 0.6 * rmse,
                          .bias = bias,
                          .p99 = fmin(1.0, 3.4 * rmse),
                          .max = fmin(1.0, 7.0 * rmse) };
}

static nook_sample make_sample(uint32_t technique, uint32_t setting, uint32_t camera, uint32_t scene)
{
    double effort = (1.0 + 0.7 * setting) * (0.9 + 0.2 * unit_noise(setting * 31u + technique)); /* of the setting */
    double floor = 0.012 + 0.035 * technique,
           rmse = hypot(floor, 0.06 / sqrt(effort)) * (1.0 + 0.15 * camera + 0.1 * scene);
    double ms = (technique == 0 ? 9.0 : 3.0) * effort, bias = (technique == 0 ? -0.2 : 0.7) * floor;
    return (nook_sample){
        .ms_median = ms,
        .ms_min = 0.93 * ms,
        .ms_max = 1.2 * ms,
        .gpu_ms_median = NAN,
        .frames = 7,
        .fetches = 12.0 * effort,
        .volume_bytes = technique == 0 ? 8.5e6 : 0.0,
        .texture_bytes = 4.2e6,
        .bake_ms = technique == 0 ? 2100.0 : 0.0,
        .truth = make_errors(rmse, bias),
        .screen = make_errors(0.8 * rmse, 0.3 * bias),
        .ssim = 1.0 - 2.0 * rmse,
        .rmse_inside = 1.3 * rmse,
        .rmse_outside = 1.7 * rmse,
        .rmse_away = 0.8 * rmse,
        .noise = 0.4 * rmse,
        .instability = { .pixels = 5000, .valid = true, .rms = 0.5 * rmse, .contrast = 0.3, .relative = 1.2 * rmse },
        .flicker = setting % 5 == 4 ? NAN : 0.3 * rmse,
        .reference_noise = 0.002,
        .reference_rays = 1024
    };
}

static char *format_text(const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return strdup(text);
}

static nook_result_row make_row(const nook_results_fixture *fixture, uint32_t scene, uint32_t camera,
                                const char *technique)
{
    return (nook_result_row){ .scene = strdup(fixture->scenes[scene]),
                              .scene_hash = format_text("0123456789abcde%u", scene),
                              .camera = format_text("camera %u", camera + 1),
                              .width = fixture->width,
                              .height = fixture->height,
                              .r_max = 0.5 + scene,
                              .r_max_part = 0.1,
                              .falloff = strdup("hard"),
                              .technique = strdup(technique),
                              .build = strdup("89abcdef"),
                              .machine = strdup("llvmpipe, a made-up processor"),
                              .date = format_text("2026-11-2%uT10:20:30Z", camera % 3) };
}

static void add_technique(const nook_results_fixture *fixture, nook_results *results, uint32_t scene, uint32_t camera,
                          uint32_t technique)
{
    for (uint32_t setting = 0; setting < fixture->settings; setting++) {
        nook_result_row *row = &results->rows[results->row_count++];
        *row = make_row(fixture, scene, camera, techniques[technique]);
        row->initial = setting == 0;
        row->setting = setting == 0 ? strdup(techniques[technique])
                                    : format_text("%s rays=%u%s", techniques[technique], setting,
                                                  setting % 3 ? "" : " ao.scale=half");
        row->sample = make_sample(technique, setting, camera, scene);
        row->picture = make_picture(fixture, scene, "vhk"[technique], camera, setting + 1);
    }
}

static void add_reference(const nook_results_fixture *fixture, nook_results *results, uint32_t scene, uint32_t camera)
{
    nook_result_row *row = &results->rows[results->row_count++];
    *row = make_row(fixture, scene, camera, "reference");
    row->setting = strdup("reference sees=screen");
    row->sample = make_sample(1, 6, camera, scene);
    row->sample.ms_median = row->sample.ms_min = row->sample.ms_max = 54321.0;
    row->sample.fetches = 0.0;
    row->picture = strdup("");
}

static void add_site(const nook_results_fixture *fixture, nook_results *results, uint32_t scene, uint32_t camera)
{
    results->sites[results->site_count++] =
        (nook_result_site){ .scene = strdup(fixture->scenes[scene]),
                            .scene_hash = format_text("0123456789abcde%u", scene),
                            .camera = format_text("camera %u", camera + 1),
                            .width = fixture->width,
                            .height = fixture->height,
                            .r_max = 0.5 + scene,
                            .falloff = strdup("hard"),
                            .reference_noise = 0.002,
                            .reference_rays = 1024,
                            .truth = make_picture(fixture, scene, 't', camera, 0),
                            .screen = make_picture(fixture, scene, 's', camera, 0),
                            .geometry = make_picture(fixture, scene, 'g', camera, 0),
                            .lit = make_picture(fixture, scene, 'l', camera, 3) };
}

void nook_results_fixture_make(const nook_results_fixture *fixture, nook_results *out_results)
{
    size_t sites = (size_t)fixture->scene_count * fixture->cameras;
    size_t rows = sites * (NOOK_COUNT(techniques) * fixture->settings + 1);
    nook_results results = { .row_capacity = rows, .site_capacity = sites };
    results.rows = calloc(rows, sizeof *results.rows);
    results.sites = calloc(sites, sizeof *results.sites);
    if (!results.rows || !results.sites)
        abort();
    for (uint32_t scene = 0; scene < fixture->scene_count; scene++) {
        for (uint32_t camera = 0; camera < fixture->cameras; camera++) {
            add_site(fixture, &results, scene, camera);
            for (uint32_t technique = 0; technique < NOOK_COUNT(techniques); technique++)
                add_technique(fixture, &results, scene, camera, technique);
            add_reference(fixture, &results, scene, camera);
        }
    }
    *out_results = results;
}

nook_results nook_results_fixture_numbers(const char *const *scenes, uint32_t scene_count, uint32_t cameras,
                                          uint32_t settings)
{
    nook_results results;
    const nook_results_fixture fixture = {
        .scenes = scenes, .scene_count = scene_count, .cameras = cameras, .settings = settings, .width = 8, .height = 8
    };
    nook_results_fixture_make(&fixture, &results);
    return results;
}
