#include "tests/support/ao_fixture.h"
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
