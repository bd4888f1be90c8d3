#include "modules/bake/distance_pieces.h"
#include "engine/core/vector.h"
#include "modules/bake/alpha_area.h"
#include "modules/bake/polygon_layers.h"
#include "modules/bake/voxelize.h"
#include <math.h>
#include <stdlib.h>

/* What lies in a voxel of the triangles of a part, in squares of steps. */
typedef struct share {
    uint64_t voxel;
    int64_t area, there;
} share;

typedef struct shares {
    share *items; /* while they are measured one for each piece, in any order; then one for each voxel, sorted */
    size_t count, capacity;
} shares;

typedef struct cutter {
    const nook_grid_frame *frame;
    const nook_alpha_areas *areas;
    const nook_alpha_part *part; /* of the triangles that are cut */
    nook_alpha_map map;          /* of the one that is cut, as is */
    double normal[3];            /* this */
    int32_t voxel[3];
    shares shares;
    bool measures; /* else what is there is added */
    bool left_out; /* some of the triangle is not there */
    nook_distance_pieces *out;
    nook_result result;
} cutter;

static bool add(nook_distance_pieces *pieces, const nook_snapped_triangle *triangle)
{
    if (pieces->count == pieces->capacity) {
        size_t capacity = pieces->capacity ? pieces->capacity + pieces->capacity / 2 : 1024;
        nook_snapped_triangle *grown = realloc(pieces->triangles, capacity * sizeof *grown);
        if (!grown)
            return false;
        pieces->triangles = grown;
        pieces->capacity = capacity;
    }
    pieces->triangles[pieces->count++] = *triangle;
    return true;
}

/* ---- How much is there -------------------------------------------------------------------------------------------- */

typedef struct coverage {
    const cutter *c;
    double area;
} coverage;

static double area_of(const cutter *c, const nook_polygon *polygon)
{
    return nook_polygon_measure(polygon, c->normal, polygon->corner[0]).area;
}

static void add_area(void *user, const nook_polygon *polygon, double alpha)
{
    coverage *covered = user;
    covered->area += alpha * area_of(covered->c, polygon);
}

static uint64_t number_of(const cutter *c)
{
    const uint64_t x = (uint64_t)c->voxel[0], y = (uint64_t)c->voxel[1], z = (uint64_t)c->voxel[2];
    return (z * c->frame->size[1] + y) * c->frame->size[0] + x;
}

/* Whole numbers, so that their sums do not depend on the order of triangles. */
static void measure(cutter *c, const nook_polygon *polygon)
{
    coverage covered = { c, 0.0 };
    shares *s = &c->shares;
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? s->capacity + s->capacity / 2 : 1024;
        share *grown = realloc(s->items, capacity * sizeof *grown);
        if (!grown) {
            c->result = NOOK_E_MEMORY;
            return;
        }
        s->items = grown;
        s->capacity = capacity;
    }
    nook_alpha_cut(c->areas, c->part, &c->map, polygon, add_area, &covered);
    s->items[s->count++] = (share){ number_of(c), llround(area_of(c, polygon)), llround(covered.area) };
}

static int compare_shares(const void *a, const void *b)
{
    const share *x = a, *y = b;
    return (x->voxel > y->voxel) - (x->voxel < y->voxel);
}

static void sum_up(shares *s)
{
    size_t count = 0;
    if (s->count > 0)
        qsort(s->items, s->count, sizeof *s->items, compare_shares);
    for (size_t i = 0; i < s->count; i++) {
        if (count > 0 && s->items[count - 1].voxel == s->items[i].voxel) {
            s->items[count - 1].area += s->items[i].area;
            s->items[count - 1].there += s->items[i].there;
        } else {
            s->items[count++] = s->items[i];
        }
    }
    s->count = count;
}

static bool is_there(const cutter *c)
{
    const share key = { .voxel = number_of(c) };
    const share *found =
        c->shares.count ? bsearch(&key, c->shares.items, c->shares.count, sizeof key, compare_shares) : NULL;
    return found && (double)found->there >= NOOK_DISTANCE_LEAST_ALPHA * (double)found->area;
}

/* ---- Cutting ------------------------------------------------------------------------------------------------------ */

/* A fan of triangles. */
static void add_polygon(cutter *c, const nook_polygon *polygon)
{
    nook_snapped_triangle triangle;
    for (int i = 2; i < polygon->count; i++) {
        const int corners[3] = { 0, i - 1, i };
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                triangle.corner[k][axis] = (int32_t)lround(polygon->corner[corners[k]][axis]);
        if (c->result == NOOK_OK && !add(c->out, &triangle))
            c->result = NOOK_E_MEMORY;
    }
}

/* A row of voxels along x: neighbours that are there stay together. */
static void cut_row(cutter *c, const nook_polygon *row)
{
    int32_t first, last;
    nook_polygon_layers(row, 0, c->frame->inner[0], &first, &last);
    nook_polygon rest = *row, run = { .count = 0 };
    for (int32_t layer = first; layer <= last; layer++) {
        nook_polygon here, above;
        nook_polygon_take_layer(&rest, 0, layer, last, &here, &above);
        c->voxel[0] = layer;
        if (here.count > 0 && c->measures) {
            measure(c, &here);
        } else if (here.count > 0 && is_there(c)) {
            run = run.count > 0 ? run : rest; /* it ends where the next one that is not there begins */
        } else if (here.count > 0) {
            nook_polygon ended, after;
            c->left_out = true;
            nook_polygon_take_layer(&run, 0, layer - 1, layer, &ended, &after);
            add_polygon(c, &ended);
            run.count = 0;
        }
        rest = above;
    }
    add_polygon(c, &run);
}

static void cut_axis(cutter *c, const nook_polygon *polygon, int axis)
{
    int32_t first, last;
    nook_polygon_layers(polygon, axis, c->frame->inner[axis], &first, &last);
    nook_polygon rest = *polygon;
    for (int32_t layer = first; layer <= last && rest.count > 0; layer++) {
        nook_polygon here, above;
        nook_polygon_take_layer(&rest, axis, layer, last, &here, &above);
        c->voxel[axis] = layer;
        if (here.count > 0 && axis > 1)
            cut_axis(c, &here, axis - 1);
        else if (here.count > 0)
            cut_row(c, &here);
        rest = above;
    }
}

/* ---- Triangles ---------------------------------------------------------------------------------------------------- */

/* @return false: it has no area */
static bool open_triangle(cutter *c, const nook_triangles *triangles, const nook_alphas *alphas, size_t triangle,
                          const nook_snapped_triangle *snapped, nook_polygon *out)
{
    double u[3], v[3], across[3], corners[3][3], uvs[3][2];
    out->count = 3;
    for (int i = 0; i < 3; i++) {
        for (int corner = 0; corner < 3; corner++)
            corners[corner][i] = out->corner[corner][i] = snapped->corner[corner][i];
        u[i] = out->corner[1][i] - out->corner[0][i];
        v[i] = out->corner[2][i] - out->corner[0][i];
    }
    nook_vector_cross(u, v, across);
    if (!nook_vector_normalize(across, c->normal))
        return false;
    for (size_t corner = 0; corner < 3; corner++)
        for (size_t k = 0; k < 2; k++)
            uvs[corner][k] = (double)alphas->uvs[2 * (size_t)triangles->indices[3 * triangle + corner] + k];
    c->map = nook_alpha_map_make((const double(*)[3])corners, (const double(*)[2])uvs, c->part);
    return true;
}

static void measure_triangle(cutter *c, const nook_triangles *triangles, const nook_alphas *alphas, size_t triangle)
{
    nook_snapped_triangle snapped;
    nook_polygon polygon;
    if (nook_grid_snap(c->frame, triangles, triangle, &snapped) &&
        open_triangle(c, triangles, alphas, triangle, &snapped, &polygon))
        cut_axis(c, &polygon, 2);
}

static void add_whole(cutter *c, const nook_snapped_triangle *snapped)
{
    if (c->result == NOOK_OK && !add(c->out, snapped))
        c->result = NOOK_E_MEMORY;
}

/* The whole triangle where all of it is there, as if it were opaque; else what of it is. */
static void add_triangle(cutter *c, const nook_triangles *triangles, const nook_alphas *alphas, size_t triangle)
{
    static const double middle[3] = { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 };
    const size_t before = c->out->count;
    nook_snapped_triangle snapped;
    nook_polygon polygon;
    if (!nook_grid_snap(c->frame, triangles, triangle, &snapped))
        return;
    const bool cuts = c->part && c->part->texels && open_triangle(c, triangles, alphas, triangle, &snapped, &polygon);
    if (!cuts) {
        if (!c->part ||
            nook_alpha_at(alphas, c->part, triangles->indices + 3 * triangle, middle) >= NOOK_DISTANCE_LEAST_ALPHA)
            add_whole(c, &snapped);
        return;
    }
    c->left_out = false;
    cut_axis(c, &polygon, 2);
    if (c->left_out) {
        c->out->cut = true;
    } else {
        c->out->count = before;
        add_whole(c, &snapped);
    }
}

/* Triangles of one part, or such as are in none. */
static void add_triangles(cutter *c, const nook_triangles *triangles, const nook_alphas *alphas, size_t first,
                          size_t end)
{
    c->shares.count = 0;
    c->measures = true;
    for (size_t t = first; t < end && c->part && c->part->texels && c->result == NOOK_OK; t++)
        measure_triangle(c, triangles, alphas, t);
    sum_up(&c->shares);
    c->measures = false;
    for (size_t t = first; t < end && c->result == NOOK_OK; t++)
        add_triangle(c, triangles, alphas, t);
}

nook_result nook_distance_pieces_make(const nook_triangles *triangles, const nook_alphas *alphas,
                                      const nook_grid_frame *frame, nook_distance_pieces *out)
{
    const size_t count = triangles->index_count / 3;
    nook_distance_pieces pieces = { .capacity = count + 1 };
    nook_alpha_areas *areas = nook_alpha_areas_create(alphas);
    pieces.triangles = malloc(pieces.capacity * sizeof *pieces.triangles);
    cutter c = { .frame = frame, .areas = areas, .out = &pieces };
    c.result = areas && pieces.triangles ? NOOK_OK : NOOK_E_MEMORY;
    size_t next = 0;
    for (uint32_t i = 0; alphas && i < alphas->part_count; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        const size_t first = part->first_index / 3, end = first + part->index_count / 3;
        c.part = NULL;
        add_triangles(&c, triangles, alphas, next, first);
        c.part = part;
        add_triangles(&c, triangles, alphas, first, end);
        next = end;
    }
    c.part = NULL;
    add_triangles(&c, triangles, alphas, next, count);
    free(c.shares.items);
    nook_alpha_areas_destroy(areas);
    if (c.result == NOOK_OK)
        *out = pieces;
    else
        nook_distance_pieces_free(&pieces);
    return c.result;
}

void nook_distance_pieces_free(nook_distance_pieces *pieces)
{
    free(pieces->triangles);
    *pieces = (nook_distance_pieces){ .triangles = NULL };
}
