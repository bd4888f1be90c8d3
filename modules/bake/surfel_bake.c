#include "modules/bake/surfel_bake.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/polygon.h"
#include "modules/bake/surfel_fit.h"
#include <math.h>
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
    const nook_triangles *triangles;
    const nook_grid_frame *frame;
    uint32_t counts[3];  /* bricks */
    uint8_t (*reach)[2]; /* first and last slab of each triangle; a first above the last: it has none */
    nook_brick *bricks;
    slab *slabs;
    worker_bins *workers;
    atomic_bool out_of_memory;
} bake;

/* ---- Which triangle lies where ---------------------------------------------------------------------------------- */

/* Corners sorted, so that sums do not depend on which one a triangle begins with. @return false: no area */
static bool read_triangle(const bake *b, size_t triangle, nook_polygon *out, double out_normal[3])
{
    nook_snapped_triangle snapped;
    if (!nook_grid_snap(b->frame, b->triangles, triangle, &snapped))
        return false;
    for (int pass = 0; pass < 3; pass++) {
        int32_t *low = snapped.corner[pass % 2], *high = snapped.corner[pass % 2 + 1];
        int axis = 0;
        while (axis < 2 && low[axis] == high[axis])
            axis++;
        if (low[axis] > high[axis]) {
            int32_t kept[3];
            memcpy(kept, low, sizeof kept);
            memcpy(low, high, sizeof kept);
            memcpy(high, kept, sizeof kept);
        }
    }
    double u[3], v[3], across[3];
    out->count = 3;
    for (int i = 0; i < 3; i++) {
        for (int corner = 0; corner < 3; corner++)
            out->corner[corner][i] = snapped.corner[corner][i]; /* steps: exact */
        u[i] = out->corner[1][i] - out->corner[0][i];
        v[i] = out->corner[2][i] - out->corner[0][i];
    }
    nook_vector_cross(u, v, across);
    return nook_vector_normalize(across, out_normal);
}

static void find_range(const nook_polygon *polygon, int axis, int32_t inner, int32_t *out_first, int32_t *out_last)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < polygon->count; i++) {
        low = fmin(low, polygon->corner[i][axis]);
        high = fmax(high, polygon->corner[i][axis]);
    }
    *out_first = nook_grid_layer(low, inner);
    *out_last = nook_grid_layer(high, inner);
}

static void find_reach(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    (void)worker;
    for (size_t t = first; t < last; t++) {
        nook_polygon polygon;
        double normal[3];
        int32_t low, high;
        b->reach[t][0] = 1;
        b->reach[t][1] = 0;
        if (!read_triangle(b, t, &polygon, normal))
            continue;
        find_range(&polygon, 2, b->frame->inner[2], &low, &high);
        b->reach[t][0] = (uint8_t)(low / NOOK_BRICK_SIDE);
        b->reach[t][1] = (uint8_t)(high / NOOK_BRICK_SIDE);
    }
}

/* ---- Cutting a triangle into voxels ----------------------------------------------------------------------------- */

typedef struct cutter {
    const bake *b;
    nook_surfel_bins *bins;
    double normal[3];
    int32_t voxel[3];
    bool out_of_memory;
} cutter;

static void add_piece(cutter *c, const nook_polygon *polygon)
{
    const double centre[3] = { 0.0, 0.0, 0.0 };
    const uint32_t x = (uint32_t)c->voxel[0], y = (uint32_t)c->voxel[1], z = (uint32_t)c->voxel[2];
    nook_polygon piece = { .count = polygon->count };
    for (int i = 0; i < polygon->count; i++)
        for (int axis = 0; axis < 3; axis++)
            piece.corner[i][axis] = polygon->corner[i][axis] / NOOK_SUBVOXEL - (c->voxel[axis] + 0.5);
    nook_polygon_moments moments = nook_polygon_measure(&piece, c->normal, centre);
    uint32_t brick = y / NOOK_BRICK_SIDE * c->b->counts[0] + x / NOOK_BRICK_SIDE;
    uint32_t voxel = brick << 6 | nook_brick_bit(x, y, z);
    if (nook_surfel_bins_add(c->bins, voxel, c->normal, &moments) != NOOK_OK)
        c->out_of_memory = true;
}

/* Cuts along z, then y, then x; what is left is in one voxel. Layers end where those of voxels do: NOOK_LAYER_BIAS. */
static void cut_axis(cutter *c, const nook_polygon *polygon, int axis, int32_t lowest, int32_t highest)
{
    int32_t first, last;
    find_range(polygon, axis, c->b->frame->inner[axis], &first, &last);
    first = first > lowest ? first : lowest;
    last = last < highest ? last : highest;
    nook_polygon rest = *polygon;
    for (int32_t layer = first; layer <= last && rest.count > 0; layer++) {
        nook_polygon here = rest, above = { .count = 0 };
        if (layer < last)
            nook_polygon_split(&rest, axis, (layer + 1.0) * NOOK_SUBVOXEL - NOOK_LAYER_BIAS, &here, &above);
        c->voxel[axis] = layer;
        if (here.count > 0 && axis > 0)
            cut_axis(c, &here, axis - 1, 1, c->b->frame->inner[axis - 1]);
        else if (here.count > 0)
            add_piece(c, &here);
        rest = above;
    }
}

/* What of the triangle lies in the slab. */
static void cut_triangle(cutter *c, size_t triangle, int32_t slab_index)
{
    nook_polygon polygon, part;
    const double up[3] = { 0.0, 0.0, 1.0 }, down[3] = { 0.0, 0.0, -1.0 };
    if (!read_triangle(c->b, triangle, &polygon, c->normal))
        return;
    int32_t lowest = slab_index * NOOK_BRICK_SIDE, highest = lowest + NOOK_BRICK_SIDE - 1;
    int32_t inner = c->b->frame->inner[2];
    if (lowest > 1) {
        nook_polygon_clip(&polygon, up, (double)lowest * NOOK_SUBVOXEL - NOOK_LAYER_BIAS, &part);
        polygon = part;
    }
    if (highest < inner) {
        nook_polygon_clip(&polygon, down, -((highest + 1.0) * NOOK_SUBVOXEL - NOOK_LAYER_BIAS), &part);
        polygon = part;
    }
    if (polygon.count > 0)
        cut_axis(c, &polygon, 2, lowest > 1 ? lowest : 1, highest < inner ? highest : inner);
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
    nook_brick *bricks = b->bricks + slab_index * b->counts[0] * b->counts[1];
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

static void bake_slabs(void *user, size_t first, size_t last, unsigned worker)
{
    bake *b = user;
    cutter c = { .b = b, .bins = b->workers[worker].bins };
    size_t triangle_count = b->triangles->index_count / 3;
    for (size_t s = first; s < last && !c.out_of_memory; s++) {
        nook_surfel_bins_clear(c.bins);
        for (size_t t = 0; t < triangle_count && !c.out_of_memory; t++)
            if (b->reach[t][0] <= s && s <= b->reach[t][1])
                cut_triangle(&c, t, (int32_t)s);
        size_t count = c.out_of_memory ? SIZE_MAX : nook_surfel_bins_sort(c.bins);
        c.out_of_memory = count == SIZE_MAX || !fit_slab(b, c.bins, count, s);
    }
    if (c.out_of_memory)
        atomic_store(&b->out_of_memory, true);
}

/* ---- Putting it together ---------------------------------------------------------------------------------------- */

static bool allocate(bake *b, unsigned workers)
{
    size_t triangles = b->triangles->index_count / 3;
    b->reach = malloc(triangles * sizeof *b->reach);
    b->bricks = calloc((size_t)b->counts[0] * b->counts[1] * b->counts[2], sizeof *b->bricks);
    b->slabs = calloc(b->counts[2], sizeof *b->slabs);
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
    for (uint32_t s = 0; b->slabs && s < b->counts[2]; s++)
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
    for (uint32_t s = 0; s < b->counts[2]; s++)
        count += b->slabs[s].count;
    nook_surfel *surfels = malloc((count + 1) * sizeof *surfels);
    if (!surfels)
        return NULL;
    count = 0;
    for (uint32_t s = 0; s < b->counts[2]; s++) {
        if (b->slabs[s].count)
            memcpy(surfels + count, b->slabs[s].surfels, b->slabs[s].count * sizeof *surfels);
        count += b->slabs[s].count;
    }
    return surfels;
}

nook_result nook_surfel_bake(const nook_triangles *triangles, unsigned threads, const nook_grid_frame *frame,
                             nook_volume *out_volume)
{
    bake b = { .triangles = triangles, .frame = frame };
    nook_brick_counts(&(nook_volume_info){ .width = frame->size[0], .height = frame->size[1], .depth = frame->size[2] },
                      b.counts);
    unsigned workers = nook_parallel_workers(b.counts[2], threads);
    nook_surfel *surfels = NULL;
    if (allocate(&b, workers)) {
        nook_parallel_for(triangles->index_count / 3, threads, find_reach, &b);
        nook_parallel_for(b.counts[2], threads, bake_slabs, &b);
        surfels = atomic_load(&b.out_of_memory) ? NULL : join_slabs(&b);
    }
    if (surfels) {
        uint64_t occupied = nook_bricks_number(b.bricks, b.counts);
        *out_volume = (nook_volume){ .info = { .occupied = occupied }, .bricks = b.bricks, .surfels = surfels };
        b.bricks = NULL;
    }
    release(&b, workers);
    return surfels
               ? NOOK_OK
               : nook_fail(NOOK_E_MEMORY, "voxelize: no memory for surfels in %ux%ux%u voxels; lower the resolution",
                           frame->size[0], frame->size[1], frame->size[2]);
}
