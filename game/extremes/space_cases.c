/* Scale and place: the same picture wherever the scene is and however large. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/float_formulas.h"
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

/** A rigid or mirrored way to carry scene and camera elsewhere. */
typedef struct space_move {
    char name[64];
    nook_matrix matrix;
} space_move;

/** The scene under each of the moves against the scene where it is. */
static nook_result compare_moved(const nook_extremes *extremes, const space_move *moves, size_t count,
                                 nook_extreme_found *found)
{
    nook_edge_pictures usual = { 0 };
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i <= count; i++) { /* the first time where it is */
        const char *name = i == 0 ? "where it is" : moves[i - 1].name;
        nook_edge_scene scene;
        nook_edge_pictures pictures;
        result = nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ 0 }, &scene);
        if (result != NOOK_OK)
            break;
        if (i > 0)
            nook_edge_scene_move(&scene, &moves[i - 1].matrix);
        result = nook_edge_pictures_take(&scene, found, name, i == 0 ? &usual : &pictures);
        nook_edge_scene_free(&scene);
        if (result == NOOK_OK && i > 0) {
            nook_edge_pictures_compare(&usual, &pictures, nook_edge_rms, found, name);
            nook_edge_pictures_free(&pictures);
        }
        nook_extreme_progress(extremes, (double)(i + 1) / (double)(count + 1));
    }
    nook_edge_pictures_free(&usual);
    return result;
}

static nook_result run_moved(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double offsets[] = { 1e7, 1e3, 1e4, 1e5, 1e6 };
    space_move moves[NOOK_COUNT(offsets)];
    for (size_t i = 0; i < NOOK_COUNT(offsets); i++) {
        const double offset = offsets[i] + 0.123; /* which no float holds */
        moves[i].matrix = nook_matrix_translation(offset, -0.7 * offset, 0.3 * offset);
        snprintf(moves[i].name, sizeof moves[i].name, "%g units off", offsets[i]);
    }
    out_found->bound = UNSEEN;
    return compare_moved(extremes, moves, extremes->quick ? 2 : NOOK_COUNT(offsets), out_found);
}

static nook_result run_turned(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const double here[3] = { 0, 0, 0 }, far[3] = { 1e7, -3e6, 1e6 }, one[3] = { 1, 1, 1 }, mirrored[3] = { -1, 1, 1 };
    const double turn[4] = { 0.36, -0.48, 0.64, 0.48 }, still[4] = { 0, 0, 0, 1 };
    const space_move moves[] = { { "turned and mirrored, 1e7 units off", nook_matrix_compose(far, turn, mirrored) },
                                 { "mirrored", nook_matrix_compose(here, still, mirrored) },
                                 { "turned", nook_matrix_compose(here, turn, one) } };
    out_found->bound = UNSEEN;
    return compare_moved(extremes, moves, extremes->quick ? 1 : NOOK_COUNT(moves), out_found);
}

/* ---- The arithmetic alone ---- */

static const double VOXELS = 256.0, SIDE = 5.0; /* a volume as large as the scene */

static nook_float_setting setting_at(double offset)
{
    const double eye[3] = { 2.2 + offset, -3.0 + offset, 2.2 + offset };
    const double target[3] = { 0.1 + offset, 0.2 + offset, 0.3 + offset }, up[3] = { 0, 0, 1 };
    const double step = SIDE / VOXELS, still[4] = { 0, 0, 0, 1 }, scale[3] = { step, step, step };
    const double corner[3] = { offset - 0.5 * SIDE, offset - 0.5 * SIDE, offset - 0.5 * SIDE };
    return (nook_float_setting){ .view_from_world = nook_matrix_look_at(eye, target, up),
                                 .clip_from_view = nook_matrix_perspective_reversed(0.8, 1.0, 0.1),
                                 .world_from_voxel = nook_matrix_compose(corner, still, scale) };
}

/** The worst of each way over pixels all over the image, 2 to 7 units away. */
static nook_float_error worst_at(double offset, int pixels)
{
    const nook_float_setting setting = setting_at(offset);
    nook_float_error worst = { 0 };
    for (int i = 0; i < pixels * pixels; i++) {
        const nook_float_pixel pixel = { { (float)(2.0 * (i % pixels + 0.5) / pixels - 1.0),
                                           (float)(2.0 * (i / pixels + 0.5) / pixels - 1.0) },
                                         (float)(2.0 + 5.0 * fmod(i * 0.61803398875, 1.0)) };
        const nook_float_error error = nook_float_measure(&setting, &pixel);
        worst.relative = fmax(worst.relative, error.relative);
        worst.world = fmax(worst.world, error.world);
        worst.projection = fmax(worst.projection, error.projection);
    }
    return worst;
}

static nook_result run_arithmetic(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const int pixels = extremes->quick ? 8 : 64;
    double world_lost = INFINITY, projection_lost = INFINITY; /* the first offset at which a voxel is missed */
    nook_float_error near = worst_at(1e4, pixels), far = worst_at(1e7, pixels);
    out_found->bound = 1.0 / 256.0;
    for (double offset = 1.0; offset <= 1.5e7; offset *= 10.0) {
        const nook_float_error error = worst_at(offset, pixels);
        world_lost = error.world > 1.0 ? fmin(world_lost, offset) : world_lost;
        projection_lost = error.projection > 1.0 ? fmin(projection_lost, offset) : projection_lost;
        nook_extreme_worst(out_found, error.relative, "%g units off", offset);
    }
    snprintf(out_found->where, sizeof out_found->where,
             "world-space float: %.2g voxels wrong at 1e4, %.2g at 1e7, over 1 from %g; inverse view-projection: %.2g, "
             "%.2g, "
             "from %g",
             near.world, far.world, world_lost, near.projection, far.projection, projection_lost);
    return NOOK_OK;
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
    { .name = "a scene turned and mirrored, the camera with it, is the same picture",
      .unit = "RMS of visibility",
      .why = "Turned normals are coded anew, half a step of 16 bits: less than half a step of an 8-bit display.",
      .run = run_turned },
    { .name = "a visible point's voxel by our float arithmetic, up to 1e7 units off",
      .unit = "voxels of 256",
      .why = "Hardware filters voxels with weights of 8 bits. Where: what the obvious formulas lose instead.",
      .run = run_arithmetic },
};

const nook_extreme_group nook_extreme_space = { .name = "space", .cases = cases, .count = NOOK_COUNT(cases) };
