/**
 * ao_fixture.h - one receiver point under exact geometry: what a technique computes there.
 *
 * The G-buffer is synthetic: a camera looks at the receiver's plane from above through a very narrow field of view, so that
 * every pixel of the small image sees the same point. The mean over the image then holds 16 blocks of rays.
 */
#pragma once
#include "tests/support/ao_view.h"

enum { AO_FIXTURE_SIZE = 16 };

typedef struct ao_fixture {
    ao_view *view;
    double view_angle; /**< Radians the image spans; narrow unless a test widens it. */
} ao_fixture;

/** For cmocka: *state is an ao_fixture with the techniques of an ao_view; the filter is off. */
int ao_fixture_setup(void **state);
int ao_fixture_teardown(void **state);

/** Drops every occluder. */
void ao_fixture_clear(ao_fixture *fixture);
/** As ao_view_add. */
double ao_fixture_add(ao_fixture *fixture, const fixture_mesh *mesh, uint32_t resolution);

/** Lowest, mean and highest occlusion A = 1 - visibility over the image. */
typedef struct fixture_result {
    double lowest, mean, highest;
} fixture_result;

/** What `technique` computes at a point with a unit normal, seen from `distance` above it. */
fixture_result ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                  const double normal[3], double distance);
/** Sets a parameter or fails the test. */
void ao_fixture_param(ao_fixture *fixture, const char *name, const char *value);
