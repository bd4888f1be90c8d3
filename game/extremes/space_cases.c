/* Scale and place: the same picture wherever the scene is and however large. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/groups.h"
#include <math.h>
#include <stdio.h>

/* Half a step of an 8-bit picture: what no display shows. */
static const double UNSEEN = 0.5 / 255.0;

/* ---- Scale ---- */

/** One scene against the usual one. */
static nook_result compare_scaled(const nook_extremes *extremes, const nook_edge_pictures *usual, double scale,
                                  bool by_matrix, nook_edge_compare compare, nook_extreme_found *found)
{
    const nook_edge_scene_desc desc = { .vertex_scale = by_matrix ? 1.0 : scale,
                                        .matrix_scale = by_matrix ? scale : 1.0 };
    nook_edge_scene scene;
    nook_edge_pictures pictures;
    char where[96];
    nook_result result = nook_edge_scene_make(extremes, &desc, &scene);
    if (result != NOOK_OK)
        return result;
    snprintf(where, sizeof where, "scale %g by %s", scale, by_matrix ? "matrices" : "vertices");
    result = nook_edge_pictures_take(&scene, found, where, &pictures);
    if (result == NOOK_OK) {
        nook_edge_pictures_compare(usual, &pictures, compare, found, where);
        nook_edge_pictures_free(&pictures);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/** All scales, by vertices and by matrices, against scale 1. */
static nook_result compare_scales(const nook_extremes *extremes, const double *scales, size_t count,
                                  nook_edge_compare compare, nook_extreme_found *found)
{
    nook_edge_scene scene;
    nook_edge_pictures usual;
    nook_result result = nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ 0 }, &scene);
    if (result != NOOK_OK)
        return result;
    result = nook_edge_pictures_take(&scene, found, "scale 1", &usual);
    nook_edge_scene_free(&scene);
    for (size_t i = 0; result == NOOK_OK && i < 2 * count; i++) {
        result = compare_scaled(extremes, &usual, scales[i / 2], i % 2 == 1, compare, found);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)(2 * count));
    }
    nook_edge_pictures_free(&usual);
    return result;
}

static nook_result run_powers_of_two(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const double all[] = { ldexp(1.0, -20), ldexp(1.0, 20), ldexp(1.0, -10), ldexp(1.0, -3), 2.0, ldexp(1.0, 10) };
    out_found->bound = 0.0;
    return compare_scales(extremes, all, extremes->quick ? 2 : NOOK_COUNT(all), nook_edge_different, out_found);
}

static nook_result run_decimal_scales(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const double all[] = { 1e-6, 1e6, 1e-4, 1e-2, 100.0, 1e4 };
    out_found->bound = UNSEEN;
    return compare_scales(extremes, all, extremes->quick ? 2 : NOOK_COUNT(all), nook_edge_rms, out_found);
}

/* ---- Place ---- */

static nook_result run_moved(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const double all[] = { 1e7, 1e3, 1e4, 1e5, 1e6 };
    const size_t count = extremes->quick ? 2 : NOOK_COUNT(all);
    out_found->bound = UNSEEN;
    nook_edge_pictures usual = { 0 };
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i <= count; i++) { /* the first time where it is */
        const double offset = i == 0 ? 0.0 : all[i - 1];
        const nook_matrix move = nook_matrix_translation(offset, -0.7 * offset, 0.3 * offset);
        nook_edge_scene scene;
        nook_edge_pictures pictures;
        char where[64];
        snprintf(where, sizeof where, "%g units off", offset);
        result = nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ 0 }, &scene);
        if (result != NOOK_OK)
            break;
        if (i > 0)
            nook_edge_scene_move(&scene, &move);
        result = nook_edge_pictures_take(&scene, out_found, where, i == 0 ? &usual : &pictures);
        nook_edge_scene_free(&scene);
        if (result == NOOK_OK && i > 0) {
            nook_edge_pictures_compare(&usual, &pictures, nook_edge_rms, out_found, where);
            nook_edge_pictures_free(&pictures);
        }
        nook_extreme_progress(extremes, (double)(i + 1) / (double)(count + 1));
    }
    nook_edge_pictures_free(&usual);
    return result;
}

static const nook_extreme cases[] = {
    { .name = "a scene scaled by powers of two from 2^-20 to 2^20, r_max with it, is bit for bit the same",
      .unit = "pixels",
      .why = "A power of two rounds nothing away: whatever differs is a length in the code that is not relative.",
      .run = run_powers_of_two },
    { .name = "a scene scaled from 1e-6 to 1e6, r_max with it, is the same picture",
      .unit = "RMS of visibility",
      .why = "Rounded scales move single rays; half a step of an 8-bit display is not seen.",
      .run = run_decimal_scales },
    { .name = "a scene moved by 1e3 to 1e7 units, the camera with it, is the same picture",
      .unit = "RMS of visibility",
      .why = "In double a place 1e7 units off is known to 2e-9: a 30th of a float's step at one unit.",
      .run = run_moved },
};

const nook_extreme_group nook_extreme_space = { .name = "space", .cases = cases, .count = NOOK_COUNT(cases) };
