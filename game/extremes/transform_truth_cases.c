/* Occluders under matrices of any kind against what is true. */
#include "game/extremes/edge_pictures.h"
#include "game/extremes/random_transform.h"
#include "game/extremes/transform_internal.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_volume/volume.h"
#include "modules/fixture/receiver.h"
#include <math.h>
#include <string.h>

enum { SIDE = 16, RESOLUTION = 64 };

/** A view of one receiver on the floor under one body, for the volume and the reference. */
static nook_result open_view(const nook_extremes *extremes, nook_fixture_view **out_view)
{
    static const nook_ao_technique *const techniques[] = { &nook_ao_volume_technique, &nook_ao_reference_technique };
    static const struct {
        const char *name, *value;
    } params[] = { { "ao.filter", "none" },  { "ao.falloff", "linear" }, { "ao.r_max", "20" },
                   { "volume.rays", "256" }, { "volume.steps", "1024" }, { "reference.rays", "256" } };
    const nook_fixture_view_desc desc = {
        .gpu = extremes->gpu, .width = SIDE, .height = SIDE, .techniques = techniques, .technique_count = 2
    };
    nook_result result = nook_fixture_view_create(&desc, out_view);
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(params); i++)
        result = nook_ao_parse_param((*out_view)->ao, params[i].name, params[i].value);
    return result;
}

/** Occlusion of the receiver at the origin, normal +z, seen from just above it. */
static nook_result measure(nook_fixture_view *view, const char *technique, nook_extreme_found *found, double *out_mean)
{
    const nook_fixture_receiver receiver = { .normal = { 0, 0, 1 }, .distance = 0.05 };
    nook_fixture_occlusion occlusion;
    nook_result result = nook_fixture_measure(view, technique, &receiver, &occlusion);
    if (result != NOOK_OK)
        return result;
    nook_extreme_check_view(found, view, "%s", technique);
    *out_mean = occlusion.mean;
    return NOOK_OK;
}

static void use_matrix(nook_fixture_view *view, const nook_matrix *world_from_mesh)
{
    memcpy(view->occluders[0].world_from_mesh, world_from_mesh->m, sizeof world_from_mesh->m);
}

/** A random matrix that leaves the box of +-1/2 wholly above the floor, by 0.2 and by two voxels more, and over the receiver. */
static nook_matrix random_above_floor(nook_random *random, double shear)
{
    const double none[3] = { 0, 0, 0 };
    nook_matrix m = nook_random_affine(random, none, 100.0, shear);
    double half_height = 0.5 * (fabs(m.m[2]) + fabs(m.m[6]) + fabs(m.m[10]));
    m.m[12] = nook_random_between(random, -0.3, 0.3);
    m.m[13] = nook_random_between(random, -0.3, 0.3);
    m.m[14] = 0.2 + half_height * (1.0 + 2.0 * 2.0 / RESOLUTION);
    return m;
}

/* ---- The reference ---- */

static void transformed_box(const nook_matrix *matrix, nook_fixture_mesh *out_mesh)
{
    nook_fixture_mesh box = { 0 };
    nook_fixture_add_box(&box, (double[]){ -0.5, -0.5, -0.5 }, (double[]){ 0.5, 0.5, 0.5 }, 63);
    for (uint32_t i = 0; i < box.index_count; i += 3) {
        double corner[3][3];
        for (uint32_t c = 0; c < 3; c++) {
            for (uint32_t axis = 0; axis < 3; axis++)
                corner[c][axis] = box.positions[box.indices[i + c] * 3 + axis];
            nook_matrix_apply_point(matrix, corner[c], corner[c]);
        }
        nook_fixture_add_triangle(out_mesh, corner[0], corner[1], corner[2]);
    }
    nook_fixture_mesh_free(&box);
}

/** One matrix: the box under it, and the box whose vertices it has moved. */
static nook_result compare_instance(nook_fixture_view *view, const nook_matrix *matrix, int index,
                                    nook_extreme_found *found)
{
    nook_fixture_mesh box = { 0 };
    double as_instance = 0.0, as_vertices = 0.0;
    const nook_matrix still = nook_matrix_identity();
    transformed_box(&still, &box);
    nook_fixture_view_drop_occluders(view);
    nook_result result = nook_fixture_view_add(view, &box, 0, matrix, NULL);
    nook_fixture_mesh_free(&box);
    if (result == NOOK_OK)
        result = measure(view, "reference", found, &as_instance);
    nook_fixture_view_drop_occluders(view);
    transformed_box(matrix, &box);
    if (result == NOOK_OK)
        result = nook_fixture_view_add(view, &box, 0, NULL, NULL);
    nook_fixture_mesh_free(&box);
    if (result == NOOK_OK)
        result = measure(view, "reference", found, &as_vertices);
    nook_extreme_worst(found, fabs(as_instance - as_vertices), "matrix %d, A = %.4f", index, as_vertices);
    return result;
}

nook_result nook_transform_run_instances(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const int count = extremes->quick ? 8 : 100;
    nook_random random = { 11 };
    nook_fixture_view *view;
    out_found->bound = 1.0 / (SIDE * SIDE);
    nook_result result = open_view(extremes, &view);
    for (int i = 0; result == NOOK_OK && i < count; i++) {
        const nook_matrix matrix = random_above_floor(&random, i & 1 ? 1.0 : 0.0);
        result = compare_instance(view, &matrix, i, out_found);
        nook_extreme_progress(extremes, (double)i / count);
    }
    nook_fixture_view_destroy(view);
    return result;
}

/* ---- The volume ---- */

/** Occlusion of the reference by the box under the matrix, grown by so many voxels on each side. */
static nook_result measure_grown(nook_fixture_view *view, const nook_matrix *matrix, double voxels,
                                 nook_extreme_found *found, double *out_mean)
{
    const double size = 1.0 + 2.0 * voxels / RESOLUTION;
    const nook_matrix growth = nook_matrix_scale(size, size, size), grown = nook_matrix_multiply(matrix, &growth);
    use_matrix(view, &grown);
    return measure(view, "reference", found, out_mean);
}

static const char *const kinds[] = { "binary", "density", "surfel", "distance" };

static nook_result compare_volume(nook_fixture_view *view, const nook_matrix *matrix, int index,
                                  nook_extreme_found *found)
{
    double got[NOOK_COUNT(kinds)] = { 0.0 }, least = 0.0, truth = 0.0, most = 0.0;
    nook_result result = NOOK_OK;
    use_matrix(view, matrix);
    for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(kinds); i++) {
        result = nook_ao_parse_param(view->ao, "volume.kind", kinds[i]);
        if (result == NOOK_OK)
            result = measure(view, "volume", found, &got[i]);
    }
    if (result == NOOK_OK)
        result = measure_grown(view, matrix, -1.0, found, &least);
    if (result == NOOK_OK)
        result = measure_grown(view, matrix, 0.0, found, &truth);
    if (result == NOOK_OK)
        result = measure_grown(view, matrix, 1.0, found, &most);
    for (size_t i = 0; i < NOOK_COUNT(kinds); i++)
        nook_extreme_worst(found, fmax(0.0, fmax(least - got[i], got[i] - most)), "%s, matrix %d, A = %.4f, true %.4f",
                           kinds[i], index, got[i], truth);
    return result;
}

nook_result nook_transform_run_volume(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const int count = extremes->quick ? 8 : 100;
    nook_random random = { 23 };
    nook_fixture_view *view;
    nook_fixture_mesh box = { 0 };
    const nook_matrix still = nook_matrix_identity();
    out_found->bound = 0.005;
    nook_result result = open_view(extremes, &view);
    transformed_box(&still, &box);
    if (result == NOOK_OK)
        result = nook_fixture_view_add(view, &box, RESOLUTION, NULL, NULL);
    nook_fixture_mesh_free(&box);
    for (int i = 0; result == NOOK_OK && i < count; i++) {
        const nook_matrix matrix = random_above_floor(&random, i & 1 ? 1.0 : 0.0);
        result = compare_volume(view, &matrix, i, out_found);
        nook_extreme_progress(extremes, (double)i / count);
    }
    nook_fixture_view_destroy(view);
    return result;
}
