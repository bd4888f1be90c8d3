#include "tests/support/ao_fixture.h"
#include <math.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

int ao_fixture_setup(void **state)
{
    ao_fixture *fixture = calloc(1, sizeof *fixture);
    assert_non_null(fixture);
    fixture->view = ao_view_create(AO_FIXTURE_SIZE, AO_FIXTURE_SIZE);
    fixture->view_angle = 1e-3;
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
    ao_view_drop_occluders(fixture->view);
}

double ao_fixture_add(ao_fixture *fixture, const fixture_mesh *mesh, uint32_t resolution)
{
    return ao_view_add(fixture->view, mesh, resolution);
}

static fixture_result summarize(const float *visibility, size_t count)
{
    fixture_result result = { .lowest = 2.0, .highest = -1.0 };
    for (size_t i = 0; i < count; i++) {
        double occlusion = 1.0 - visibility[i];
        result.mean += occlusion / (double)count;
        result.lowest = occlusion < result.lowest ? occlusion : result.lowest;
        result.highest = occlusion > result.highest ? occlusion : result.highest;
    }
    return result;
}

/** The receiver's plane, seen head-on: the same depth and normal in every pixel. */
fixture_result ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                  const double normal[3], double distance)
{
    ao_view *view = fixture->view;
    double eye[3], up[3] = { 0, 0, 0 };
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = point[axis] + normal[axis] * distance;
    up[fabs(normal[1]) < 0.9 ? 1 : 0] = 1.0;
    view->view_from_world = nook_matrix_look_at(eye, point, up);
    view->clip_from_view = nook_matrix_perspective_reversed(fixture->view_angle, 1.0, 0.1 * distance);
    for (uint32_t i = 0; i < AO_FIXTURE_SIZE * AO_FIXTURE_SIZE; i++)
        ao_view_set_pixel(view, i % AO_FIXTURE_SIZE, i / AO_FIXTURE_SIZE, distance, normal);
    ao_view_record(view, technique);
    return summarize(view->visibility, AO_FIXTURE_SIZE * AO_FIXTURE_SIZE);
}
