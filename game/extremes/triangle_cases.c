/* Triangles as files bring them: without area, twice, a million times longer than wide, not finite. */
#include "engine/core/vector.h"
#include "game/extremes/groups.h"
#include "modules/bake/voxelize.h"
#include "modules/fixture/mesh.h"
#include <math.h>
#include <string.h>

static const uint32_t resolutions[] = { 5, 64, 128 };

static size_t resolution_count(const nook_extremes *extremes)
{
    return extremes->quick ? 2 : NOOK_COUNT(resolutions);
}

/* ---- Bakes and how they differ ---------------------------------------------------------------------------------- */

static nook_result bake(const nook_fixture_mesh *mesh, uint32_t resolution, nook_volume *out_volume)
{
    if (mesh->out_of_memory)
        return nook_fail(NOOK_E_MEMORY, "extremes: no memory for triangles to bake");
    const nook_triangles triangles = { .positions = mesh->positions,
                                       .vertex_count = mesh->vertex_count,
                                       .indices = mesh->indices,
                                       .index_count = mesh->index_count };
    return nook_voxelize(&triangles, &(nook_voxelize_desc){ .resolution = resolution }, out_volume);
}

/* Voxels that are not the same; all of them when the grids are not. */
static uint64_t count_different(const nook_volume *a, const nook_volume *b)
{
    const nook_volume_info *p = &a->info, *q = &b->info;
    uint64_t count = (uint64_t)p->width * p->height * p->depth, different = 0;
    if (p->width != q->width || p->height != q->height || p->depth != q->depth || p->voxel_size != q->voxel_size ||
        memcmp(p->origin, q->origin, sizeof p->origin) != 0)
        return count;
    for (uint64_t i = 0; i < count; i++)
        different += a->voxels[i] != b->voxels[i];
    return different;
}

/* Bakes both meshes at each resolution. */
static nook_result compare_bakes(const nook_extremes *extremes, const nook_fixture_mesh *mesh,
                                 const nook_fixture_mesh *other, const char *what, nook_extreme_found *out_found)
{
    for (size_t i = 0; i < resolution_count(extremes); i++) {
        nook_volume a = { 0 }, b = { 0 };
        nook_result result = bake(mesh, resolutions[i], &a);
        if (result == NOOK_OK)
            result = bake(other, resolutions[i], &b);
        if (result == NOOK_OK)
            nook_extreme_worst(out_found, (double)count_different(&a, &b), "%s at %u voxels a side", what,
                               resolutions[i]);
        nook_volume_free(&a);
        nook_volume_free(&b);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

/* ---- What is baked ---------------------------------------------------------------------------------------------- */

/* Closed. */
static void add_ball(nook_fixture_mesh *mesh)
{
    nook_fixture_add_sphere(mesh, (double[]){ 0.3, -0.2, 0.1 }, 1.0, 48);
}

/* Open, and askew in the voxels: a rectangle, its edges at right angles. */
static const double sheet_corner[3] = { -1.2, -0.9, 0.4 },
                    sheet_edges[2][3] = { { 2.0, 0.5, 0.7 }, { -0.5, 2.0, 0.0 } };

static void add_askew_sheet(nook_fixture_mesh *mesh)
{
    nook_fixture_add_quad(mesh, sheet_corner, sheet_edges[0], sheet_edges[1]);
}

static void corner_of(const nook_fixture_mesh *mesh, uint32_t index, double out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = mesh->positions[3 * mesh->indices[index] + (uint32_t)axis];
}

static void copy_triangle(const nook_fixture_mesh *from, uint32_t first, const uint32_t order[3],
                          nook_fixture_mesh *mesh)
{
    double corner[3][3];
    for (uint32_t i = 0; i < 3; i++)
        corner_of(from, first + order[i], corner[i]);
    nook_fixture_add_triangle(mesh, corner[0], corner[1], corner[2]);
}

static const uint32_t in_order[3] = { 0, 1, 2 }, turned[3] = { 2, 1, 0 }, rotated[3] = { 1, 2, 0 };

typedef void (*add_bad)(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh);

/* A body with bad triangles between its own. */
static nook_fixture_mesh mix(const nook_fixture_mesh *body, add_bad add)
{
    nook_fixture_mesh mesh = { 0 };
    for (uint32_t first = 0; first < body->index_count; first += 3) {
        copy_triangle(body, first, in_order, &mesh);
        add(body, first, &mesh);
    }
    return mesh;
}

static nook_result compare_with(const nook_extremes *extremes, const char *what, add_bad add,
                                nook_extreme_found *out_found)
{
    nook_fixture_mesh body = { 0 };
    add_ball(&body);
    nook_fixture_mesh mesh = mix(&body, add);
    nook_result result = compare_bakes(extremes, &body, &mesh, what, out_found);
    nook_fixture_mesh_free(&body);
    nook_fixture_mesh_free(&mesh);
    return result;
}

/* ---- Degenerate ------------------------------------------------------------------------------------------------- */

static void add_points(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh)
{
    for (uint32_t i = 0; i < 3; i++)
        copy_triangle(body, first, (uint32_t[]){ i, i, i }, mesh);
}

static void add_segments(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh)
{
    for (uint32_t i = 0; i < 3; i++)
        copy_triangle(body, first, (uint32_t[]){ i, (i + 1) % 3, (i + 1) % 3 }, mesh);
}

/* Three points of an edge: not quite in line, because the middle is rounded to float. */
static void add_slivers(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh)
{
    for (uint32_t i = 0; i < 3; i++) {
        double a[3], b[3], between[3];
        corner_of(body, first + i, a);
        corner_of(body, first + (i + 1) % 3, b);
        for (int axis = 0; axis < 3; axis++)
            between[axis] = 0.3 * a[axis] + 0.7 * b[axis];
        nook_fixture_add_triangle(mesh, a, between, b);
    }
}

static nook_result run_degenerate(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_result result = compare_with(extremes, "points on every corner", add_points, out_found);
    if (result == NOOK_OK)
        result = compare_with(extremes, "segments along every edge", add_segments, out_found);
    if (result == NOOK_OK)
        result = compare_with(extremes, "three points in line on every edge", add_slivers, out_found);
    return result;
}

/* Voxels from a point to the sheet. */
static double distance_to_sheet(const double point[3], double voxel_size)
{
    double nearest[3], between[3];
    nook_vector_add_scaled(point, -1.0, sheet_corner, between);
    memcpy(nearest, sheet_corner, sizeof nearest);
    for (int i = 0; i < 2; i++) {
        const double *edge = sheet_edges[i];
        double along = nook_vector_dot(between, edge) / nook_vector_dot(edge, edge);
        nook_vector_add_scaled(nearest, fmin(fmax(along, 0.0), 1.0), edge, nearest);
    }
    nook_vector_add_scaled(point, -1.0, nearest, between);
    return nook_vector_length(between) / voxel_size;
}

/* The worst voxel that stands in one volume and not in the other; a voxel that is lost is infinitely bad. */
static void compare_with_sheet(const nook_volume *plain, const nook_volume *volume, const char *what,
                               nook_extreme_found *out_found)
{
    const nook_volume_info *info = &plain->info;
    const size_t count = (size_t)info->width * info->height * info->depth;
    nook_extreme_worst(out_found, 0.0, "%s at %u voxels a side: nothing differs", what, info->width - 2);
    for (size_t i = 0; i < count; i++) {
        if (plain->voxels[i] == volume->voxels[i])
            continue;
        const size_t voxel[3] = { i % info->width, i / info->width % info->height, i / info->width / info->height };
        double centre[3];
        for (int axis = 0; axis < 3; axis++)
            centre[axis] = info->origin[axis] + ((double)voxel[axis] + 0.5) * info->voxel_size;
        nook_extreme_worst(out_found, volume->voxels[i] ? distance_to_sheet(centre, info->voxel_size) : INFINITY,
                           "%s at %u voxels a side", what, info->width - 2);
    }
}

static nook_result run_rim(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const add_bad kinds[] = { add_points, add_segments, add_slivers };
    static const char *const names[] = { "points", "segments", "three points in line" };
    nook_result result = NOOK_OK;
    out_found->bound = 0.5 * sqrt(3.0);
    nook_fixture_mesh sheet = { 0 };
    add_askew_sheet(&sheet);
    for (size_t i = 0; i < resolution_count(extremes) * NOOK_COUNT(kinds) && result == NOOK_OK; i++) {
        uint32_t resolution = resolutions[i / NOOK_COUNT(kinds)];
        nook_fixture_mesh mesh = mix(&sheet, kinds[i % NOOK_COUNT(kinds)]);
        nook_volume plain = { 0 }, volume = { 0 };
        result = bake(&sheet, resolution, &plain);
        if (result == NOOK_OK)
            result = bake(&mesh, resolution, &volume);
        if (result == NOOK_OK)
            compare_with_sheet(&plain, &volume, names[i % NOOK_COUNT(kinds)], out_found);
        nook_volume_free(&plain);
        nook_volume_free(&volume);
        nook_fixture_mesh_free(&mesh);
    }
    nook_fixture_mesh_free(&sheet);
    return result;
}

/* ---- Twice ------------------------------------------------------------------------------------------------------ */

static void add_twins(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh)
{
    copy_triangle(body, first, in_order, mesh);
    copy_triangle(body, first, turned, mesh);
    copy_triangle(body, body->index_count - 3 - first, rotated, mesh);
}

static nook_result run_duplicates(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return compare_with(extremes, "every triangle four times, turned and rotated", add_twins, out_found);
}

/* ---- Not finite ------------------------------------------------------------------------------------------------- */

static void add_not_finite(const nook_fixture_mesh *body, uint32_t first, nook_fixture_mesh *mesh)
{
    static const float bad[] = { NAN, INFINITY, -INFINITY };
    uint32_t i = first / 3;
    copy_triangle(body, first, in_order, mesh);
    if (mesh->out_of_memory)
        return;
    /* Over all triangles: each of nine numbers in turn, and more of them in some. */
    float *corners = mesh->positions + 3 * (mesh->vertex_count - 3);
    corners[i % 9] = bad[i % 3];
    if (i % 5 == 0)
        corners[(i + 4) % 9] = bad[(i + 1) % 3];
}

/* The baker warns of each, as it should; here it is told them on purpose. */
static void stay_silent(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)user, (void)level, (void)file, (void)line, (void)text;
}

static nook_result run_not_finite(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_log_set_sink(stay_silent, NULL);
    nook_result result =
        compare_with(extremes, "a NaN or infinite corner in every other triangle", add_not_finite, out_found);
    nook_log_set_sink(NULL, NULL);
    return result;
}

/* ---- Needles ---------------------------------------------------------------------------------------------------- */

enum { NEEDLES = 1000 };
static const double needle_width = 1e-6; /* of a length of 1 */

/* A sheet of 1 x 1, spanned by u and v; a stripe in its middle is of needles when wanted. */
static void add_sheet(nook_fixture_mesh *mesh, const double corner[3], const double u[3], const double v[3],
                      bool with_needles)
{
    double low[3], high[3], width[3], rest[3];
    const double stripe = NEEDLES * needle_width, below = 0.5 - 0.5 * stripe;
    nook_vector_add_scaled(corner, below, v, low);
    nook_vector_add_scaled(low, stripe, v, high);
    for (int axis = 0; axis < 3; axis++) {
        width[axis] = v[axis] * (with_needles ? needle_width : stripe);
        rest[axis] = v[axis] * below;
    }
    nook_fixture_add_quad(mesh, corner, u, rest);
    nook_fixture_add_quad(mesh, high, u, rest);
    for (int i = 0; i < (with_needles ? NEEDLES : 1); i++) {
        double at[3];
        nook_vector_add_scaled(low, i, width, at);
        nook_fixture_add_quad(mesh, at, u, width);
    }
}

/* Along two axes: coordinates of a slanted sheet are rounded to float, and needles then are no parts of it. */
static nook_result run_needle_sheet(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_result result = NOOK_OK;
    for (int axis = 0; axis < 3 && result == NOOK_OK; axis++) {
        nook_fixture_mesh plain = { 0 }, needles = { 0 };
        double u[3] = { 0, 0, 0 }, v[3] = { 0, 0, 0 }, corner[3] = { 0, 0, 0 };
        u[axis] = 1.0, v[(axis + 1) % 3] = 1.0, corner[(axis + 2) % 3] = 0.25;
        add_sheet(&plain, corner, u, v, false);
        add_sheet(&needles, corner, u, v, true);
        result = compare_bakes(extremes, &plain, &needles, "a stripe of 1000 needles in a sheet", out_found);
        nook_fixture_mesh_free(&plain);
        nook_fixture_mesh_free(&needles);
    }
    return result;
}

/* Voxels, along the axis where it is largest, from a point to the nearest voxel that is set. */
static double distance_to_set(const nook_volume *volume, const double point[3])
{
    const nook_volume_info *info = &volume->info;
    const uint32_t size[3] = { info->width, info->height, info->depth };
    int64_t voxel[3];
    for (int axis = 0; axis < 3; axis++)
        voxel[axis] = (int64_t)floor((point[axis] - info->origin[axis]) / info->voxel_size);
    for (int64_t radius = 0; radius < (int64_t)size[0] + size[1] + size[2]; radius++) {
        for (int64_t z = voxel[2] - radius; z <= voxel[2] + radius; z++)
            for (int64_t y = voxel[1] - radius; y <= voxel[1] + radius; y++)
                for (int64_t x = voxel[0] - radius; x <= voxel[0] + radius; x++) {
                    bool inside = x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
                    if (inside && volume->voxels[((size_t)z * size[1] + (size_t)y) * size[0] + (size_t)x])
                        return (double)radius;
                }
    }
    return INFINITY;
}

static nook_result run_lone_needle(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double tips[][3] = {
        { 1, 0, 0 }, { 1, 1, 1 }, { 1, 0.37, 0.011 }, { -0.2, 1, 0.6 }, { 0.5, 0.5, -1 }
    };
    enum { POINTS = 997 };
    out_found->bound = 1.0;
    for (size_t k = 0; k < NOOK_COUNT(tips); k++) {
        const double *tip = tips[k], foot[3] = { 0, 0, 0 }, side[3] = { -1e-6 * tip[1], 1e-6 * tip[0], 0 };
        nook_fixture_mesh needle = { 0 };
        nook_fixture_add_triangle(&needle, foot, tip, side);
        nook_result result = NOOK_OK;
        for (size_t i = 0; i < resolution_count(extremes) && result == NOOK_OK; i++) {
            nook_volume volume = { 0 };
            result = bake(&needle, resolutions[i], &volume);
            for (int point = 0; point < POINTS && result == NOOK_OK; point++) {
                double at[3];
                nook_vector_add_scaled(foot, (point + 0.5) / POINTS, tip, at);
                nook_extreme_worst(out_found, distance_to_set(&volume, at), "needle %zu at %u voxels, at %.3f of it", k,
                                   resolutions[i], (point + 0.5) / POINTS);
            }
            nook_volume_free(&volume);
        }
        nook_fixture_mesh_free(&needle);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

static const nook_extreme cases[] = {
    { .name = "triangles without area that lie on a closed body change none of its voxels",
      .unit = "voxels that differ",
      .why = "what they mark, the triangles beside them mark already: nothing may differ",
      .run = run_degenerate },
    { .name = "triangles without area on the rim of an open sheet add only voxels that it crosses",
      .unit = "voxels to the sheet",
      .why = "they are kept, as wires are; the centre of a voxel that is crossed is within half its diagonal",
      .run = run_rim },
    { .name = "the same triangles again change no voxel",
      .unit = "voxels that differ",
      .why = "a voxel is set or not, in whatever order: nothing may differ",
      .run = run_duplicates },
    { .name = "triangles that are not finite are left out, and nothing else is",
      .unit = "voxels that differ",
      .why = "neither the grid nor a voxel may know of them: nothing may differ",
      .run = run_not_finite },
    { .name = "a sheet with needles of 1 : 1000000 in it has the voxels of a plain one",
      .unit = "voxels that differ",
      .why = "coverage is decided in integers of 1/65536 voxel, and common edges leave no gap: nothing may differ",
      .run = run_needle_sheet },
    { .name = "a lone needle of 1 : 1000000 is marked along all of its length",
      .unit = "voxels to a set one",
      .why = "it is walked in steps of half a voxel; a voxel that it meets is set or shares a face with one that is",
      .run = run_lone_needle },
};

const nook_extreme_group nook_extreme_triangles = { "triangles", cases, NOOK_COUNT(cases) };
