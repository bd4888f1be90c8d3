/** fixture_mesh.h - exact geometry made by code. */
#pragma once
#include <stdint.h>

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
