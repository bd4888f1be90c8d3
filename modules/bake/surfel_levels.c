#include "modules/bake/surfel_levels.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_bake.h"
#include "modules/bake/surfel_cut.h"
#include "modules/bake/surfel_fit.h"
#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = NOOK_VOXELIZE_LEVELS };

/* A surfel and its place: number of the brick in its grid << 6 | bit. There are at most 129^3 bricks. */
typedef struct record {
    uint32_t place;
    nook_surfel surfel;
} record;

typedef struct records {
    record *items;
    size_t count, capacity;
} records;

/* What a worker sums up of the unit that it is at, and all surfels that it has made, in any order. */
typedef struct level_worker {
    nook_surfel_bins *bins[LEVELS];
    records made[LEVELS];
} level_worker;

typedef struct level_grid {
    uint32_t counts[3]; /* bricks */
    double bias;        /* where layers end, in voxels below their faces */
    bool wanted;
} level_grid;

typedef struct pass {
    nook_surfel_source source;
    uint32_t coarsest; /* the last level that is wanted */
    level_grid grids[LEVELS];
    uint8_t (*reach)[2];              /* of each triangle, slabs of level 0 */
    uint32_t pieces;                  /* units of a slab of the coarsest level */
    size_t memory;                    /* of a worker */
    const nook_surfel_before *before; /* of each level; NULL: all is made */
    level_worker *workers;
    atomic_bool out_of_memory;
} pass;

/* Some bricks of a slab of the coarsest level, and all that is merged into them. */
typedef struct unit {
    uint32_t slab, first, end;
    const uint8_t *wanted; /* of the slab's bricks, 0: stays as it was; NULL: all are made */
} unit;

/* ---- One level of a unit ----------------------------------------------------------------------------------------- */

static bool append(records *made, uint32_t place, nook_surfel surfel)
{
    if (made->count == made->capacity) {
        size_t capacity = made->capacity ? made->capacity + made->capacity / 2 : 1024;
        record *grown = realloc(made->items, capacity * sizeof *grown);
        if (!grown)
            return false;
        made->items = grown;
        made->capacity = capacity;
    }
    made->items[made->count++] = (record){ place, surfel };
    return true;
}

/* Whether a brick of a level may be another one than before. */
static bool is_changed(const pass *p, uint32_t level, size_t brick)
{
    return !p->before || p->before[level].changed[brick];
}

/* The first slab of a level in which something of a unit may lie. */
static uint32_t first_slab(const pass *p, const unit *u, uint32_t level)
{
    int32_t layer = (int32_t)u->slab * NOOK_BRICK_SIDE, merges = (int32_t)(p->coarsest - level);
    return layer > 0 ? (uint32_t)(((layer - 1) << merges) + 1) / NOOK_BRICK_SIDE : 0;
}

/* Where a bit lies in its brick along an axis, in voxels. */
static uint32_t in_brick(uint32_t bit, uint32_t axis)
{
    return (bit >> axis & 1) | (bit >> (axis + 2) & 2);
}

/* Where a voxel's bins are merged to. @param place  its own: brick in its grid << 6 | bit */
static uint32_t parent_of(const pass *p, const unit *u, uint32_t level, uint32_t place, int side[3])
{
    const uint32_t *counts = p->grids[level].counts, *above = p->grids[level + 1].counts, brick = place >> 6;
    const uint32_t corner[3] = { brick % counts[0], brick / counts[0] % counts[1], brick / counts[0] / counts[1] };
    uint32_t at[3];
    for (uint32_t axis = 0; axis < 3; axis++) {
        int32_t layer = (int32_t)(corner[axis] * NOOK_BRICK_SIDE + in_brick(place, axis));
        side[axis] = layer & 1 ? -1 : 1; /* the border is one voxel: 1 and 2 become 1 */
        at[axis] = (uint32_t)nook_grid_level_layer(layer, 1);
    }
    uint32_t slab = at[2] / NOOK_BRICK_SIDE - first_slab(p, u, level + 1);
    uint32_t parent = (slab * above[1] + at[1] / NOOK_BRICK_SIDE) * above[0] + at[0] / NOOK_BRICK_SIDE;
    return parent << 6 | nook_brick_bit(at[0], at[1], at[2]);
}

/*
 * Makes the surfels of a level of which all bins are there, and adds those to the next one.
 * @param slab  the bins' voxels are numbered from its first brick on @return as nook_surfel_bins_add
 */
static nook_result finish(const pass *p, const unit *u, uint32_t level, uint32_t slab, level_worker *worker)
{
    const level_grid *grid = &p->grids[level];
    nook_surfel_bins *bins = worker->bins[level];
    nook_surfel_bin voxel_bins[NOOK_SURFEL_BINS_PER_VOXEL];
    const uint32_t base = slab * grid->counts[0] * grid->counts[1] << 6;
    nook_result result = NOOK_OK;
    size_t count = nook_surfel_bins_sort(bins);
    if (count == SIZE_MAX)
        return NOOK_E_MEMORY;
    for (size_t i = 0; i < count && result == NOOK_OK;) {
        const uint32_t voxel = nook_surfel_bins_voxel(bins, i), place = base + voxel;
        const size_t first = i;
        uint32_t parent = 0;
        int side[3];
        nook_surfel surfel;
        if (level < p->coarsest)
            parent = parent_of(p, u, level, place, side);
        for (; i < count && nook_surfel_bins_voxel(bins, i) == voxel; i++) {
            voxel_bins[i - first] = nook_surfel_bins_get(bins, i);
            if (level < p->coarsest && result == NOOK_OK)
                result = nook_surfel_bins_merge(bins, i, side, worker->bins[level + 1], parent);
        }
        if (grid->wanted && is_changed(p, level, place >> 6) &&
            nook_surfel_fit(voxel_bins, i - first, grid->bias, &surfel) && !append(&worker->made[level], place, surfel))
            result = NOOK_E_MEMORY;
    }
    return result;
}

/* ---- Units ------------------------------------------------------------------------------------------------------- */

/* @return as nook_surfel_bins_add */
static nook_result make_level_0(const pass *p, const unit *u, level_worker *worker)
{
    const int32_t layer = (int32_t)u->slab * NOOK_BRICK_SIDE, inner = p->source.frame->inner[2];
    const int32_t lowest = layer > 0 ? ((layer - 1) << p->coarsest) + 1 : 1;
    const int32_t end = (layer + NOOK_BRICK_SIDE - 1) << p->coarsest, highest = end < inner ? end : inner;
    const size_t triangle_count = p->source.triangles->index_count / 3;
    nook_result result = NOOK_OK;
    for (int32_t slab = lowest / NOOK_BRICK_SIDE; slab <= highest / NOOK_BRICK_SIDE && result == NOOK_OK; slab++) {
        const nook_surfel_part part = { slab, u->first, u->end, u->wanted, p->coarsest, lowest, highest };
        nook_surfel_bins_clear(worker->bins[0]);
        for (size_t t = 0; t < triangle_count && result == NOOK_OK; t++)
            if (p->reach[t][0] <= slab && slab <= p->reach[t][1])
                result = nook_surfel_cut(&p->source, t, &part, worker->bins[0]);
        if (result == NOOK_OK)
            result = finish(p, u, 0, (uint32_t)slab, worker);
    }
    return result;
}

/* Of level 0 there is a slab at a time, of the others all that is in the unit: 2, 1/2, 1/8 of what such a slab has, as surfaces go. */
static void limit_bins(const pass *p, const unit *u, level_worker *worker)
{
    static const size_t share[LEVELS] = { 4, 2, 8, 8 }; /* one part in so many of the memory */
    for (uint32_t level = 0; level <= p->coarsest; level++) {
        size_t most = p->memory / NOOK_SURFEL_BIN_BYTES / share[level];
        bool may_split = u->end - u->first > 1;
        nook_surfel_bins_clear(worker->bins[level]);
        nook_surfel_bins_limit(worker->bins[level],
                               may_split && most < UINT32_MAX / 4 ? (uint32_t)most : UINT32_MAX / 4);
    }
}

/* A unit whose bins are too many for the memory is made in two halves, one after the other: the same bits. @return NOOK_E_MEMORY */
static nook_result make_unit(const pass *p, const unit *u, level_worker *worker)
{
    size_t made[LEVELS];
    for (uint32_t level = 0; level <= p->coarsest; level++)
        made[level] = worker->made[level].count;
    limit_bins(p, u, worker);
    nook_result result = make_level_0(p, u, worker);
    for (uint32_t level = 1; level <= p->coarsest && result == NOOK_OK; level++)
        result = finish(p, u, level, first_slab(p, u, level), worker);
    if (result != NOOK_E_RANGE)
        return result;
    for (uint32_t level = 0; level <= p->coarsest; level++)
        worker->made[level].count = made[level];
    unit low = *u, high = *u;
    low.end = high.first = u->first + (u->end - u->first) / 2;
    result = make_unit(p, &low, worker);
    return result == NOOK_OK ? make_unit(p, &high, worker) : result;
}

/* Leaves out what stays at either end. */
static void narrow(const pass *p, unit *u)
{
    const level_grid *grid = &p->grids[p->coarsest];
    u->wanted = p->before[p->coarsest].changed + (size_t)u->slab * grid->counts[0] * grid->counts[1];
    while (u->first < u->end && !u->wanted[u->first])
        u->first++;
    while (u->first < u->end && !u->wanted[u->end - 1])
        u->end--;
}

static void make_units(void *user, size_t first, size_t last, unsigned worker)
{
    pass *p = user;
    const level_grid *grid = &p->grids[p->coarsest];
    const size_t bricks = (size_t)grid->counts[0] * grid->counts[1];
    for (size_t i = first; i < last; i++) {
        const size_t piece = i % p->pieces;
        unit u = { (uint32_t)(i / p->pieces), (uint32_t)(piece * bricks / p->pieces),
                   (uint32_t)((piece + 1) * bricks / p->pieces), NULL };
        if (p->before)
            narrow(p, &u);
        if (atomic_load(&p->out_of_memory) || (u.first < u.end && make_unit(p, &u, &p->workers[worker]) != NOOK_OK))
            atomic_store(&p->out_of_memory, true);
    }
}

/* ---- Putting it together ----------------------------------------------------------------------------------------- */

/*
 * Which voxels of a changed brick were made: those that are merged into changed bricks of the coarsest level, of whose border bricks of this
 * one may stand out. What lies there no changed triangle touches.
 */
static void find_made(const pass *p, uint32_t level, size_t brick, uint32_t out_mask[2])
{
    const uint32_t *counts = p->grids[level].counts, *above = p->grids[p->coarsest].counts,
                   row = (uint32_t)brick / counts[0];
    const uint32_t corner[3] = { (uint32_t)brick % counts[0], row % counts[1], row / counts[1] };
    out_mask[0] = out_mask[1] = 0;
    for (uint32_t bit = 0; bit < 64; bit++) {
        uint32_t at[3];
        for (uint32_t axis = 0; axis < 3; axis++) {
            const uint32_t layer = corner[axis] * NOOK_BRICK_SIDE + in_brick(bit, axis);
            at[axis] = (uint32_t)nook_grid_level_layer((int32_t)layer, p->coarsest - level) / NOOK_BRICK_SIDE;
        }
        const bool inside = at[0] < above[0] && at[1] < above[1] && at[2] < above[2]; /* the last bricks stand out */
        if (inside && is_changed(p, p->coarsest, ((size_t)at[2] * above[1] + at[1]) * above[0] + at[0]))
            out_mask[bit >> 5] |= 1u << (bit & 31);
    }
}

/* The masks of what stays. @return how many surfels there are */
static size_t keep_masks(const pass *p, uint32_t level, size_t brick_count, nook_brick *bricks)
{
    const nook_brick *before = p->before[level].volume->bricks;
    size_t count = 0;
    for (size_t i = 0; i < brick_count; i++) {
        uint32_t made[2] = { 0, 0 };
        if (is_changed(p, level, i))
            find_made(p, level, i, made);
        for (int word = 0; word < 2; word++)
            bricks[i].mask[word] = before[i].mask[word] & ~made[word];
        count += nook_brick_count(&bricks[i]);
    }
    return count;
}

/* The surfels of what was there and still is, also where another one was made, which then takes its place. */
static void keep_surfels(const nook_volume *before, size_t brick_count, nook_volume *volume)
{
    for (size_t i = 0; i < brick_count; i++) {
        const nook_brick *from = &before->bricks[i], *to = &volume->bricks[i];
        const size_t count = nook_brick_count(from);
        const bool whole = memcmp(from->mask, to->mask, sizeof from->mask) == 0;
        if (whole && count)
            memcpy(volume->surfels + to->first_surfel, before->surfels + from->first_surfel,
                   count * sizeof *volume->surfels);
        for (uint32_t bit = 0; bit < 64 && count && !whole; bit++)
            if ((from->mask[bit >> 5] & to->mask[bit >> 5]) >> (bit & 31) & 1)
                volume->surfels[to->first_surfel + nook_brick_count_below(to, bit)] =
                    before->surfels[from->first_surfel + nook_brick_count_below(from, bit)];
    }
}

static void set_made_bits(const pass *p, unsigned workers, uint32_t level, nook_brick *bricks)
{
    for (unsigned w = 0; w < workers; w++) {
        const records *made = &p->workers[w].made[level];
        for (size_t i = 0; i < made->count; i++) {
            const uint32_t place = made->items[i].place;
            bricks[place >> 6].mask[place >> 5 & 1] |= 1u << (place & 31);
        }
    }
}

/* What the workers have made of a level, each in its own order, and what stays, in the order of bricks. @return false when there is no memory */
static bool join(const pass *p, unsigned workers, uint32_t level, nook_volume *out)
{
    const uint32_t *counts = p->grids[level].counts;
    const size_t brick_count = (size_t)counts[0] * counts[1] * counts[2];
    size_t count = 0;
    nook_volume volume = { .bricks = calloc(brick_count, sizeof *volume.bricks) };
    if (!volume.bricks)
        return false;
    if (p->before)
        count = keep_masks(p, level, brick_count, volume.bricks);
    for (unsigned w = 0; w < workers; w++)
        count += p->workers[w].made[level].count;
    set_made_bits(p, workers, level, volume.bricks);
    volume.info.occupied = nook_bricks_number(volume.bricks, counts);
    assert(volume.info.occupied == count);
    volume.surfels = malloc((count + 1) * sizeof *volume.surfels);
    if (!volume.surfels) {
        nook_volume_free(&volume);
        return false;
    }
    if (p->before)
        keep_surfels(p->before[level].volume, brick_count, &volume);
    for (unsigned w = 0; w < workers; w++) {
        const records *made = &p->workers[w].made[level];
        for (size_t i = 0; i < made->count; i++) {
            const nook_brick *brick = &volume.bricks[made->items[i].place >> 6];
            volume.surfels[brick->first_surfel + nook_brick_count_below(brick, made->items[i].place & 63)] =
                made->items[i].surfel;
        }
    }
    *out = volume;
    return true;
}

static bool join_all(const pass *p, unsigned workers, nook_volume *out_volumes)
{
    nook_volume volumes[LEVELS] = { { .voxels = NULL } };
    bool joined = true;
    for (uint32_t level = 0; level <= p->coarsest && joined; level++)
        joined = !p->grids[level].wanted || join(p, workers, level, &volumes[level]);
    for (uint32_t level = 0; level <= p->coarsest; level++) {
        if (joined && p->grids[level].wanted)
            out_volumes[level] = volumes[level];
        else
            nook_volume_free(&volumes[level]);
    }
    return joined;
}

static void describe_grids(pass *p, uint32_t levels)
{
    for (uint32_t level = 0; level < LEVELS; level++) {
        const nook_grid_frame frame = nook_grid_level(p->source.frame, level);
        nook_brick_counts(
            &(nook_volume_info){ .width = frame.size[0], .height = frame.size[1], .depth = frame.size[2] },
            p->grids[level].counts);
        p->grids[level].bias = ldexp(NOOK_LAYER_BIAS / NOOK_SUBVOXEL, -(int)level);
        p->grids[level].wanted = levels >> level & 1;
        p->coarsest = p->grids[level].wanted ? level : p->coarsest;
    }
    memcpy(p->source.counts, p->grids[0].counts, sizeof p->source.counts);
}

static bool allocate(pass *p, unsigned workers)
{
    p->reach = malloc(p->source.triangles->index_count / 3 * sizeof *p->reach);
    p->workers = calloc(workers, sizeof *p->workers);
    bool made = p->reach && p->workers;
    for (unsigned w = 0; made && w < workers; w++)
        for (uint32_t level = 0; made && level <= p->coarsest; level++) {
            p->workers[w].bins[level] = nook_surfel_bins_create(0);
            made = p->workers[w].bins[level] != NULL;
        }
    return made;
}

static void release(pass *p, unsigned workers)
{
    for (unsigned w = 0; p->workers && w < workers; w++)
        for (uint32_t level = 0; level < LEVELS; level++) {
            nook_surfel_bins_destroy(p->workers[w].bins[level]);
            free(p->workers[w].made[level].items);
        }
    free(p->workers);
    free(p->reach);
}

nook_result nook_surfel_bake_levels(const nook_triangles *triangles, const nook_voxelize_desc *desc,
                                    const nook_grid_frame *frame, uint32_t levels, const nook_surfel_before *before,
                                    nook_volume *out_volumes)
{
    nook_alpha_areas *areas = nook_alpha_areas_create(desc->alphas);
    pass p = { .source = { .triangles = triangles, .alphas = desc->alphas, .areas = areas, .frame = frame },
               .memory = desc->memory ? desc->memory : NOOK_VOXELIZE_MEMORY,
               .before = before };
    describe_grids(&p, levels);
    const uint32_t slabs = p.grids[p.coarsest].counts[2], wide = nook_parallel_workers(SIZE_MAX, desc->threads);
    p.pieces = wide > 1 ? (2 * wide + slabs - 1) / slabs : 1;
    const size_t units = (size_t)slabs * p.pieces;
    const unsigned workers = nook_parallel_workers(units, desc->threads);
    bool made = areas && allocate(&p, workers);
    if (made) {
        nook_surfel_find_reach(&p.source, desc->threads, p.reach);
        nook_parallel_for(units, desc->threads, make_units, &p);
        made = !atomic_load(&p.out_of_memory) && join_all(&p, workers, out_volumes);
    }
    release(&p, workers);
    nook_alpha_areas_destroy(areas);
    return made ? NOOK_OK
                : nook_fail(NOOK_E_MEMORY,
                            "voxelize: no memory for levels of surfels in %ux%ux%u voxels; lower the resolution",
                            frame->size[0], frame->size[1], frame->size[2]);
}
