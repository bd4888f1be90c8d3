/* What shaders are given of an occluder's matrix, and which occluders they are given. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/oracle_matrix.h"
#include "game/extremes/probe.h"
#include "game/extremes/random_transform.h"
#include "game/extremes/transform_internal.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- voxel_from_view ---- */

static const double FLOAT_ROUNDING = 0x1p-24; /* of a number, at the most */
enum { INSTANCES = 256, RESOLUTION = 64 };

/** The unit box baked at RESOLUTION: one empty voxel around it. */
static nook_matrix mesh_from_voxel(void)
{
    const double step = 1.0 / RESOLUTION;
    const double corner[3] = { -step, -step, -step }, still[4] = { 0, 0, 0, 1 }, scale[3] = { step, step, step };
    return nook_matrix_compose(corner, still, scale);
}

/**
 * Where the rounded matrix sends a point, against where the exact one does, in roundings of the numbers that meet: entries times
 * coordinates. Entries that are rounded once give at most 1.
 */
static double row_error(const float row[4], const long double exact[4], const long double point[3])
{
    long double difference = (long double)row[3] - exact[3], met = fabsl(exact[3]);
    for (int k = 0; k < 3; k++) {
        difference += ((long double)row[k] - exact[k]) * point[k];
        met += fabsl(exact[k] * point[k]);
    }
    return (double)(fabsl(difference) / (met * FLOAT_ROUNDING));
}

/** Both matrices of one uploaded occluder against the oracle: box corners, and the rows that take normals. */
static double uploaded_error(const nook_probe_occluder *got, const nook_matrix *view_from_world,
                             const nook_matrix *world_from_mesh)
{
    const nook_matrix bake = mesh_from_voxel();
    const nook_oracle view = nook_oracle_of(view_from_world), world = nook_oracle_of(world_from_mesh);
    const nook_oracle mesh = nook_oracle_of(&bake), placed = nook_oracle_multiply(&view, &world);
    const nook_oracle view_from_voxel = nook_oracle_multiply(&placed, &mesh);
    const nook_oracle voxel_from_view = nook_oracle_inverse(&view_from_voxel);
    double worst = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        const double voxel[3] = { corner & 1 ? RESOLUTION : 0, corner & 2 ? RESOLUTION : 0,
                                  corner & 4 ? RESOLUTION : 0 };
        long double point[3];
        nook_oracle_apply(&view_from_voxel, voxel, point);
        for (int row = 0; row < 3; row++)
            worst = fmax(worst, row_error(got->voxel_from_view[row], voxel_from_view.m[row], point));
    }
    for (int row = 0; row < 3; row++) { /* the inverse transpose of voxel_from_view */
        const long double exact[4] = { view_from_voxel.m[0][row], view_from_voxel.m[1][row], view_from_voxel.m[2][row],
                                       0.0L };
        const long double all[3] = { 1.0L, 1.0L, 1.0L };
        const float normal[4] = { got->normal_from_view[row][0], got->normal_from_view[row][1],
                                  got->normal_from_view[row][2], 0.0f };
        worst = fmax(worst, row_error(normal, exact, all));
    }
    return worst;
}

/** One record of instances everywhere around a camera `offset` units off. */
static nook_result upload_at(nook_fixture_view *view, const nook_probe *probe, double offset, nook_random *random,
                             nook_extreme_found *found)
{
    const double at[3] = { offset, -offset, offset }, one[3] = { 1, 1, 1 };
    double turn[4];
    nook_matrix world_from_view, matrices[INSTANCES];
    nook_random_turn(random, turn);
    world_from_view = nook_matrix_compose(at, turn, one);
    nook_matrix_inverse_affine(&world_from_view, &view->view_from_world);
    view->occluder_count = 1; /* the one that holds the mesh; the rest are its instances */
    for (int i = 0; i < INSTANCES; i++) {
        const double place[3] = { at[0] + nook_random_between(random, -9.0, 9.0),
                                  at[1] + nook_random_between(random, -9.0, 9.0),
                                  at[2] + nook_random_between(random, -9.0, 9.0) };
        matrices[i] = nook_random_affine(random, place, 100.0, i & 1 ? 1.0 : 0.0);
        if (i == 0)
            memcpy(view->occluders[0].world_from_mesh, matrices[0].m, sizeof matrices[0].m);
        else if (nook_fixture_view_add_instance(view, 0, &matrices[i]) != NOOK_OK)
            return NOOK_E_MEMORY;
    }
    nook_result result = nook_fixture_view_record(view, "probe");
    if (result != NOOK_OK)
        return result;
    if (probe->occluder_count != INSTANCES)
        nook_extreme_worst(found, NAN, "%u of %d occluders came through, %g units off", probe->occluder_count,
                           INSTANCES, offset);
    for (uint32_t i = 0; i < probe->occluder_count; i++)
        nook_extreme_worst(found, uploaded_error(&probe->occluders[i], &view->view_from_world, &matrices[i]),
                           "%g units off, matrix %u", offset, i);
    return NOOK_OK;
}

nook_result nook_transform_run_uploaded(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double offsets[] = { 0.0, 1e7, 1e3, 1e5 };
    const size_t count = extremes->quick ? 2 : NOOK_COUNT(offsets);
    const nook_ao_technique *const techniques[] = { &nook_probe_technique };
    nook_probe probe = { 0 };
    nook_random random = { 7 };
    nook_fixture_view *view;
    const nook_fixture_view_desc desc = { .gpu = extremes->gpu,
                                          .width = 1,
                                          .height = 1,
                                          .techniques = techniques,
                                          .technique_count = 1,
                                          .progress_user = &probe };
    out_found->bound = 1.05;
    nook_result result = nook_fixture_view_create(&desc, &view);
    if (result != NOOK_OK)
        return result;
    nook_fixture_mesh box = { 0 };
    nook_fixture_add_box(&box, (double[]){ 0, 0, 0 }, (double[]){ 1, 1, 1 }, 63);
    result = nook_fixture_view_add(view, &box, RESOLUTION, NULL, NULL);
    nook_fixture_mesh_free(&box);
    for (size_t i = 0; result == NOOK_OK && i < count * (extremes->quick ? 1 : 8); i++)
        result = upload_at(view, &probe, offsets[i % count], &random, out_found);
    nook_fixture_view_destroy(view);
    nook_probe_free(&probe);
    return result;
}

/* ---- Matrices that are none ---- */

typedef struct odd_matrix {
    const char *what;
    double m[16];
} odd_matrix;

static const odd_matrix odd[] = {
    { "all zero", { 0 } },
    { "flat: no height", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 1 } },
    { "a line", { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0.5, 1 } },
    { "NaN in its turn", { 1, 0, 0, 0, 0, NAN, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } },
    { "NaN in its place", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, NAN, 0, 1 } },
    { "NaN in its last row", { 1, 0, 0, NAN, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } },
    { "infinite scale", { INFINITY, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } },
    { "infinitely far", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -INFINITY, 1 } },
    { "1e300 units off", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e300, 0, 0, 1 } },
    { "1e30 units off", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1e30, 0, 1 } },
    { "1e15 units off", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1e15, 1 } },
};

/** From far too small to far too large; what floats can hold lies between. Not seen in the picture either way. */
static const double sizes[] = { 1e-300, 1e-100, 1e-40, 1e-35, 1e-30, 1e-25, 1e-20, 1e-15, 1e-10,
                                1e10,   1e15,   1e20,  1e25,  1e30,  1e35,  1e40,  1e100, 1e300 };

static nook_result take(nook_edge_scene *scene, nook_extreme_found *found, const char *combine, const char *where,
                        nook_edge_pictures *out_pictures)
{
    nook_result result = nook_ao_parse_param(scene->view->ao, "volume.combine", combine);
    return result == NOOK_OK ? nook_edge_pictures_take(scene, found, where, out_pictures) : result;
}

/** The picture with one more occluder, whose matrix is no use, is the picture without. */
static nook_result compare_with(nook_edge_scene *scene, const nook_edge_pictures *without, const char *combine,
                                const double matrix[16], const char *where, nook_extreme_found *found)
{
    nook_edge_pictures with;
    nook_matrix added;
    memcpy(added.m, matrix, sizeof added.m);
    nook_result result = nook_fixture_view_add_instance(scene->view, 2, &added);
    if (result != NOOK_OK)
        return result;
    /* In the midst of the others, not after them. */
    const nook_ao_occluder odd_one = scene->view->occluders[scene->view->occluder_count - 1];
    scene->view->occluders[scene->view->occluder_count - 1] = scene->view->occluders[1];
    scene->view->occluders[1] = odd_one;
    result = take(scene, found, combine, where, &with);
    scene->view->occluders[1] = scene->view->occluders[--scene->view->occluder_count];
    if (result != NOOK_OK)
        return result;
    nook_edge_pictures_compare_joined(without, &with, nook_edge_different, found, where);
    nook_edge_pictures_free(&with);
    return NOOK_OK;
}

static nook_result compare_all(const nook_extremes *extremes, nook_edge_scene *scene, const char *combine,
                               nook_extreme_found *found)
{
    nook_edge_pictures without;
    nook_result result = take(scene, found, combine, "without", &without);
    if (result != NOOK_OK)
        return result;
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(odd); i++)
        result = compare_with(scene, &without, combine, odd[i].m, odd[i].what, found);
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(sizes); i++) {
        const double s = sizes[i]; /* about the middle of the scene: no face of a vast box passes through the picture */
        const nook_matrix matrix = nook_matrix_scale(s, -s, s);
        char where[32];
        snprintf(where, sizeof where, "scale %g", s);
        result = compare_with(scene, &without, combine, matrix.m, where, found);
        nook_extreme_progress(extremes, (double)i / NOOK_COUNT(sizes));
    }
    nook_edge_pictures_free(&without);
    return result;
}

nook_result nook_transform_run_left_out(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const uint32_t side = extremes->quick ? 16 : 32;
    nook_edge_scene scene;
    out_found->bound = 0.0;
    nook_result result =
        nook_edge_scene_make(extremes, &(nook_edge_scene_desc){ .width = side, .height = side }, &scene);
    if (result != NOOK_OK)
        return result;
    result = compare_all(extremes, &scene, "union", out_found);
    if (result == NOOK_OK)
        result = compare_all(extremes, &scene, "multiply", out_found);
    nook_edge_scene_free(&scene);
    return result;
}
