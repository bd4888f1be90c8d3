#include "engine/core/vector.h"
#include "modules/ao_hao/grid_internal.h"
#include <assert.h>
#include <math.h>
#include <string.h>

/* ---- boxes ---- */

bool hao_box_is_empty(const hao_box *box)
{
    for (int axis = 0; axis < 3; axis++)
        if (!(box->min[axis] <= box->max[axis]))
            return true;
    return false;
}

void hao_box_add_point(hao_box *box, const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box->min[axis] = fmin(box->min[axis], point[axis]);
        box->max[axis] = fmax(box->max[axis], point[axis]);
    }
}

void hao_box_add(hao_box *box, const hao_box *other)
{
    if (hao_box_is_empty(other))
        return;
    hao_box_add_point(box, other->min);
    hao_box_add_point(box, other->max);
}

void hao_box_cut(hao_box *box, const hao_box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        box->min[axis] = fmax(box->min[axis], other->min[axis]);
        box->max[axis] = fmin(box->max[axis], other->max[axis]);
    }
}

static hao_box grown(const hao_box *box, double by)
{
    hao_box out = *box;
    for (int axis = 0; axis < 3; axis++) {
        out.min[axis] -= by;
        out.max[axis] += by;
    }
    return out;
}

hao_box hao_box_transform(const hao_box *box, const nook_matrix *transform)
{
    double centre[3], half[3], to[3];
    hao_box out;
    if (hao_box_is_empty(box))
        return hao_nothing;
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = 0.5 * (box->min[axis] + box->max[axis]);
        half[axis] = 0.5 * (box->max[axis] - box->min[axis]);
    }
    nook_matrix_apply_point(transform, centre, to);
    for (int row = 0; row < 3; row++) {
        double reach = 0.0;
        for (int column = 0; column < 3; column++)
            reach += fabs(transform->m[column * 4 + row]) * half[column];
        out.min[row] = to[row] - reach;
        out.max[row] = to[row] + reach;
    }
    return out;
}

/* ---- what the view may show ---- */

/* A side adds a corner to a convex polygon, but half of all corners to one that rounding has made wavy, in the plane of the side: 4, 6, 9,
   13, 19. */
enum { SIDES = 4, CORNERS_MAX = 19 };

/* Inside where dot(normal, point - eye) >= 0; the sides of the picture. */
static void view_sides(const hao_view *view, double out_normals[SIDES][3])
{
    for (int axis = 0; axis < 2; axis++) {
        double reach = fabs(view->ray_scale[axis]); /* a projection may be flipped */
        double low[3] = { 0.0, 0.0, view->ray_offset[axis] - reach },
               high[3] = { 0.0, 0.0, -view->ray_offset[axis] - reach };
        low[axis] = 1.0;
        high[axis] = -1.0;
        nook_matrix_apply_vector(&view->grid_from_view, low, out_normals[2 * axis]);
        nook_matrix_apply_vector(&view->grid_from_view, high, out_normals[2 * axis + 1]);
    }
}

typedef struct polygon {
    double corners[CORNERS_MAX][3];
    int count;
} polygon;

/* Sutherland, Hodgman 1974: what of a convex polygon is inside of a plane through the eye. */
static polygon clipped(const polygon *from, const double eye[3], const double normal[3])
{
    polygon out = { .count = 0 };
    for (int i = 0; i < from->count; i++) {
        const double *a = from->corners[i], *b = from->corners[(i + 1) % from->count];
        double to_a[3], to_b[3];
        nook_vector_add_scaled(a, -1.0, eye, to_a);
        nook_vector_add_scaled(b, -1.0, eye, to_b);
        double height_a = nook_vector_dot(normal, to_a), height_b = nook_vector_dot(normal, to_b);
        if (height_a >= 0.0)
            memcpy(out.corners[out.count++], a, sizeof to_a);
        if ((height_a >= 0.0) != (height_b >= 0.0)) {
            double part = height_a / (height_a - height_b);
            for (int axis = 0; axis < 3; axis++)
                out.corners[out.count][axis] = a[axis] + part * (b[axis] - a[axis]);
            out.count++;
        }
    }
    return out;
}

static polygon face_of(const hao_box *box, int face)
{
    int across = face / 2, u = (across + 1) % 3, v = (across + 2) % 3;
    polygon out = { .count = 4 };
    for (int i = 0; i < 4; i++) {
        out.corners[i][across] = face % 2 ? box->max[across] : box->min[across];
        out.corners[i][u] = i == 1 || i == 2 ? box->max[u] : box->min[u];
        out.corners[i][v] = i >= 2 ? box->max[v] : box->min[v];
    }
    return out;
}

/* Around what of `box` the picture may show: corners of a convex body, which lie on the box's faces or are the eye. */
static hao_box seen_part(const hao_view *view, const hao_box *box)
{
    double normals[SIDES][3], origin[3] = { 0 }, eye[3];
    hao_box seen = hao_nothing;
    view_sides(view, normals);
    nook_matrix_apply_point(&view->grid_from_view, origin, eye);
    for (int face = 0; face < 6; face++) {
        polygon part = face_of(box, face);
        for (int side = 0; side < SIDES; side++)
            part = clipped(&part, eye, normals[side]);
        for (int i = 0; i < part.count; i++)
            hao_box_add_point(&seen, part.corners[i]);
    }
    bool holds_eye = true;
    hao_box near = { { eye[0] - view->far, eye[1] - view->far, eye[2] - view->far },
                     { eye[0] + view->far, eye[1] + view->far, eye[2] + view->far } };
    for (int axis = 0; axis < 3; axis++)
        holds_eye = holds_eye && eye[axis] >= box->min[axis] && eye[axis] <= box->max[axis];
    if (holds_eye)
        hao_box_add_point(&seen, eye);
    hao_box_cut(&seen, &near);
    return seen;
}

/* ---- the grid ---- */

nook_matrix hao_diagonal_axes(void)
{
    const double s2 = sqrt(1.0 / 2.0), s3 = sqrt(1.0 / 3.0), s6 = sqrt(1.0 / 6.0);
    nook_matrix m = nook_matrix_identity();
    const double rows[3][3] = { { s2, -s2, 0.0 }, { s6, s6, -2.0 * s6 }, { s3, s3, s3 } };
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            m.m[column * 4 + row] = rows[row][column];
    return m;
}

/* Metres: a scene may have no size at all, and its inverse must be a float. */
static const double FINEST = 1e-18;

/* Of all sizes 2^(k/8) the smallest with which a length takes `resolution` voxels, wherever they begin. */
static double voxel_size(double length, uint32_t resolution)
{
    double least = fmax(length / (resolution - 2), FINEST);
    return exp2(ceil(8.0 * log2(least)) / 8.0);
}

void hao_grid_place(const hao_view *view, const hao_box *scene, uint32_t resolution, hao_grid *out_grid)
{
    assert(resolution >= 4);
    hao_box receivers = grown(scene, view->r_max), seen;
    *out_grid = (hao_grid){ .voxel_size = 1.0, .voxel_from_view = nook_matrix_identity() };
    if (hao_box_is_empty(scene))
        return;
    seen = seen_part(view, &receivers);
    if (hao_box_is_empty(&seen))
        return;
    hao_box box = grown(&seen, view->r_max);
    hao_box_cut(&box, scene);
    if (hao_box_is_empty(&box))
        return;
    double length = 0.0;
    for (int axis = 0; axis < 3; axis++)
        length = fmax(length, box.max[axis] - box.min[axis]);
    double size = voxel_size(length, resolution);
    for (int axis = 0; axis < 3; axis++) {
        out_grid->first[axis] = floor(box.min[axis] / size);
        double count =
            floor(box.max[axis] / size + 0.001) - out_grid->first[axis] + 1.0; /* ties take the upper voxel */
        out_grid->size[axis] = count < resolution ? (uint32_t)count : resolution;
    }
    nook_matrix scale = nook_matrix_scale(1.0 / size, 1.0 / size, 1.0 / size),
                shift = nook_matrix_translation(-out_grid->first[0], -out_grid->first[1], -out_grid->first[2]);
    nook_matrix voxel_from_grid = nook_matrix_multiply(&shift, &scale);
    out_grid->voxel_size = size;
    out_grid->box = box;
    out_grid->voxel_from_view = nook_matrix_multiply(&voxel_from_grid, &view->grid_from_view);
}
