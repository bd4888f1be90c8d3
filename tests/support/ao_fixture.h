/** ao_fixture.h - modules/fixture/receiver.h for tests: one receiver point, with failures that fail the test. */
#pragma once
#include "modules/fixture/receiver.h"
#include "tests/support/ao_view.h"

enum { AO_FIXTURE_SIZE = 16 };

typedef struct ao_fixture {
    nook_fixture_view *view;
    double view_angle; /**< Radians the image spans; narrow unless a test widens it. */
} ao_fixture;

/** For cmocka: *state is an ao_fixture with the techniques of ao_view_create; the filter is off. */
int ao_fixture_setup(void **state);
int ao_fixture_teardown(void **state);

/** Drops every occluder. */
void ao_fixture_clear(ao_fixture *fixture);
/** As ao_view_add. */
double ao_fixture_add(ao_fixture *fixture, const nook_fixture_mesh *mesh, uint32_t resolution);

/** What `technique` computes at a point with a unit normal, seen from `distance` above it. */
nook_fixture_occlusion ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                          const double normal[3], double distance);
/** Sets a parameter or fails the test. */
void ao_fixture_param(ao_fixture *fixture, const char *name, const char *value);
/** Without occluders, a narrow view, hard falloff to r_max. @return *state */
ao_fixture *ao_fixture_begin(void **state, const char *r_max);

enum { AO_FIXTURE_NORMALS = 20 };
/** Unit normal k of AO_FIXTURE_NORMALS: the axes' neighbourhood, edges, corners and slight tilts. */
void ao_fixture_normal(int k, double out_normal[3]);

/** What a rough floor reads: bumps of half a voxel, on which rays may meet what they start from. */
typedef struct ao_rough_floor {
    double truth;         /**< Visibility by rays against its triangles. */
    double with, without; /**< By `volume` as it is, and with a constant that does nothing. */
} ao_rough_floor;
/** Adds and draws it. @param bumps  along a voxel @param constant  of `volume` @param value  with which that does nothing */
ao_rough_floor ao_fixture_measure_rough_floor(ao_fixture *fixture, int bumps, const char *constant, const char *value);
