/**
 * ao_fixture.h - exact geometry made by code, and one receiver point: what a technique computes there.
 *
 * The G-buffer is synthetic: a camera looks at the receiver's plane from above through a very narrow field of view, so that
 * every pixel of the small image sees the same point. The mean over the image then holds 16 blocks of rays.
 */
#pragma once
#include "modules/ao/nook_ao.h"
#include "tests/support/test_gpu.h"

enum { AO_FIXTURE_SIZE = 16, AO_FIXTURE_OCCLUDERS = 64 };

/** Triangles being put together. */
typedef struct fixture_mesh {
    float *positions; /**< xyz */
    uint32_t *indices;
    uint32_t vertex_count, index_count, vertex_capacity, index_capacity;
} fixture_mesh;

void fixture_mesh_free(fixture_mesh *mesh);
void fixture_triangle(fixture_mesh *mesh, const double a[3], const double b[3], const double c[3]);
/** Corner and two edges. */
void fixture_quad(fixture_mesh *mesh, const double corner[3], const double edge_u[3], const double edge_v[3]);
/** A disc around `centre`, normal +z. */
void fixture_disc(fixture_mesh *mesh, const double centre[3], double radius, uint32_t sides);
/** A sphere of latitude and longitude faces. */
void fixture_sphere(fixture_mesh *mesh, const double centre[3], double radius, uint32_t sides);
/** Open tube around the z axis from z0 to z1. */
void fixture_tube(fixture_mesh *mesh, double radius, double z0, double z1, uint32_t sides);
/** The six faces of the box, each two triangles. faces: bits 0..5 = -x +x -y +y -z +z. */
void fixture_box(fixture_mesh *mesh, const double low[3], const double high[3], unsigned faces);

typedef struct ao_fixture {
    test_gpu gpu;
    nook_ao *ao;
    nook_texture depth, normal;
    nook_ao_occluder occluders[AO_FIXTURE_OCCLUDERS];
    uint32_t occluder_count;
    double view_angle; /**< Radians the image spans; narrow unless a test widens it. */
} ao_fixture;

/** For cmocka: *state is an ao_fixture with the techniques volume, ssao, hsao and reference. */
int ao_fixture_setup(void **state);
int ao_fixture_teardown(void **state);

/** Drops every occluder. */
void ao_fixture_clear(ao_fixture *fixture);
/**
 * Adds triangles as an occluder, for the reference and, when resolution > 0, baked for the volumes.
 * @return metres per voxel, 0 without a volume
 */
double ao_fixture_add(ao_fixture *fixture, const fixture_mesh *mesh, uint32_t resolution);

/** Lowest, mean and highest occlusion A = 1 - visibility over the image. */
typedef struct fixture_result {
    double lowest, mean, highest;
} fixture_result;

/** What `technique` computes at a point with a unit normal, seen from `distance` above it. The filter is off. */
fixture_result ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                  const double normal[3], double distance);
/** Sets a parameter or fails the test. */
void ao_fixture_param(ao_fixture *fixture, const char *name, const char *value);
