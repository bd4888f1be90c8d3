#include "tests/support/ao_screen.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double EDGE = 20.0; /* metres to where ground and walls end */

void ao_screen_look(nook_fixture_view *view, const double eye[3], const double target[3], double angle, double r_max)
{
    ao_view_param(view, "ao.filter", "none");
    ao_view_param(view, "ao.falloff", "hard");
    assert_int_equal(nook_ao_set_param(view->ao, "ao.r_max", r_max), NOOK_OK);
    double along[3] = { target[0] - eye[0], target[1] - eye[1], target[2] - eye[2] };
    double up[3] = { 0, 0, 0 };
    up[fabs(along[2]) > fabs(along[1]) ? 1 : 2] = 1.0;
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    view->clip_from_view = nook_matrix_perspective_reversed(angle, (double)view->width / view->height, 0.05);
    nook_fixture_view_drop_occluders(view);
    nook_fixture_view_clear(view);
}

void ao_screen_show(nook_fixture_view *view, nook_fixture_mesh *mesh)
{
    ao_view_draw(view, mesh);
    ao_view_add(view, mesh, 0);
    nook_fixture_mesh_free(mesh);
}

void ao_screen_add_floor(nook_fixture_mesh *mesh)
{
    nook_fixture_add_quad(mesh, (double[]){ -50, -50, 0 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
}

void ao_screen_add_pit(nook_fixture_mesh *mesh, double radius, double depth)
{
    enum { SIDES = 64 };
    nook_fixture_add_disc(mesh, (double[]){ 0, 0, 0 }, radius, SIDES);
    nook_fixture_add_tube(mesh, radius, 0.0, depth, SIDES);
    for (int i = 0; i < SIDES; i++) {
        double inner[2][3], outer[2][3];
        for (int side = 0; side < 2; side++) {
            double angle = 6.28318530717958648 * (i + side) / SIDES, c = cos(angle), s = sin(angle);
            inner[side][0] = radius * c, inner[side][1] = radius * s, inner[side][2] = depth;
            outer[side][0] = EDGE * c, outer[side][1] = EDGE * s, outer[side][2] = depth;
        }
        nook_fixture_add_triangle(mesh, inner[0], outer[0], outer[1]);
        nook_fixture_add_triangle(mesh, inner[0], outer[1], inner[1]);
    }
}

void ao_screen_add_corner(nook_fixture_mesh *mesh, double x, double angle)
{
    nook_fixture_add_quad(mesh, (double[]){ -EDGE, -EDGE, 0 }, (double[]){ EDGE + x, 0, 0 },
                          (double[]){ 0, 2 * EDGE, 0 });
    nook_fixture_add_quad(mesh, (double[]){ x, -EDGE, 0 }, (double[]){ 0, 2 * EDGE, 0 },
                          (double[]){ -EDGE * cos(angle), 0, EDGE * sin(angle) });
}

void ao_screen_add_trench(nook_fixture_mesh *mesh, double width, double depth)
{
    const double half = width / 2, along[3] = { 0, 2 * EDGE, 0 };
    nook_fixture_add_quad(mesh, (double[]){ -half, -EDGE, 0 }, (double[]){ width, 0, 0 }, along);
    for (int side = -1; side <= 1; side += 2) {
        nook_fixture_add_quad(mesh, (double[]){ side * half, -EDGE, 0 }, (double[]){ 0, 0, depth }, along);
        nook_fixture_add_quad(mesh, (double[]){ side * half, -EDGE, depth }, (double[]){ side * EDGE, 0, 0 }, along);
    }
}

double ao_screen_mean(const nook_fixture_view *view, uint32_t left, uint32_t bottom, uint32_t right, uint32_t top)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t y = bottom; y < top; y++) {
        for (uint32_t x = left; x < right; x++) {
            if (view->device_depth[y * view->width + x] > 0.0f)
                sum += 1.0 - view->visibility[y * view->width + x], count += 1.0;
        }
    }
    assert_true(count > 0.0);
    return sum / count;
}

double ao_screen_measure(nook_fixture_view *view, const char *technique)
{
    ao_view_record(view, technique);
    return ao_screen_mean(view, 0, 0, view->width, view->height);
}

double ao_screen_measure_centre(nook_fixture_view *view, const char *technique)
{
    uint32_t x = view->width / 2, y = view->height / 2;
    ao_view_record(view, technique);
    return ao_screen_mean(view, x - 2, y - 2, x + 2, y + 2);
}
