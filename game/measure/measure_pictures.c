#include "game/measure/measure_pictures.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/exposure.h"
#include "game/measure/measure_origin.h"
#include "game/measure/summary.h"
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

enum { NAME_CAPACITY = 96 /* of a part of a path that people read */ };

/* What file systems and pages take without quoting. */
static void clean(const char *text, char out[NAME_CAPACITY])
{
    size_t used = 0;
    for (; *text && used < NAME_CAPACITY - 1; text++) {
        bool plain = isalnum((unsigned char)*text) || *text == '.' || *text == '_' || *text == '=';
        out[used++] = plain ? *text : '-';
    }
    out[used] = '\0';
}

static uint32_t short_hash(const char *text, uint64_t seed)
{
    return (uint32_t)XXH3_64bits_withSeed(text, strlen(text), seed);
}

const char *nook_measure_picture_path(const nook_result_row *row, const char *name, char out[NOOK_MEASURE_PICTURE_MAX])
{
    char site[1024 + NOOK_ORIGIN_MACHINE_SIZE], scene[NAME_CAPACITY], camera[NAME_CAPACITY], file[NAME_CAPACITY];
    snprintf(site, sizeof site, "%s/%s/%ux%u/%.17g/%s/%s", row->scene_hash, row->camera, row->width, row->height,
             row->r_max, row->falloff, row->machine);
    clean(row->scene, scene);
    clean(row->camera, camera);
    clean(name, file);
    snprintf(out, NOOK_MEASURE_PICTURE_MAX, "pictures/%s_%s_%.3gm_%08" PRIx32 "/%s_%08" PRIx32 ".png", scene, camera,
             row->r_max, short_hash(site, 0), file, short_hash(name, 0));
    return out;
}

bool nook_measure_picture_is_inside(const char *path)
{
    if (path[0] == '/')
        return false;
    for (const char *part = path; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return false;
    }
    return true;
}

static nook_result write_picture(const char *folder, const char *path, const nook_picture *picture)
{
    char full[4096], parent[4096];
    nook_path_join(full, sizeof full, folder, path);
    snprintf(parent, sizeof parent, "%.*s", (int)(nook_path_name(full) - full), full);
    nook_result result = nook_directory_make(parent);
    return result == NOOK_OK ? nook_picture_write_png(picture, full) : result;
}

nook_result nook_measure_picture_write(const char *folder, const char *path, const float *values, uint32_t width,
                                       uint32_t height)
{
    nook_picture picture;
    nook_result result = nook_picture_from_grey(values, width, height, &picture);
    if (result != NOOK_OK)
        return result;
    result = write_picture(folder, path, &picture);
    nook_picture_free(&picture);
    return result;
}

static nook_result write_geometry(const char *folder, const char *path, const uint8_t *geometry, uint32_t width,
                                  uint32_t height)
{
    size_t pixels = (size_t)width * height;
    float *values = malloc(pixels * sizeof *values);
    if (!values)
        return nook_fail(NOOK_E_MEMORY, "no memory for a picture of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++)
        values[i] = geometry[i] ? 1.0f : 0.0f;
    nook_result result = nook_measure_picture_write(folder, path, values, width, height);
    free(values);
    return result;
}

static nook_result write_lit(nook_stage *stage, const nook_camera *camera, const char *folder, const char *path)
{
    nook_picture picture;
    nook_result result = nook_picture_create(stage->width, stage->height, &picture);
    if (result != NOOK_OK)
        return result;
    result = nook_stage_expose(stage, camera);
    if (result == NOOK_OK)
        result = nook_stage_begin(stage, camera);
    if (result == NOOK_OK)
        result = nook_stage_finish(stage, false, NOOK_VIEW_LIT);
    if (result == NOOK_OK) {
        nook_renderer_read(stage->renderer, &picture.pixels->r);
        result = write_picture(folder, path, &picture);
    }
    nook_picture_free(&picture);
    return result;
}

nook_result nook_measure_site_write(nook_stage *stage, const nook_site *site, const nook_camera *camera,
                                    const nook_result_row *row, const char *folder, nook_measure_site_paths *paths,
                                    nook_result_site *out_site)
{
    nook_measure_picture_path(row, "truth", paths->truth);
    nook_measure_picture_path(row, "screen", paths->screen);
    nook_measure_picture_path(row, "geometry", paths->geometry);
    nook_measure_picture_path(row, "lit", paths->lit);
    nook_result result =
        nook_measure_picture_write(folder, paths->truth, nook_site_truth(site), row->width, row->height);
    if (result == NOOK_OK)
        result =
            nook_measure_picture_write(folder, paths->screen, nook_site_screen_truth(site), row->width, row->height);
    if (result == NOOK_OK)
        result = write_geometry(folder, paths->geometry, nook_site_geometry(site), row->width, row->height);
    if (result == NOOK_OK)
        result = write_lit(stage, camera, folder, paths->lit);
    if (result != NOOK_OK)
        return result;
    *out_site = (nook_result_site){ .scene = row->scene,
                                    .scene_hash = row->scene_hash,
                                    .camera = row->camera,
                                    .width = row->width,
                                    .height = row->height,
                                    .r_max = row->r_max,
                                    .falloff = row->falloff,
                                    .reference_noise = nook_site_noise(site),
                                    .reference_rays = nook_site_rays(site),
                                    .truth = paths->truth,
                                    .screen = paths->screen,
                                    .geometry = paths->geometry,
                                    .lit = paths->lit };
    return NOOK_OK;
}

/* ---- Those that stay -------------------------------------------------------------------------------------------- */

/* The rows of a site. */
typedef struct site_rows {
    nook_result_row **rows;
    double *times, *fetches, *errors;
    bool *on_front; /* twice as many: of times, then of fetches */
    size_t count;
} site_rows;

static bool is_truth(const nook_result_row *row)
{
    return strcmp(row->technique, NOOK_SUMMARY_REFERENCE) == 0;
}

static nook_result gather(nook_results *results, const nook_result_row *like, site_rows *out)
{
    size_t most = results->row_count + 1;
    out->rows = calloc(most, sizeof(nook_result_row *));
    out->times = calloc(most, 3 * sizeof *out->times);
    out->on_front = calloc(most, 2 * sizeof *out->on_front);
    if (!out->rows || !out->times || !out->on_front)
        return nook_fail(NOOK_E_MEMORY, "no memory for the front of a site");
    out->fetches = out->times + most;
    out->errors = out->fetches + most;
    for (size_t i = 0; i < results->row_count; i++) {
        nook_result_row *row = &results->rows[i];
        if (!nook_result_row_same_site(row, like))
            continue;
        out->rows[out->count] = row;
        out->times[out->count] = row->sample.ms_median;
        out->fetches[out->count] = row->sample.fetches;
        out->errors[out->count++] = is_truth(row) ? NAN : row->sample.truth.rmse;
    }
    return NOOK_OK;
}

static void remove_picture(nook_result_row *row, const char *folder)
{
    char path[4096];
    if (row->picture[0])
        unlink(nook_path_join(path, sizeof path, folder, row->picture));
    row->picture[0] = '\0';
}

nook_result nook_measure_pictures_prune(nook_results *results, const nook_result_row *like, const char *folder)
{
    site_rows site = { 0 };
    nook_result result = gather(results, like, &site);
    if (result == NOOK_OK)
        result = nook_front_mark(site.times, site.errors, site.count, site.on_front);
    if (result == NOOK_OK)
        result = nook_front_mark(site.fetches, site.errors, site.count, site.on_front + site.count);
    for (size_t i = 0; i < site.count && result == NOOK_OK; i++) {
        bool front = site.on_front[i] || site.on_front[site.count + i];
        if (!front && !site.rows[i]->initial && !is_truth(site.rows[i]))
            remove_picture(site.rows[i], folder);
    }
    free(site.rows);
    free(site.times);
    free(site.on_front);
    return result;
}
