#include "game/measure/site.h"
#include "engine/core/log.h"
#include "game/measure/scene_hash.h"
#include "game/measure/site_internal.h"
#include "game/stage.h"
#include <stdio.h>
#include <stdlib.h>

static nook_result mark_sides(nook_site *site, const nook_surfaces *surfaces)
{
    static const uint8_t sides[] = { NOOK_SILHOUETTE_INSIDE, NOOK_SILHOUETTE_OUTSIDE, NOOK_SILHOUETTE_AWAY };
    size_t pixels = (size_t)site->width * site->height;
    uint8_t *marks = malloc(pixels);
    nook_result result = marks ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "no memory for the masks of %zu pixels", pixels);
    if (result == NOOK_OK)
        result = nook_silhouettes_mark(&surfaces->seen, marks);
    for (size_t i = 0; i < NOOK_COUNT(sides) && result == NOOK_OK; i++) {
        site->sides[i] = malloc(pixels);
        if (site->sides[i])
            nook_silhouettes_mask(marks, pixels, sides[i], site->sides[i]);
        else
            result = nook_fail(NOOK_E_MEMORY, "no memory for the masks of %zu pixels", pixels);
    }
    free(marks);
    return result;
}

static nook_result open_truth(nook_site *site, const nook_site_desc *desc, const nook_surfaces *surfaces, bool screen,
                              nook_truth *out_truth)
{
    const nook_truth_desc truth = { .surfaces = surfaces,
                                    .geometry = site->geometry,
                                    .scene_hash = site->scene_hash,
                                    .screen = screen,
                                    .rays_max = desc->rays_max,
                                    .cache = desc->cache };
    nook_result result = nook_truth_open(site->stage, &truth, out_truth);
    return result == NOOK_OK ? nook_truth_refine(out_truth, site->stage, desc->noise) : result;
}

/* The truths first, while the G-buffer is the site's; the other views draw their own. */
static nook_result prepare(nook_site *site, const nook_site_desc *desc, const nook_surfaces *surfaces)
{
    nook_result result = nook_geometry_read(site->stage, &site->geometry);
    if (result == NOOK_OK)
        result = mark_sides(site, surfaces);
    if (result == NOOK_OK)
        result = open_truth(site, desc, surfaces, false, &site->truth);
    if (result == NOOK_OK && desc->what & NOOK_MEASURE_SCREEN)
        result = open_truth(site, desc, surfaces, true, &site->screen);
    if (result == NOOK_OK && desc->what & NOOK_MEASURE_STEADINESS)
        result = nook_site_views_create(site->stage, &site->camera, surfaces, &site->views);
    return result;
}

nook_result nook_site_open(nook_stage *stage, const nook_site_desc *desc, nook_site **out_site)
{
    *out_site = NULL;
    nook_site *site = calloc(1, sizeof *site);
    if (!site)
        return nook_fail(NOOK_E_MEMORY, "no memory for a site");
    site->stage = stage;
    site->camera = desc->camera;
    site->scene_hash = desc->scene_hash ? desc->scene_hash : nook_scene_hash(stage->scene);
    site->what = desc->what;
    site->width = stage->width;
    site->height = stage->height;
    snprintf(site->name, sizeof site->name, "%s", desc->camera_name);
    nook_ao_get_param(stage->ao, "ao.r_max", &site->r_max);
    nook_surfaces surfaces;
    nook_result result = nook_surfaces_draw(stage, &desc->camera, &surfaces);
    if (result == NOOK_OK)
        result = prepare(site, desc, &surfaces);
    nook_surfaces_free(&surfaces);
    if (result != NOOK_OK) {
        nook_site_close(site);
        return result;
    }
    *out_site = site;
    return NOOK_OK;
}

void nook_site_close(nook_site *site)
{
    if (!site)
        return;
    free(site->geometry);
    for (size_t i = 0; i < NOOK_COUNT(site->sides); i++)
        free(site->sides[i]);
    nook_truth_close(&site->truth);
    nook_truth_close(&site->screen);
    nook_site_views_free(&site->views);
    free(site);
}

const float *nook_site_truth(const nook_site *site)
{
    return site->truth.values;
}

const float *nook_site_screen_truth(const nook_site *site)
{
    return site->screen.values;
}

const uint8_t *nook_site_geometry(const nook_site *site)
{
    return site->geometry;
}

double nook_site_noise(const nook_site *site)
{
    return site->truth.noise;
}

uint32_t nook_site_rays(const nook_site *site)
{
    return site->truth.rays;
}
