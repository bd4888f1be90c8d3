#include "tests/support/ao_fixture.h"
#include <math.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double NARROW = 1e-3; /* radians */

int ao_fixture_setup(void **state)
{
    ao_fixture *fixture = calloc(1, sizeof *fixture);
    assert_non_null(fixture);
    fixture->view = ao_view_create(AO_FIXTURE_SIZE, AO_FIXTURE_SIZE);
    fixture->view_angle = NARROW;
    ao_fixture_param(fixture, "ao.filter", "none");
    *state = fixture;
    return 0;
}

int ao_fixture_teardown(void **state)
{
    ao_fixture *fixture = *state;
    ao_view_destroy(fixture->view);
    free(fixture);
    return 0;
}

void ao_fixture_param(ao_fixture *fixture, const char *name, const char *value)
{
    ao_view_param(fixture->view, name, value);
}

void ao_fixture_clear(ao_fixture *fixture)
{
    nook_fixture_view_drop_occluders(fixture->view);
}

double ao_fixture_add(ao_fixture *fixture, const nook_fixture_mesh *mesh, uint32_t resolution)
{
    return ao_view_add(fixture->view, mesh, resolution);
}

nook_fixture_occlusion ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                          const double normal[3], double distance)
{
    nook_fixture_receiver receiver = { .point = { point[0], point[1], point[2] },
                                       .normal = { normal[0], normal[1], normal[2] },
                                       .distance = distance,
                                       .angle = fixture->view_angle };
    nook_fixture_occlusion occlusion;
    assert_int_equal(nook_fixture_measure(fixture->view, technique, &receiver, &occlusion), NOOK_OK);
    assert_int_equal(fixture->view->outside, 0); /* never NaN, never out of range */
    return occlusion;
}

ao_fixture *ao_fixture_begin(void **state, const char *r_max)
{
    ao_fixture *fixture = *state;
    ao_fixture_clear(fixture);
    fixture->view_angle = NARROW;
    ao_fixture_param(fixture, "ao.falloff", "hard");
    ao_fixture_param(fixture, "ao.r_max", r_max);
    return fixture;
}

void ao_fixture_normal(int k, double out_normal[3])
{
    static const double tilts[5] = { 0.0, 0.05, 0.3, 0.615479709, 0.785398163 }; /* 35.26 degrees: (1, 1, 1) */
    static const double turns[4] = { 0.0, 0.785398163, 1.1, 2.5 };
    double tilt = tilts[k / 4], turn = turns[k % 4];
    out_normal[0] = sin(tilt) * cos(turn), out_normal[1] = sin(tilt) * sin(turn), out_normal[2] = cos(tilt);
}

/* ---- A rough floor ----------------------------------------------------------------------------------------------- */

enum { VOXELS = 32, PIXELS = 48 }; /* of the rough floor: along a side, and of its picture */

static double rough_height(int x, int y)
{
    uint32_t h = (uint32_t)x * 2654435761u ^ (uint32_t)y * 2246822519u;
    h = (h ^ h >> 15) * 2654435761u;
    return (h >> 16) / 65535.0 - 0.5;
}

/* Seen from above. */
static void draw_rough_floor(nook_fixture_view *view, int bumps)
{
    const int cells = bumps * VOXELS;
    const double side = 2.0, voxel = side / VOXELS, cell = side / cells, high = 0.5 * voxel;
    nook_fixture_mesh mesh = { 0 };
    for (int y = 0; y < cells; y++) {
        for (int x = 0; x < cells; x++) {
            double p[4][3];
            for (int k = 0; k < 4; k++) {
                int column = x + (k & 1), row = y + (k >> 1);
                p[k][0] = column * cell - 0.5 * side, p[k][1] = row * cell - 0.5 * side;
                p[k][2] = high * rough_height(column, row);
            }
            nook_fixture_add_triangle(&mesh, p[0], p[1], p[2]);
            nook_fixture_add_triangle(&mesh, p[2], p[1], p[3]);
        }
    }
    ao_view_resize(view, PIXELS, PIXELS);
    ao_view_add(view, &mesh, VOXELS);
    view->view_from_world = nook_matrix_translation(0, 0, -1.5);
    view->clip_from_view = nook_matrix_perspective_reversed(0.9, 1.0, 0.1);
    nook_fixture_view_clear(view);
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
}

static double mean_visibility(nook_fixture_view *view, const char *technique)
{
    ao_view_record(view, technique);
    return 1.0 - nook_fixture_summarize(view, 0, 0, PIXELS, PIXELS).mean;
}

ao_rough_floor ao_fixture_measure_rough_floor(ao_fixture *fixture, int bumps, const char *constant, const char *value)
{
    ao_rough_floor got;
    ao_fixture_param(fixture, "volume.rays", "16");
    ao_fixture_param(fixture, "reference.rays", "64");
    draw_rough_floor(fixture->view, bumps);
    got.truth = mean_visibility(fixture->view, "reference");
    got.with = mean_visibility(fixture->view, "volume");
    ao_fixture_param(fixture, constant, value);
    got.without = mean_visibility(fixture->view, "volume");
    return got;
}
