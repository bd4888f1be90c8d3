/* What a bake takes of memory: for its voxels, whatever the number of its triangles. */
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

static nook_result bake_cube(const cube *c, uint32_t resolution, nook_extreme_found *out_found)
{
    const nook_triangles triangles = {
        .positions = c->positions, .vertex_count = c->vertex_count, .indices = c->indices, .index_count = c->index_count
    };
    nook_bake baked = { 0 };
    nook_peak_memory peak = nook_peak_memory_begin();
    nook_result result =
        nook_bake_cached(NULL, "cube", &triangles, &(nook_voxelize_desc){ .resolution = resolution }, &baked);
    double bytes = (double)nook_peak_memory_growth(&peak);
    if (result != NOOK_OK)
        return result;
    uint64_t side = resolution, inner = side - 2, shell = side * side * side - inner * inner * inner;
    nook_extreme_worst(out_found, bytes, "%zu triangles at %u voxels a side, %.1f s", c->index_count / 3, resolution,
                       baked.ms / 1000.0);
    if (baked.info.occupied != shell)
        nook_extreme_worst(out_found, INFINITY, "%llu voxels instead of the %llu of a cube's shell",
                           (unsigned long long)baked.info.occupied, (unsigned long long)shell);
    nook_bake_free(&baked);
    return NOOK_OK;
}

static nook_result bake_cells(uint32_t cells, uint32_t resolution, nook_extreme_found *out_found)
{
    const double side = resolution + 2.0, voxels = side * side * side;
    /* ZSTD_estimateCCtxSize_usingCParams of the level and of a file of these voxels, rounded up. */
    const double compressor = resolution <= 128 ? 6.9e6 : 13.2e6, threads = 1e6;
    cube c;
    out_found->bound = 1.25 * voxels + compressor + threads;
    nook_result result = make_cube(cells, &c);
    if (result != NOOK_OK)
        return result;
    result = bake_cube(&c, resolution, out_found);
    free(c.positions);
    free(c.indices);
    return result;
}

static nook_result run_many(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return extremes->quick ? bake_cells(158, 128, out_found) : bake_cells(913, 256, out_found);
}

static nook_result run_largest(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return bake_cells(4, extremes->quick ? 200 : NOOK_VOXELIZE_RESOLUTION_MAX, out_found);
}

#define WHY "a voxel takes 1 + 2/8 bytes, zstd at level 9 13.2 MB by its own estimate, threads 1 MB; a triangle none"

static const nook_extreme cases[] = {
    { .name = "ten million triangles are baked in memory for the voxels alone",
      .unit = "bytes",
      .why = WHY,
      .run = run_many },
    { .name = "a volume of 512 x 512 x 512 voxels is baked in 1.25 bytes a voxel",
      .unit = "bytes",
      .why = WHY,
      .run = run_largest },
};

const nook_extreme_group nook_extreme_memory = { "memory", cases, NOOK_COUNT(cases) };
