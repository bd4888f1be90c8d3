#include "modules/bake/surfel_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_cut.h"
#include "modules/bake/surfel_fit.h"
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* A layer of bricks and the surfels in it, in the order of bricks and, in each, of bits. */
typedef struct slab {
    nook_surfel *surfels;
    size_t count, capacity;
} slab;

/* What lies in the slab that a worker is at. */
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

/* ---- Which triangle lies where ---------------------------------------------------------------------------------- */

static void find_reach(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    (void)worker;
    for (size_t t = first; t < last; t++) {
        int32_t slabs[2] = { 1, 0 };
        nook_surfel_reach(&b->source, t, slabs);
        b->reach[t][0] = (uint8_t)slabs[0];
        b->reach[t][1] = (uint8_t)slabs[1];
    }
}

/* ---- Slabs ------------------------------------------------------------------------------------------------------ */

static bool append_surfel(slab *s, const nook_surfel *surfel)
{
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? s->capacity + s->capacity / 2 : 256;
        nook_surfel *grown = realloc(s->surfels, capacity * sizeof *grown);
        if (!grown)
            return false;
        s->surfels = grown;
        s->capacity = capacity;
    }
    s->surfels[s->count++] = *surfel;
    return true;
}

/* Sorted bins to surfels and masks. */
static bool fit_slab(bake *b, const nook_surfel_bins *bins, size_t count, size_t slab_index)
{
    nook_surfel_bin voxel_bins[NOOK_SURFEL_BINS_PER_VOXEL];
    nook_brick *bricks = b->bricks + slab_index * b->source.counts[0] * b->source.counts[1];
    for (size_t i = 0; i < count;) {
        uint32_t voxel = nook_surfel_bins_voxel(bins, i);
        size_t held = 0;
        for (; i < count && nook_surfel_bins_voxel(bins, i) == voxel; i++)
            voxel_bins[held++] = nook_surfel_bins_get(bins, i);
        nook_surfel surfel;
        if (!nook_surfel_fit(voxel_bins, held, &surfel))
            continue;
        if (!append_surfel(&b->slabs[slab_index], &surfel))
            return false;
        bricks[voxel >> 6].mask[voxel >> 5 & 1] |= 1u << (voxel & 31);
    }
    return true;
}

/* @return false when there is no memory */
static bool bake_slab(bake *b, size_t slab_index, nook_surfel_bins *bins)
{
    size_t triangle_count = b->source.triangles->index_count / 3;
    nook_surfel_bins_clear(bins);
    for (size_t t = 0; t < triangle_count; t++)
        if (b->reach[t][0] <= slab_index && slab_index <= b->reach[t][1] &&
            nook_surfel_cut(&b->source, t, (int32_t)slab_index, bins) != NOOK_OK)
            return false;
    size_t count = nook_surfel_bins_sort(bins);
    return count != SIZE_MAX && fit_slab(b, bins, count, slab_index);
}

static void bake_slabs(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    bool done = true;
    for (size_t s = first; s < last && done; s++)
        done = bake_slab(b, s, b->workers[worker].bins);
    if (!done)
        atomic_store(&b->out_of_memory, true);
}

/* ---- Putting it together ---------------------------------------------------------------------------------------- */

static bool allocate(bake *b, unsigned workers)
{
    size_t triangles = b->source.triangles->index_count / 3;
    b->reach = malloc(triangles * sizeof *b->reach);
    b->bricks = calloc((size_t)b->source.counts[0] * b->source.counts[1] * b->source.counts[2], sizeof *b->bricks);
    b->slabs = calloc(b->source.counts[2], sizeof *b->slabs);
    b->workers = calloc(workers, sizeof *b->workers);
    bool made = b->reach && b->bricks && b->slabs && b->workers;
    for (unsigned i = 0; made && i < workers; i++) {
        b->workers[i].bins = nook_surfel_bins_create();
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

nook_result nook_surfel_bake(const nook_triangles *triangles, const nook_alphas *alphas, unsigned threads,
                             const nook_grid_frame *frame, nook_volume *out_volume)
{
    nook_alpha_areas *areas = nook_alpha_areas_create(alphas);
    bake b = { .source = { .triangles = triangles, .alphas = alphas, .areas = areas, .frame = frame } };
    nook_brick_counts(&(nook_volume_info){ .width = frame->size[0], .height = frame->size[1], .depth = frame->size[2] },
                      b.source.counts);
    unsigned workers = nook_parallel_workers(b.source.counts[2], threads);
    nook_surfel *surfels = NULL;
    if (areas && allocate(&b, workers)) {
        nook_parallel_for(triangles->index_count / 3, threads, find_reach, &b);
        nook_parallel_for(b.source.counts[2], threads, bake_slabs, &b);
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
