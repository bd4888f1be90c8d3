#include "modules/bake/rasterize.h"
#include "engine/core/vector.h"
#include <math.h>

/* Narrower than this, a triangle's projection along its main axis may miss every centre: the projected inscribed circle
   has at least 1 / (3 sqrt 3) of the altitude as its radius, and a circle of radius sqrt(1/2) always holds a centre. */
static const double narrow_voxels = 4.0;

static int32_t smallest(int32_t a, int32_t b, int32_t c)
{
    int32_t low = a < b ? a : b;
    return low < c ? low : c;
}

static int32_t largest(int32_t a, int32_t b, int32_t c)
{
    int32_t high = a > b ? a : b;
    return high > c ? high : c;
}

static int32_t first_centre(int32_t low) /* the first voxel whose centre is at `low` or above */
{
    return (low + NOOK_SUBVOXEL / 2 - 1) >> NOOK_SUBVOXEL_BITS;
}

static int32_t last_centre(int32_t high) /* the last voxel whose centre is at `high` or below */
{
    return (high - NOOK_SUBVOXEL / 2) >> NOOK_SUBVOXEL_BITS;
}

static int64_t centre(int32_t voxel)
{
    return (int64_t)voxel * NOOK_SUBVOXEL + NOOK_SUBVOXEL / 2;
}

/* A triangle seen along one axis, counter-clockwise. Corners: u, v across, depth along. */
typedef struct projection {
    int64_t u[3], v[3], depth[3];
    int64_t area; /* twice, > 0 */
    int order[3]; /* which of the triangle's corners they are */
} projection;

/* Twice the signed area of (from, to, point). Coordinates are below 2^26, so this is exact, in double too. */
static int64_t edge(const projection *p, int from, int to, int64_t u, int64_t v)
{
    return (p->u[to] - p->u[from]) * (v - p->v[from]) - (p->v[to] - p->v[from]) * (u - p->u[from]);
}

/* False when the triangle is seen edge-on: its neighbours, or the other axes, mark it then. */
static int project(const nook_snapped_triangle *triangle, int axis, projection *out)
{
    int across = (axis + 1) % 3, up = (axis + 2) % 3;
    for (int i = 0; i < 3; i++) {
        out->u[i] = triangle->corner[i][across];
        out->v[i] = triangle->corner[i][up];
        out->depth[i] = triangle->corner[i][axis];
        out->order[i] = i;
    }
    out->area = edge(out, 0, 1, out->u[2], out->v[2]);
    if (out->area >= 0)
        return out->area > 0;
    projection mirrored = *out;
    out->u[1] = mirrored.u[2], out->v[1] = mirrored.v[2], out->depth[1] = mirrored.depth[2];
    out->u[2] = mirrored.u[1], out->v[2] = mirrored.v[1], out->depth[2] = mirrored.depth[1];
    out->area = -mirrored.area;
    out->order[1] = 2, out->order[2] = 1;
    return 1;
}

static int64_t divide_up(int64_t a, int64_t positive)
{
    return a >= 0 ? (a + positive - 1) / positive : -(-a / positive);
}

static int64_t divide_down(int64_t a, int64_t positive)
{
    return -divide_up(-a, positive);
}

/* Narrows [*first, *last] to the steps i with weight + i * step >= 0. */
static void clip_span(int64_t weight, int64_t step, int64_t *first, int64_t *last)
{
    if (step > 0) {
        int64_t from = divide_up(-weight, step);
        *first = from > *first ? from : *first;
    } else if (step < 0) {
        int64_t to = divide_down(weight, -step);
        *last = to < *last ? to : *last;
    } else if (weight < 0) {
        *last = *first - 1;
    }
}

typedef struct raster {
    const int32_t *inner;
    int axis;
    nook_rasterize_mark mark;
    void *user;
} raster;

static void rasterize_row(const projection *p, const raster *r, int32_t first_u, int32_t last_u, int32_t row)
{
    int64_t weight[3], step[3];
    int64_t first = 0, last = last_u - first_u;
    for (int i = 0; i < 3; i++) {
        int from = (i + 1) % 3, to = (i + 2) % 3;
        weight[i] = edge(p, from, to, centre(first_u), centre(row));
        step[i] = (p->v[from] - p->v[to]) * NOOK_SUBVOXEL;
        clip_span(weight[i], step[i], &first, &last);
    }
    int32_t voxel[3];
    voxel[(r->axis + 2) % 3] = row;
    for (int64_t i = first; i <= last; i++) {
        double depth = 0.0, corner_weight[3];
        for (int k = 0; k < 3; k++) {
            depth += (double)(weight[k] + i * step[k]) * (double)p->depth[k];
            corner_weight[p->order[k]] = (double)(weight[k] + i * step[k]) / (double)p->area;
        }
        voxel[(r->axis + 1) % 3] = first_u + (int32_t)i;
        voxel[r->axis] = nook_grid_layer(depth / (double)p->area, r->inner[r->axis]);
        r->mark(r->user, voxel, corner_weight);
    }
}

void nook_rasterize_three_way(const nook_snapped_triangle *triangle, const int32_t inner[3], nook_rasterize_mark mark,
                              void *user)
{
    int32_t first[3], last[3];
    for (int axis = 0; axis < 3; axis++) {
        int32_t a = triangle->corner[0][axis], b = triangle->corner[1][axis], c = triangle->corner[2][axis];
        first[axis] = first_centre(smallest(a, b, c));
        last[axis] = last_centre(largest(a, b, c));
    }
    for (int axis = 0; axis < 3; axis++) {
        int across = (axis + 1) % 3, up = (axis + 2) % 3;
        projection p;
        if (first[across] > last[across] || first[up] > last[up] || !project(triangle, axis, &p))
            continue;
        raster r = { inner, axis, mark, user };
        for (int32_t row = first[up]; row <= last[up]; row++)
            rasterize_row(&p, &r, first[across], last[across], row);
    }
}

static double distance_squared(const int32_t a[3], const int32_t b[3])
{
    double x = (double)b[0] - a[0], y = (double)b[1] - a[1], z = (double)b[2] - a[2];
    return x * x + y * y + z * z;
}

/* Height of the triangle over edge (from, to) of length `length`, both in steps. */
static double altitude(const nook_snapped_triangle *triangle, int from, int to, double length)
{
    const int32_t *a = triangle->corner[from], *b = triangle->corner[to], *c = triangle->corner[3 - from - to];
    double ab[3], ac[3], normal[3];
    for (int i = 0; i < 3; i++) {
        ab[i] = (double)b[i] - a[i];
        ac[i] = (double)c[i] - a[i];
    }
    nook_vector_cross(ab, ac, normal);
    return length > 0.0 ? nook_vector_length(normal) / length : 0.0;
}

void nook_rasterize_narrow(const nook_snapped_triangle *triangle, const int32_t inner[3],
                           const nook_voxel_grid *rasterized, nook_rasterize_mark mark, void *user)
{
    int from = 0;
    double longest = 0.0;
    for (int i = 0; i < 3; i++) {
        double squared = distance_squared(triangle->corner[i], triangle->corner[(i + 1) % 3]);
        if (squared > longest) {
            longest = squared;
            from = i;
        }
    }
    int to = (from + 1) % 3;
    double length = sqrt(longest);
    if (altitude(triangle, from, to, length) >= narrow_voxels * NOOK_SUBVOXEL)
        return;
    /* Half a voxel a step: no voxel that the edge crosses for longer than that is passed over. */
    int32_t steps = 1 + (int32_t)(length / (NOOK_SUBVOXEL / 2));
    for (int32_t i = 0; i < steps; i++) {
        double at = (i + 0.5) / steps, weight[3] = { 0.0, 0.0, 0.0 };
        int32_t voxel[3];
        weight[from] = 1.0 - at;
        weight[to] = at;
        for (int axis = 0; axis < 3; axis++) {
            double a = triangle->corner[from][axis], b = triangle->corner[to][axis];
            voxel[axis] = nook_grid_layer(a + (b - a) * at, inner[axis]);
        }
        if (!nook_voxel_grid_has_near(rasterized, voxel))
            mark(user, voxel, weight);
    }
}
