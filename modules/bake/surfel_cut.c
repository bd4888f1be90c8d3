#include "modules/bake/surfel_cut.h"
#include "engine/core/jobs.h"
#include "engine/core/vector.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/polygon_layers.h"
#include <math.h>
#include <string.h>

/* A triangle with area in the grid's steps. Its corners are sorted, so that sums do not depend on which one it begins with. */
typedef struct placed {
    nook_polygon polygon;
    double normal[3];
    uint32_t vertex[3]; /* of each corner */
} placed;

typedef struct cutter {
    const nook_surfel_source *source;
    nook_surfel_bins *bins;
    placed triangle;
    const nook_alpha_part *part; /* of the alphas; NULL: opaque */
    nook_alpha_map map;
    int32_t voxel[3];
    const nook_surfel_part *wanted;
    uint32_t width; /* bricks along x of the part's level */
    nook_result result;
} cutter;

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

static void swap_corners(nook_snapped_triangle *snapped, uint32_t *vertex, int low)
{
    int32_t kept[3];
    uint32_t kept_vertex = vertex[low];
    memcpy(kept, snapped->corner[low], sizeof kept);
    memcpy(snapped->corner[low], snapped->corner[low + 1], sizeof kept);
    memcpy(snapped->corner[low + 1], kept, sizeof kept);
    vertex[low] = vertex[low + 1];
    vertex[low + 1] = kept_vertex;
}

static void sort_corners(nook_snapped_triangle *snapped, uint32_t *vertex)
{
    for (int pass = 0; pass < 3; pass++) {
        const int32_t *low = snapped->corner[pass % 2], *high = snapped->corner[pass % 2 + 1];
        int axis = 0;
        while (axis < 2 && low[axis] == high[axis])
            axis++;
        if (low[axis] > high[axis])
            swap_corners(snapped, vertex, pass % 2);
    }
}

/* @return false: no area */
static bool read_triangle(const nook_surfel_source *source, size_t triangle, placed *out)
{
    nook_snapped_triangle snapped;
    if (!nook_grid_snap(source->frame, source->triangles, triangle, &snapped))
        return false;
    memcpy(out->vertex, source->triangles->indices + 3 * triangle, sizeof out->vertex);
    sort_corners(&snapped, out->vertex);
    double u[3], v[3], across[3];
    nook_polygon *polygon = &out->polygon;
    polygon->count = 3;
    for (int i = 0; i < 3; i++) {
        for (int corner = 0; corner < 3; corner++)
            polygon->corner[corner][i] = snapped.corner[corner][i]; /* steps: exact */
        u[i] = polygon->corner[1][i] - polygon->corner[0][i];
        v[i] = polygon->corner[2][i] - polygon->corner[0][i];
    }
    nook_vector_cross(u, v, across);
    return nook_vector_normalize(across, out->normal);
}

bool nook_surfel_reach(const nook_surfel_source *source, size_t triangle, int32_t out_slabs[2])
{
    placed p;
    int32_t low, high;
    if (!read_triangle(source, triangle, &p))
        return false;
    nook_polygon_layers(&p.polygon, 2, source->frame->inner[2], &low, &high);
    out_slabs[0] = low / NOOK_BRICK_SIDE;
    out_slabs[1] = high / NOOK_BRICK_SIDE;
    return true;
}

typedef struct reach_job {
    const nook_surfel_source *source;
    uint8_t (*reach)[2];
} reach_job;

static void find_reach(void *user, size_t first, size_t last, unsigned worker)
{
    const reach_job *job = user;
    (void)worker;
    for (size_t t = first; t < last; t++) {
        int32_t slabs[2] = { 1, 0 };
        nook_surfel_reach(job->source, t, slabs);
        job->reach[t][0] = (uint8_t)slabs[0];
        job->reach[t][1] = (uint8_t)slabs[1];
    }
}

void nook_surfel_find_reach(const nook_surfel_source *source, uint32_t threads, uint8_t (*out)[2])
{
    reach_job job = { source, out };
    nook_parallel_for(source->triangles->index_count / 3, threads, find_reach, &job);
}

/* Which part the triangle belongs to, and where it lies on its texture. */
static void find_part(cutter *c, size_t triangle)
{
    const nook_alphas *alphas = c->source->alphas;
    double uvs[3][2];
    c->part = nook_alpha_part_of(alphas, triangle);
    if (!c->part || !c->part->texels)
        return;
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 2; k++)
            uvs[corner][k] = (double)alphas->uvs[2 * (size_t)c->triangle.vertex[corner] + (size_t)k];
    c->map = nook_alpha_map_make((const double(*)[3])c->triangle.polygon.corner, (const double(*)[2])uvs, c->part);
}

/* ---- Cutting ---------------------------------------------------------------------------------------------------- */

/* One piece that lies in one voxel. @param alpha  how much of it is there */
static void add_piece(void *user, const nook_polygon *polygon, double alpha)
{
    cutter *c = user;
    const double centre[3] = { 0.0, 0.0, 0.0 };
    const uint32_t x = (uint32_t)c->voxel[0], y = (uint32_t)c->voxel[1], z = (uint32_t)c->voxel[2];
    nook_polygon piece = { .count = polygon->count };
    for (int i = 0; i < polygon->count; i++)
        for (int axis = 0; axis < 3; axis++)
            piece.corner[i][axis] = polygon->corner[i][axis] / NOOK_SUBVOXEL - (c->voxel[axis] + 0.5);
    nook_polygon_moments moments = nook_polygon_measure(&piece, c->triangle.normal, centre);
    moments.area *= alpha;
    for (int i = 0; i < 3; i++)
        moments.first[i] *= alpha;
    for (int i = 0; i < 6; i++)
        moments.second[i] *= alpha;
    uint32_t brick = y / NOOK_BRICK_SIDE * c->source->counts[0] + x / NOOK_BRICK_SIDE;
    uint32_t voxel = brick << 6 | nook_brick_bit(x, y, z);
    if (c->result == NOOK_OK)
        c->result = nook_surfel_bins_add(c->bins, voxel, c->triangle.normal, &moments);
}

static void add_pieces(cutter *c, const nook_polygon *polygon)
{
    if (c->part)
        nook_alpha_cut(c->source->areas, c->part, &c->map, polygon, add_piece, c);
    else
        add_piece(c, polygon, 1.0);
}

static bool is_wanted(const nook_surfel_part *part, uint32_t brick)
{
    return brick >= part->first && brick < part->end && (!part->wanted || part->wanted[brick]);
}

static uint32_t brick_of(const nook_surfel_part *part, int32_t layer)
{
    return (uint32_t)nook_grid_level_layer(layer, part->level) / NOOK_BRICK_SIDE;
}

/* Bricks along an axis, of the part's level, whose border is a voxel of its own. */
static uint32_t bricks_along(const nook_surfel_source *source, const nook_surfel_part *part, int axis)
{
    const int32_t inner = nook_grid_level_layer(source->frame->inner[axis], part->level);
    return (uint32_t)(inner + 1) / NOOK_BRICK_SIDE + 1;
}

/* Whether what lies in this layer is looked at. */
static bool is_layer_wanted(const cutter *c, int axis)
{
    const nook_surfel_part *part = c->wanted;
    if (axis == 2)
        return part->highest == 0 || (c->voxel[2] >= part->lowest && c->voxel[2] <= part->highest);
    const uint32_t width = c->width, row = brick_of(part, c->voxel[1]);
    if (axis == 1)
        return (row + 1) * width > part->first && row * width < part->end;
    return is_wanted(part, row * width + brick_of(part, c->voxel[0]));
}

/*
 * Cuts along z, then y, then x; what is left is in one voxel. Layers before wanted ones are cut off one by one all the same: where an
 * edge is cut twice, its point depends on the first cut.
 */
static void cut_axis(cutter *c, const nook_polygon *polygon, int axis, int32_t lowest, int32_t highest)
{
    int32_t first, last;
    nook_polygon_layers(polygon, axis, c->source->frame->inner[axis], &first, &last);
    first = first > lowest ? first : lowest;
    last = last < highest ? last : highest;
    nook_polygon rest = *polygon;
    for (int32_t layer = first; layer <= last && rest.count > 0; layer++) {
        nook_polygon here, above;
        nook_polygon_take_layer(&rest, axis, layer, last, &here, &above);
        c->voxel[axis] = layer;
        if (!is_layer_wanted(c, axis))
            here.count = 0;
        if (here.count > 0 && axis > 0)
            cut_axis(c, &here, axis - 1, 1, c->source->frame->inner[axis - 1]);
        else if (here.count > 0)
            add_pieces(c, &here);
        rest = above;
    }
}

/* ---- Public ----------------------------------------------------------------------------------------------------- */

/* First and last brick of the part's level along each axis of the box around a triangle. */
static void find_box(const nook_surfel_source *source, const nook_surfel_part *part, const nook_polygon *polygon,
                     uint32_t out[2][3])
{
    for (int axis = 0; axis < 3; axis++) {
        int32_t first, last;
        nook_polygon_layers(polygon, axis, source->frame->inner[axis], &first, &last);
        out[0][axis] = brick_of(part, first);
        out[1][axis] = brick_of(part, last);
    }
}

/* Whether a brick of the box is in the part. */
static bool is_any_wanted(const nook_surfel_source *source, const nook_surfel_part *part, uint32_t box[2][3])
{
    const uint32_t width = bricks_along(source, part, 0);
    if (!part->wanted && part->first == 0 && part->end == width * bricks_along(source, part, 1))
        return true;
    for (uint32_t y = box[0][1]; y <= box[1][1]; y++)
        for (uint32_t x = box[0][0]; x <= box[1][0]; x++)
            if (is_wanted(part, y * width + x))
                return true;
    return false;
}

nook_result nook_surfel_cut(const nook_surfel_source *source, size_t triangle, const nook_surfel_part *part,
                            nook_surfel_bins *bins)
{
    cutter c = { .source = source, .bins = bins, .wanted = part, .width = bricks_along(source, part, 0) };
    const double up[3] = { 0.0, 0.0, 1.0 }, down[3] = { 0.0, 0.0, -1.0 };
    uint32_t box[2][3];
    if (!read_triangle(source, triangle, &c.triangle))
        return NOOK_OK;
    if (part->highest > 0) {
        int32_t first, last;
        nook_polygon_layers(&c.triangle.polygon, 2, source->frame->inner[2], &first, &last);
        if (last < part->lowest || first > part->highest)
            return NOOK_OK;
    }
    find_box(source, part, &c.triangle.polygon, box);
    if (!is_any_wanted(source, part, box))
        return NOOK_OK;
    find_part(&c, triangle);
    nook_polygon polygon = c.triangle.polygon, cut;
    int32_t lowest = part->slab * NOOK_BRICK_SIDE, highest = lowest + NOOK_BRICK_SIDE - 1;
    int32_t inner = source->frame->inner[2];
    if (lowest > 1) {
        nook_polygon_clip(&polygon, up, (double)lowest * NOOK_SUBVOXEL - NOOK_LAYER_BIAS, &cut);
        polygon = cut;
    }
    if (highest < inner) {
        nook_polygon_clip(&polygon, down, -((highest + 1.0) * NOOK_SUBVOXEL - NOOK_LAYER_BIAS), &cut);
        polygon = cut;
    }
    if (polygon.count > 0)
        cut_axis(&c, &polygon, 2, lowest > 1 ? lowest : 1, highest < inner ? highest : inner);
    return c.result;
}

void nook_surfel_mark(const nook_surfel_source *source, size_t triangle, uint32_t level, uint8_t *bricks)
{
    const nook_surfel_part part = { .level = level };
    const size_t width = bricks_along(source, &part, 0), height = bricks_along(source, &part, 1);
    placed p;
    uint32_t box[2][3];
    if (!read_triangle(source, triangle, &p))
        return;
    find_box(source, &part, &p.polygon, box);
    for (uint32_t z = box[0][2]; z <= box[1][2]; z++)
        for (uint32_t y = box[0][1]; y <= box[1][1]; y++)
            memset(bricks + (z * height + y) * width + box[0][0], 1, box[1][0] - box[0][0] + 1);
}
