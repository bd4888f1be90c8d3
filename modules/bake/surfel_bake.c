#include "modules/bake/surfel_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_cut.h"
#include "modules/bake/surfel_fit.h"
#include <assert.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* A layer of bricks and the surfels in it, in the order of bricks and, in each, of bits. */
typedef struct slab {
    nook_surfel *surfels;
    size_t count, capacity;
} slab;

/* What a worker sums up of the part that it is at. */
typedef struct worker_bins {
    nook_surfel_bins *bins;
} worker_bins;

typedef struct bake {
    nook_surfel_source source;
    uint8_t (*reach)[2]; /* first and last slab of each triangle; a first above the last: it has none */
    nook_brick *bricks;
    slab *slabs;
    worker_bins *workers;
    atomic_bool out_of_memory;
} bake;

/* ---- Slabs ------------------------------------------------------------------------------------------------------ */

static bool reserve(slab *s, size_t count)
{
    if (count > s->capacity) {
        size_t capacity = count > s->capacity + s->capacity / 2 ? count + 256 : s->capacity + s->capacity / 2;
        nook_surfel *grown = realloc(s->surfels, capacity * sizeof *grown);
        if (!grown)
            return false;
        s->surfels = grown;
        s->capacity = capacity;
    }
    return true;
}

static size_t bricks_of_slab(const bake *b)
{
    return (size_t)b->source.counts[0] * b->source.counts[1];
}

/* Sorted bins to surfels and masks. @return false when there is no memory */
static bool fit_slab(bake *b, const nook_surfel_bins *bins, size_t count, size_t slab_index)
{
    nook_surfel_bin voxel_bins[NOOK_SURFEL_BINS_PER_VOXEL];
    nook_brick *bricks = b->bricks + slab_index * bricks_of_slab(b);
    slab *s = &b->slabs[slab_index];
    for (size_t i = 0; i < count;) {
        uint32_t voxel = nook_surfel_bins_voxel(bins, i);
        size_t held = 0;
        for (; i < count && nook_surfel_bins_voxel(bins, i) == voxel; i++)
            voxel_bins[held++] = nook_surfel_bins_get(bins, i);
        nook_surfel surfel;
        if (!nook_surfel_fit(voxel_bins, held, NOOK_LAYER_BIAS / NOOK_SUBVOXEL, &surfel))
            continue;
        if (!reserve(s, s->count + 1))
            return false;
        s->surfels[s->count++] = surfel;
        bricks[voxel >> 6].mask[voxel >> 5 & 1] |= 1u << (voxel & 31);
    }
    return true;
}

/* Bricks whose bins are too many for the memory are made in two halves, one after the other: the same bits. @return NOOK_E_MEMORY */
static nook_result bake_part(bake *b, const nook_surfel_part *part, nook_surfel_bins *bins)
{
    size_t triangle_count = b->source.triangles->index_count / 3, slab_index = (size_t)part->slab;
    nook_result result = NOOK_OK;
    nook_surfel_bins_clear(bins);
    for (size_t t = 0; t < triangle_count && result == NOOK_OK; t++)
        if (b->reach[t][0] <= slab_index && slab_index <= b->reach[t][1])
            result = nook_surfel_cut(&b->source, t, part, bins);
    if (result == NOOK_E_RANGE) {
        nook_surfel_part low = *part, high = *part;
        assert(part->end - part->first > 1);
        low.end = high.first = part->first + (part->end - part->first) / 2;
        result = bake_part(b, &low, bins);
        return result == NOOK_OK ? bake_part(b, &high, bins) : result;
    }
    size_t count = result == NOOK_OK ? nook_surfel_bins_sort(bins) : SIZE_MAX;
    return count != SIZE_MAX && fit_slab(b, bins, count, slab_index) ? NOOK_OK : NOOK_E_MEMORY;
}

static void bake_slabs(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    nook_result result = NOOK_OK;
    for (size_t s = first; s < last && result == NOOK_OK; s++) {
        const nook_surfel_part part = { .slab = (int32_t)s, .end = (uint32_t)bricks_of_slab(b) };
        result = bake_part(b, &part, b->workers[worker].bins);
    }
    if (result != NOOK_OK)
        atomic_store(&b->out_of_memory, true);
}

/* ---- Putting it together ---------------------------------------------------------------------------------------- */

/* A brick alone must fit. */
static uint32_t most_bins(size_t memory)
{
    const size_t least = (size_t)NOOK_BRICK_SIDE * NOOK_BRICK_SIDE * NOOK_BRICK_SIDE * NOOK_SURFEL_BINS_PER_VOXEL;
    size_t bins = (memory ? memory : NOOK_VOXELIZE_MEMORY) / NOOK_SURFEL_BIN_BYTES;
    return (uint32_t)(bins < least ? least : bins < UINT32_MAX / 4 ? bins : UINT32_MAX / 4);
}

static bool allocate(bake *b, unsigned workers, uint32_t bins)
{
    size_t triangles = b->source.triangles->index_count / 3;
    b->reach = malloc(triangles * sizeof *b->reach);
    b->bricks = calloc((size_t)b->source.counts[0] * b->source.counts[1] * b->source.counts[2], sizeof *b->bricks);
    b->slabs = calloc(b->source.counts[2], sizeof *b->slabs);
    b->workers = calloc(workers, sizeof *b->workers);
    bool made = b->reach && b->bricks && b->slabs && b->workers;
    for (unsigned i = 0; made && i < workers; i++) {
        b->workers[i].bins = nook_surfel_bins_create(bins);
        made = b->workers[i].bins != NULL;
    }
    return made;
}

static void release(bake *b, unsigned workers)
{
    for (unsigned i = 0; b->workers && i < workers; i++)
        nook_surfel_bins_destroy(b->workers[i].bins);
    for (uint32_t s = 0; b->slabs && s < b->source.counts[2]; s++)
        free(b->slabs[s].surfels);
    free(b->workers);
    free(b->slabs);
    free(b->reach);
    free(b->bricks);
}

/* @return NULL when there is no memory */
static nook_surfel *join_slabs(const bake *b)
{
    size_t count = 0;
    for (uint32_t s = 0; s < b->source.counts[2]; s++)
        count += b->slabs[s].count;
    nook_surfel *surfels = malloc((count + 1) * sizeof *surfels);
    if (!surfels)
        return NULL;
    count = 0;
    for (uint32_t s = 0; s < b->source.counts[2]; s++) {
        if (b->slabs[s].count)
            memcpy(surfels + count, b->slabs[s].surfels, b->slabs[s].count * sizeof *surfels);
        count += b->slabs[s].count;
    }
    return surfels;
}

nook_result nook_surfel_bake(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                             const nook_grid_frame *frame, nook_volume *out_volume)
{
    nook_alpha_areas *areas = nook_alpha_areas_create(desc->alphas);
    bake b = { .source = { .triangles = triangles, .alphas = desc->alphas, .areas = areas, .frame = frame } };
    nook_brick_counts(&(nook_volume_info){ .width = frame->size[0], .height = frame->size[1], .depth = frame->size[2] },
                      b.source.counts);
    unsigned workers = nook_parallel_workers(b.source.counts[2], desc->threads);
    nook_surfel *surfels = NULL;
    if (areas && allocate(&b, workers, most_bins(desc->memory))) {
        nook_surfel_find_reach(&b.source, desc->threads, b.reach);
        nook_parallel_for(b.source.counts[2], desc->threads, bake_slabs, &b);
        surfels = atomic_load(&b.out_of_memory) ? NULL : join_slabs(&b);
    }
    if (surfels) {
        uint64_t occupied = nook_bricks_number(b.bricks, b.source.counts);
        *out_volume = (nook_volume){ .info = { .occupied = occupied }, .bricks = b.bricks, .surfels = surfels };
        b.bricks = NULL;
    }
    release(&b, workers);
    nook_alpha_areas_destroy(areas);
    return surfels
               ? NOOK_OK
               : nook_fail(NOOK_E_MEMORY, "voxelize: no memory for surfels in %ux%ux%u voxels; lower the resolution",
                           frame->size[0], frame->size[1], frame->size[2]);
}
