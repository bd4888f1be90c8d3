/* A brute-force ray caster: the G-buffer of a few triangles, without a rasteriser's rounding. */
#include "tests/support/ao_view.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

typedef struct hit {
    double distance; /* along the ray, in lengths of its direction */
    double normal[3];
} hit;

/** Moeller and Trumbore; keeps the nearest. */
static void meet(const double corner[3][3], const double eye[3], const double ray[3], hit *nearest)
{
    double u[3], v[3], from[3], p[3], q[3], normal[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = corner[1][axis] - corner[0][axis];
        v[axis] = corner[2][axis] - corner[0][axis];
        from[axis] = eye[axis] - corner[0][axis];
    }
    cross(ray, v, p);
    cross(from, u, q);
    double determinant = dot(u, p);
    if (determinant == 0.0)
        return;
    double a = dot(from, p) / determinant, b = dot(ray, q) / determinant, t = dot(v, q) / determinant;
    if (a < 0.0 || b < 0.0 || a + b > 1.0 || t <= 0.0 || t >= nearest->distance)
        return;
    cross(u, v, normal);
    double size = sqrt(dot(normal, normal)) * (dot(normal, ray) > 0.0 ? -1.0 : 1.0);
    nearest->distance = t;
    for (int axis = 0; axis < 3; axis++)
        nearest->normal[axis] = normal[axis] / size;
}

static void cast(const fixture_mesh *mesh, const double eye[3], const double ray[3], hit *nearest)
{
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        double corner[3][3];
        for (uint32_t k = 0; k < 9; k++)
            corner[k / 3][k % 3] = mesh->positions[mesh->indices[i + k / 3] * 3 + k % 3];
        meet((const double(*)[3])corner, eye, ray, nearest);
    }
}

void ao_view_draw(ao_view *view, const fixture_mesh *mesh)
{
    nook_matrix world_from_view;
    double eye[3];
    assert_true(nook_matrix_inverse_affine(&view->view_from_world, &world_from_view));
    nook_matrix_apply_point(&world_from_view, (double[]){ 0, 0, 0 }, eye);
    for (uint32_t y = 0; y < view->height; y++) {
        for (uint32_t x = 0; x < view->width; x++) {
            double ray[3];
            hit nearest = { .distance = INFINITY };
            ao_view_position(view, x, y, 1.0, ray); /* z = -1: distances are along -Z */
            nook_matrix_apply_vector(&world_from_view, ray, ray);
            cast(mesh, eye, ray, &nearest);
            if (isfinite(nearest.distance))
                ao_view_set_pixel(view, x, y, nearest.distance, nearest.normal);
        }
    }
}
