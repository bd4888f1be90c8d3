/* What bakes and volumes take of memory: for their voxels, whatever the number of triangles. */
#include "game/extremes/edge_receiver.h"
#include "game/extremes/groups.h"
#include "game/extremes/peak_memory.h"
#include "modules/bake/cache.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A unit cube whose faces are grids of `cells` x `cells` pairs of triangles; vertices of a face are shared. */
typedef struct cube {
    float *positions;
    uint32_t *indices;
    uint32_t vertex_count;
    size_t index_count;
} cube;

static void fill_face(cube *c, int face, uint32_t cells)
{
    uint32_t line = cells + 1, first = (uint32_t)face * line * line;
    int axis = face / 2;
    for (uint32_t v = 0; v < line; v++) {
        for (uint32_t u = 0; u < line; u++) {
            float *at = c->positions + 3 * ((size_t)first + v * line + u);
            at[axis] = (float)(face % 2);
            at[(axis + 1) % 3] = (float)((double)u / cells);
            at[(axis + 2) % 3] = (float)((double)v / cells);
        }
    }
    uint32_t *out = c->indices + (size_t)face * cells * cells * 6;
    for (uint32_t v = 0; v < cells; v++) {
        for (uint32_t u = 0; u < cells; u++) {
            uint32_t a = first + v * line + u;
            const uint32_t pair[6] = { a, a + 1, a + line, a + line, a + 1, a + line + 1 };
            memcpy(out, pair, sizeof pair);
            out += 6;
        }
    }
}

static nook_result make_cube(uint32_t cells, cube *out)
{
    uint32_t line = cells + 1;
    cube c = { .vertex_count = 6 * line * line, .index_count = (size_t)36 * cells * cells };
    c.positions = malloc(3 * sizeof(float) * c.vertex_count);
    c.indices = malloc(sizeof(uint32_t) * c.index_count);
    if (!c.positions || !c.indices) {
        free(c.positions);
        free(c.indices);
        return nook_fail(NOOK_E_MEMORY, "extremes: no memory for %zu triangles to bake", c.index_count / 3);
    }
    for (int face = 0; face < 6; face++)
        fill_face(&c, face, cells);
    *out = c;
    return NOOK_OK;
}

/* What is to be baked, and what that took: of a process of its own. */
typedef struct bake_task {
    uint32_t cells, resolution;
} bake_task;

typedef struct bake_answer {
    uint64_t own, with_input; /* bytes: the baker's alone, and with the arrays that it is given */
    uint64_t input;           /* bytes of those arrays */
    uint64_t triangles, occupied;
    double ms;
} bake_answer;

static nook_result bake_cube(const cube *c, uint32_t resolution, bake_answer *out)
{
    const nook_triangles triangles = {
        .positions = c->positions, .vertex_count = c->vertex_count, .indices = c->indices, .index_count = c->index_count
    };
    nook_bake baked = { 0 };
    nook_result result = nook_bake_cached(NULL, "cube", &triangles,
                                          &(nook_voxelize_desc){ .resolution = resolution, .threads = 4 }, &baked);
    if (result != NOOK_OK)
        return result;
    out->occupied = baked.info.occupied;
    out->ms = baked.ms;
    nook_bake_free(&baked);
    return NOOK_OK;
}

static void free_cube(cube *c)
{
    free(c->positions);
    free(c->indices);
}

/* A new process has no page of code yet, and code is not what is measured: a bake of next to nothing brings it in. */
static nook_result warm_up(void)
{
    cube c;
    bake_answer unused;
    nook_result result = make_cube(1, &c);
    if (result != NOOK_OK)
        return result;
    result = bake_cube(&c, 16, &unused);
    free_cube(&c);
    return result;
}

/* What baking it takes above `before`. */
static nook_result bake_measured(const cube *c, uint32_t resolution, const nook_memory *before, bake_answer *out)
{
    nook_memory loaded, after = { 0 };
    nook_result result = nook_memory_read(&loaded);
    if (result == NOOK_OK)
        result = bake_cube(c, resolution, out);
    if (result == NOOK_OK)
        result = nook_memory_read(&after);
    if (result != NOOK_OK)
        return result;
    out->own = nook_peak_memory_ours(after.peak - loaded.resident);
    out->with_input = nook_peak_memory_ours(after.peak - before->resident);
    return NOOK_OK;
}

/* In the child. */
static nook_result bake_alone(const void *user, void *out)
{
    const bake_task *task = user;
    bake_answer *answer = out;
    nook_memory before;
    cube c;
    nook_result result = warm_up();
    if (result == NOOK_OK)
        result = nook_memory_read(&before);
    if (result == NOOK_OK)
        result = make_cube(task->cells, &c);
    if (result != NOOK_OK)
        return result;
    answer->input = 3 * sizeof(float) * (uint64_t)c.vertex_count + sizeof(uint32_t) * (uint64_t)c.index_count;
    answer->triangles = c.index_count / 3;
    result = bake_measured(&c, task->resolution, &before, answer);
    free_cube(&c);
    return result;
}

static nook_result bake_cells(uint32_t cells, uint32_t resolution, nook_extreme_found *out_found)
{
    const bake_task task = { cells, resolution };
    const double side = resolution + 2.0, voxels = side * side * side;
    /* ZSTD_estimateCCtxSize_usingCParams of the level and of a file of these voxels, rounded up. */
    const double compressor = resolution <= 128 ? 6.9e6 : 13.2e6, threads = 1e6;
    const uint64_t inner = resolution - 2,
                   shell = (uint64_t)resolution * resolution * resolution - inner * inner * inner;
    bake_answer answer;
    out_found->bound = 1.25 * voxels + compressor + threads;
    nook_result result = nook_run_in_child(bake_alone, &task, &answer, sizeof answer);
    if (result != NOOK_OK)
        return result;
    nook_extreme_worst(
        out_found, fmax((double)answer.own, (double)answer.with_input - (double)answer.input),
        "%llu triangles at %u voxels a side, %.1f s: %.1f MB of its own, %.1f MB with the arrays it is given",
        (unsigned long long)answer.triangles, resolution, answer.ms / 1000.0, (double)answer.own * 1e-6,
        (double)answer.with_input * 1e-6);
    if (answer.own == 0)
        return nook_fail(NOOK_E_IO, "extremes: a bake that takes no memory was not measured");
    if (answer.occupied != shell)
        nook_extreme_worst(out_found, INFINITY, "%llu voxels instead of the %llu of a cube's shell",
                           (unsigned long long)answer.occupied, (unsigned long long)shell);
    return NOOK_OK;
}

static nook_result run_many(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return extremes->quick ? bake_cells(158, 128, out_found) : bake_cells(913, 256, out_found);
}

static nook_result run_largest(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return bake_cells(4, extremes->quick ? 200 : NOOK_VOXELIZE_RESOLUTION_MAX, out_found);
}

/* ---- On the GPU ------------------------------------------------------------------------------------------------- */

/* A body of 1 x 1 x 1 voxels that are `side` long along the axes of `along`, as the only volume. */
static nook_result upload_alone(nook_edge_receiver *receiver, uint32_t side, int along)
{
    double high[3], voxels = 1.0;
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_occlusion unused;
    nook_ao_statistics statistics;
    for (int axis = 0; axis < 3; axis++) {
        high[axis] = along >> axis & 1 ? 1.0 : 1.0 / side;
        voxels *= along >> axis & 1 ? side + 2.0 : 3.0;
    }
    nook_fixture_view_drop_occluders(receiver->view);
    nook_fixture_add_box(&mesh, (double[]){ 0, 0, 0 }, high, 63);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, side, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    if (result == NOOK_OK)
        result = nook_edge_receiver_measure(receiver, &unused, "%u voxels along axes %d", side, along);
    if (result != NOOK_OK)
        return result;
    nook_ao_get_statistics(receiver->view->ao, &statistics);
    nook_extreme_worst(receiver->found, (double)statistics.volume_bytes / voxels, "%u voxels along axes %d: %llu bytes",
                       side, along, (unsigned long long)statistics.volume_bytes);
    return NOOK_OK;
}

/* All volumes lie in one texture, which is a box: three needles along the axes span all of it. */
static nook_result upload_needles(nook_edge_receiver *receiver, nook_extreme_found *found)
{
    const uint32_t side = NOOK_VOXELIZE_RESOLUTION_MAX;
    nook_fixture_occlusion unused;
    nook_ao_statistics statistics;
    nook_result result = NOOK_OK;
    nook_fixture_view_drop_occluders(receiver->view);
    for (int along = 0; along < 3 && result == NOOK_OK; along++) {
        nook_fixture_mesh mesh = { 0 };
        double high[3] = { 1.0 / side, 1.0 / side, 1.0 / side };
        high[along] = 1.0;
        nook_fixture_add_box(&mesh, (double[]){ 0, 0, 0 }, high, 63);
        result = nook_fixture_view_add(receiver->view, &mesh, side, NULL, NULL);
        nook_fixture_mesh_free(&mesh);
    }
    if (result == NOOK_OK)
        result = nook_edge_receiver_measure(receiver, &unused, "three needles");
    if (result != NOOK_OK)
        return result;
    nook_ao_get_statistics(receiver->view->ao, &statistics);
    nook_extreme_state(found, 137.0, 1.0, (double)statistics.volume_bytes * 1e-6,
                       "MB of three needles of %u voxels along x, y and z", side);
    return NOOK_OK;
}

static nook_result run_alone(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const uint32_t sides[] = { 1, 2, 17, 64, 511, NOOK_VOXELIZE_RESOLUTION_MAX };
    nook_edge_receiver receiver;
    out_found->bound = 1.0;
    nook_result result = nook_edge_receiver_make(extremes, out_found, &receiver);
    if (result == NOOK_OK)
        result = nook_edge_receiver_set(&receiver, 2.0, "volume rays=1");
    for (int k = 0; k < (int)NOOK_COUNT(sides) * 7 && result == NOOK_OK; k++) {
        int along = 1 + k % 7;
        if (!extremes->quick || sides[k / 7] <= 64 || (sides[k / 7] == NOOK_VOXELIZE_RESOLUTION_MAX && along < 7))
            result = upload_alone(&receiver, sides[k / 7], along);
    }
    if (result == NOOK_OK)
        result = upload_needles(&receiver, out_found);
    nook_edge_receiver_free(&receiver);
    return result;
}

#define WHY                                                                                                          \
    "a voxel takes 1 + 2/8 bytes, zstd at level 9 13.2 MB by its own estimate, 4 threads 1 MB; a triangle none but " \
    "its own arrays"

static const nook_extreme cases[] = {
    { .name = "10 million triangles, 300 thousand with --quick, are baked in memory for the voxels alone",
      .unit = "bytes",
      .why = WHY,
      .run = run_many },
    { .name = "a volume of 512 x 512 x 512 voxels is baked in 1.25 bytes a voxel",
      .unit = "bytes",
      .why = WHY,
      .run = run_largest },
    { .name = "a cube, slab or needle of 1 to 512 voxels takes a byte a voxel on the GPU",
      .unit = "bytes a voxel",
      .why = "the texture is as large as the volume with its border of one voxel: exactly 1",
      .limit = "All volumes lie in one 3D texture: three needles of 512 voxels along x, y and z take the 137 MB of the "
               "box around them.",
      .run = run_alone },
};

const nook_extreme_group nook_extreme_memory = { "memory", cases, NOOK_COUNT(cases) };
