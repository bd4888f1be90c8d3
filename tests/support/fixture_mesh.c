#include "tests/support/fixture_mesh.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

void fixture_mesh_free(fixture_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
    *mesh = (fixture_mesh){ 0 };
}

static uint32_t add_vertex(fixture_mesh *mesh, const double p[3])
{
    if (mesh->vertex_count == mesh->vertex_capacity) {
        mesh->vertex_capacity = mesh->vertex_capacity ? mesh->vertex_capacity * 2 : 64;
        mesh->positions = realloc(mesh->positions, mesh->vertex_capacity * 3 * sizeof(float));
        assert(mesh->positions);
    }
    for (int axis = 0; axis < 3; axis++)
        mesh->positions[mesh->vertex_count * 3 + (uint32_t)axis] = (float)p[axis];
    return mesh->vertex_count++;
}

void fixture_triangle(fixture_mesh *mesh, const double a[3], const double b[3], const double c[3])
{
    if (mesh->index_count + 3 > mesh->index_capacity) {
        mesh->index_capacity = mesh->index_capacity ? mesh->index_capacity * 2 : 96;
        mesh->indices = realloc(mesh->indices, mesh->index_capacity * sizeof(uint32_t));
        assert(mesh->indices);
    }
    mesh->indices[mesh->index_count++] = add_vertex(mesh, a);
    mesh->indices[mesh->index_count++] = add_vertex(mesh, b);
    mesh->indices[mesh->index_count++] = add_vertex(mesh, c);
}

void fixture_quad(fixture_mesh *mesh, const double corner[3], const double edge_u[3], const double edge_v[3])
{
    double b[3], c[3], d[3];
    for (int axis = 0; axis < 3; axis++) {
        b[axis] = corner[axis] + edge_u[axis];
        c[axis] = b[axis] + edge_v[axis];
        d[axis] = corner[axis] + edge_v[axis];
    }
    fixture_triangle(mesh, corner, b, c);
    fixture_triangle(mesh, corner, c, d);
}

void fixture_disc(fixture_mesh *mesh, const double centre[3], double radius, uint32_t sides)
{
    for (uint32_t i = 0; i < sides; i++) {
        double a = 2.0 * pi * i / sides, b = 2.0 * pi * (i + 1) / sides;
        double p[3] = { centre[0] + radius * cos(a), centre[1] + radius * sin(a), centre[2] };
        double q[3] = { centre[0] + radius * cos(b), centre[1] + radius * sin(b), centre[2] };
        fixture_triangle(mesh, centre, p, q);
    }
}

static void sphere_point(const double centre[3], double radius, double latitude, double longitude, double out[3])
{
    out[0] = centre[0] + radius * sin(latitude) * cos(longitude);
    out[1] = centre[1] + radius * sin(latitude) * sin(longitude);
    out[2] = centre[2] + radius * cos(latitude);
}

void fixture_sphere(fixture_mesh *mesh, const double centre[3], double radius, uint32_t sides)
{
    uint32_t rings = sides / 2;
    for (uint32_t ring = 0; ring < rings; ring++) {
        for (uint32_t side = 0; side < sides; side++) {
            double top = pi * ring / rings, bottom = pi * (ring + 1) / rings;
            double left = 2.0 * pi * side / sides, right = 2.0 * pi * (side + 1) / sides, p[4][3];
            sphere_point(centre, radius, top, left, p[0]);
            sphere_point(centre, radius, bottom, left, p[1]);
            sphere_point(centre, radius, bottom, right, p[2]);
            sphere_point(centre, radius, top, right, p[3]);
            if (ring + 1 < rings)
                fixture_triangle(mesh, p[0], p[1], p[2]);
            if (ring > 0)
                fixture_triangle(mesh, p[0], p[2], p[3]);
        }
    }
}

void fixture_tube(fixture_mesh *mesh, double radius, double z0, double z1, uint32_t sides)
{
    for (uint32_t i = 0; i < sides; i++) {
        double a = 2.0 * pi * i / sides, b = 2.0 * pi * (i + 1) / sides;
        double corner[3] = { radius * cos(a), radius * sin(a), z0 };
        double along[3] = { radius * (cos(b) - cos(a)), radius * (sin(b) - sin(a)), 0.0 }, up[3] = { 0, 0, z1 - z0 };
        fixture_quad(mesh, corner, along, up);
    }
}

void fixture_box(fixture_mesh *mesh, const double low[3], const double high[3], unsigned faces)
{
    for (int face = 0; face < 6; face++) {
        if (!(faces >> face & 1u))
            continue;
        int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corner[3] = { low[0], low[1], low[2] }, edge_u[3] = { 0, 0, 0 }, edge_v[3] = { 0, 0, 0 };
        corner[axis] = face & 1 ? high[axis] : low[axis];
        edge_u[u] = high[u] - low[u];
        edge_v[v] = high[v] - low[v];
        fixture_quad(mesh, corner, edge_u, edge_v);
    }
}
