#include "modules/bake/polygon.h"
#include "engine/core/vector.h"
#include <assert.h>
#include <math.h>

static void append(nook_polygon *polygon, const double corner[3])
{
    assert(polygon->count < NOOK_POLYGON_CORNERS);
    for (int i = 0; i < 3; i++)
        polygon->corner[polygon->count][i] = corner[i];
    polygon->count++;
}

/* Where the edge from `low` (height below 0) to `high` (above 0) meets height 0: of one edge always the same point. */
static void cross(const double low[3], double below, const double high[3], double above, double out[3])
{
    double at = below / (below - above);
    for (int i = 0; i < 3; i++)
        out[i] = low[i] + (high[i] - low[i]) * at;
}

/* Sutherland, Hodgman 1974, by heights over a plane. Either output may be NULL. */
static void cut(const nook_polygon *polygon, const double *height, nook_polygon *below, nook_polygon *above)
{
    for (int i = 0; i < polygon->count; i++) {
        int next = i + 1 < polygon->count ? i + 1 : 0;
        const double *a = polygon->corner[i], *b = polygon->corner[next];
        if (below && height[i] <= 0.0)
            append(below, a);
        if (above && height[i] >= 0.0)
            append(above, a);
        if ((height[i] < 0.0 && height[next] > 0.0) || (height[i] > 0.0 && height[next] < 0.0)) {
            double point[3];
            if (height[i] < 0.0)
                cross(a, height[i], b, height[next], point);
            else
                cross(b, height[next], a, height[i], point);
            if (below)
                append(below, point);
            if (above)
                append(above, point);
        }
    }
}

static void drop_slivers(nook_polygon *polygon)
{
    if (polygon->count < 3)
        polygon->count = 0;
}

void nook_polygon_clip(const nook_polygon *polygon, const double normal[3], double offset, nook_polygon *out)
{
    double height[NOOK_POLYGON_CORNERS];
    for (int i = 0; i < polygon->count; i++)
        height[i] = nook_vector_dot(normal, polygon->corner[i]) - offset;
    out->count = 0;
    cut(polygon, height, 0, out);
    drop_slivers(out);
}

void nook_polygon_split(const nook_polygon *polygon, int axis, double at, nook_polygon *out_below,
                        nook_polygon *out_above)
{
    double height[NOOK_POLYGON_CORNERS];
    for (int i = 0; i < polygon->count; i++)
        height[i] = polygon->corner[i][axis] - at;
    out_below->count = out_above->count = 0;
    cut(polygon, height, out_below, out_above);
    drop_slivers(out_below);
    drop_slivers(out_above);
}

/* Of a triangle with corners a, b, c: integral of x y is area / 12 (sum of a_x a_y + (sum of x) (sum of y)). */
static void add_triangle(double corner[3][3], double area, nook_polygon_moments *moments)
{
    static const int pair[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 2, 0 } };
    double sum[3];
    for (int i = 0; i < 3; i++) {
        sum[i] = corner[0][i] + corner[1][i] + corner[2][i];
        moments->first[i] += area / 3.0 * sum[i];
    }
    for (int i = 0; i < 6; i++) {
        int x = pair[i][0], y = pair[i][1];
        double products = sum[x] * sum[y];
        for (int k = 0; k < 3; k++)
            products += corner[k][x] * corner[k][y];
        moments->second[i] += area / 12.0 * products;
    }
    moments->area += area;
}

nook_polygon_moments nook_polygon_measure(const nook_polygon *polygon, const double normal[3], const double origin[3])
{
    nook_polygon_moments moments = { 0 };
    for (int i = 2; i < polygon->count; i++) {
        double corner[3][3], u[3], v[3], area[3];
        for (int axis = 0; axis < 3; axis++) {
            corner[0][axis] = polygon->corner[0][axis] - origin[axis];
            corner[1][axis] = polygon->corner[i - 1][axis] - origin[axis];
            corner[2][axis] = polygon->corner[i][axis] - origin[axis];
            u[axis] = corner[1][axis] - corner[0][axis];
            v[axis] = corner[2][axis] - corner[0][axis];
        }
        nook_vector_cross(u, v, area);
        add_triangle(corner, 0.5 * fabs(nook_vector_dot(area, normal)), &moments);
    }
    return moments;
}

void nook_polygon_of_cube(const double normal[3], double offset, double low, nook_polygon *out)
{
    /* A square around the plane's foot, larger than any section of the cube. */
    const double half = 2.0, other[3] = { fabs(normal[0]) < 0.6, fabs(normal[0]) >= 0.6, 0.0 };
    double u[3], v[3];
    nook_vector_cross(normal, other, u);
    double length = nook_vector_length(u);
    for (int i = 0; i < 3; i++)
        u[i] /= length;
    nook_vector_cross(normal, u, v);
    nook_polygon polygon = { .count = 4 };
    for (int k = 0; k < 4; k++) {
        double a = k == 0 || k == 3 ? -half : half, b = k < 2 ? -half : half;
        for (int i = 0; i < 3; i++)
            polygon.corner[k][i] = normal[i] * offset + u[i] * a + v[i] * b;
    }
    for (int face = 0; face < 6; face++) {
        double inwards[3] = { 0.0, 0.0, 0.0 };
        nook_polygon rest;
        inwards[face / 2] = face % 2 ? -1.0 : 1.0;
        nook_polygon_clip(&polygon, inwards, face % 2 ? -1.0 - low : low, &rest);
        polygon = rest;
    }
    *out = polygon;
}
