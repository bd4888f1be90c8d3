/* Scale and place: the same picture wherever the scene is and however large. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/float_formulas.h"
#include "game/extremes/groups.h"
#include "game/extremes/space_internal.h"
#include <math.h>
#include <stdio.h>

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
        if (compare)
            nook_edge_pictures_compare(usual, &pictures, compare, found, where);
        else
            nook_edge_pictures_compare_elsewhere(usual, &pictures, nook_edge_rms, found, where);
        nook_edge_pictures_free(&pictures);
    }
    nook_edge_scene_free(&scene);
    return result;
}

/** All scales, by vertices and by matrices, against scale 1. @param compare  NULL: as of a scene elsewhere */
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
    out_found->bound = 16.0 * 0x1p-24;
    return compare_scales(extremes, all, extremes->quick ? 2 : NOOK_COUNT(all), NULL, out_found);
}

/* ---- Turned: the G-buffer is carried along, as the renderer takes rigid cameras only ---- */

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
            nook_edge_pictures_compare_elsewhere(&usual, &pictures, nook_edge_rms, found, name);
            nook_edge_pictures_free(&pictures);
        }
        nook_extreme_progress(extremes, (double)(i + 1) / (double)(count + 1));
    }
    nook_edge_pictures_free(&usual);
    return result;
}

static nook_result run_turned(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const double here[3] = { 0, 0, 0 }, far[3] = { 1e7, -3e6, 1e6 }, one[3] = { 1, 1, 1 }, mirrored[3] = { -1, 1, 1 };
    const double turn[4] = { 0.36, -0.48, 0.64, 0.48 }, still[4] = { 0, 0, 0, 1 };
    const space_move moves[] = { { "turned and mirrored, 1e7 units off", nook_matrix_compose(far, turn, mirrored) },
                                 { "mirrored", nook_matrix_compose(here, still, mirrored) },
                                 { "turned", nook_matrix_compose(here, turn, one) } };
    out_found->bound = 0.5 * 0.5 * sqrt(18.0) * 2.0 / 65535.0;
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
      .why =
          "Depths, matrices and sums round each their way: 16 roundings of 6e-8, and no ray that hits another thing.",
      .run = run_decimal_scales },
    { .name = "nodes 1e3 to 1e7 units off, the camera with them: the renderer draws the same G-buffer",
      .unit = "steps of its formats",
      .why = "view_from_mesh is composed in double, 2e-9 off at 1e7: one of its floats may round the other way.",
      .run = nook_space_run_drawn },
    { .name = "nodes 1e3 to 1e7 units off, drawn by the renderer: every technique's picture is the same",
      .unit = "RMS of visibility",
      .why = "One step of depth: 3 times the 2e-6 that vertices 1 unit off, whose depth is 5 steps off, cost.",
      .run = nook_space_run_drawn_pictures },
    { .name = "vertices 1 to 1e6 units off their mesh's origin are drawn a few float steps off",
      .unit = "float steps",
      .why = "Half a step for each rounded coordinate, product and sum: 3 for most pixels, whatever the offset.",
      .run = nook_space_run_far_vertices },
    { .name = "vertices up to 100 units off their mesh's origin, surfaces 2 to 6.5 away: the same picture",
      .unit = "RMS of visibility",
      .why = "Depths 1e-5 off turn single rays: one of 16 in one pixel of 48 x 48. Where: what more costs.",
      .limit = "Vertices are floats: more than 100 units off their mesh's origin the reference's rays start inside "
               "surfaces (RMS 0.4 at 1e3), at 1e4 volumes are 0.01 off, at 1e7 a vertex moves by a unit. Nodes may be "
               "anywhere.",
      .run = nook_space_run_far_vertices_pictures },
    { .name = "a scene turned and mirrored, its G-buffer and camera with it, is the same picture",
      .unit = "RMS of visibility",
      .why = "Normals are coded anew: half a step of 16 bits turns them by 6e-5 radians, A changes by half of that.",
      .run = run_turned },
    { .name = "a visible point's voxel by our float arithmetic, up to 1e7 units off",
      .unit = "voxels of 256",
      .why = "Hardware filters voxels with weights of 8 bits. Where: what the obvious formulas lose instead.",
      .run = run_arithmetic },
};

const nook_extreme_group nook_extreme_space = { .name = "space", .cases = cases, .count = NOOK_COUNT(cases) };
