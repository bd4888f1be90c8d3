#include "engine/core/log.h"
#include "engine/core/surface.h"
#include "engine/core/vector.h"
#include "modules/ao_reference/depth_mesh_internal.h"
#include "modules/trace/pixel.h"
#include <stdlib.h>

/** The points of one row; z is 0 where nothing is seen. */
static void read_row(const nook_ao_pass *pass, const float *depth, const uint16_t *normal, uint32_t y,
                     nook_surface_point *out)
{
    for (uint32_t x = 0; x < pass->width; x++) {
        size_t i = (size_t)y * pass->width + x;
        out[x] = (nook_surface_point){ .position = { 0.0 } };
        if (!(depth[i] > 0.0f))
            continue;
        nook_pixel_position(pass, x, y, (double)depth[i], out[x].position);
        nook_pixel_normal(normal + 2 * i, out[x].normal);
    }
}

static void write_vertices(const nook_surface_point *row, uint32_t width, float *out)
{
    for (size_t i = 0; i < 3 * (size_t)width; i++)
        out[i] = (float)row[i / 3].position[i % 3];
}

static bool joins(const nook_surface_point *a, const nook_surface_point *b)
{
    return a->position[2] < 0.0 && b->position[2] < 0.0 && nook_surface_joins(a, b);
}

static void add_triangle(depth_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *out = mesh->indices + mesh->index_count;
    out[0] = a, out[1] = b, out[2] = c;
    mesh->index_count += 3;
}

/** The square whose lower left corner is pixel x of the lower row, whose first vertex is `first`. */
static void add_square(depth_mesh *mesh, const nook_surface_point *lower, const nook_surface_point *upper, uint32_t x,
                       uint32_t first, uint32_t width)
{
    const nook_surface_point *a = &lower[x], *b = &lower[x + 1], *c = &upper[x], *d = &upper[x + 1];
    uint32_t ia = first + x, ib = ia + 1, ic = ia + width, id = ic + 1;
    bool bottom = joins(a, b), top = joins(c, d), left = joins(a, c), right = joins(b, d);
    int rising = joins(a, d) ? (bottom && right) + (left && top) : 0;
    int falling = joins(b, c) ? (bottom && left) + (right && top) : 0;
    bool along_rising = nook_vector_dot(a->normal, d->normal) >= nook_vector_dot(b->normal, c->normal);
    if (rising > falling || (rising == falling && along_rising)) {
        if (rising && bottom && right)
            add_triangle(mesh, ia, ib, id);
        if (rising && left && top)
            add_triangle(mesh, ia, id, ic);
    } else {
        if (falling && bottom && left)
            add_triangle(mesh, ia, ib, ic);
        if (falling && right && top)
            add_triangle(mesh, ib, id, ic);
    }
}

/** Only two rows are held in double at a time. */
static void fill_mesh(const nook_ao_pass *pass, const float *depth, const uint16_t *normal, nook_surface_point *rows,
                      depth_mesh *mesh)
{
    uint32_t width = pass->width;
    for (uint32_t y = 0; y < pass->height; y++) {
        nook_surface_point *upper = rows + (y % 2) * (size_t)width, *lower = rows + (1 - y % 2) * (size_t)width;
        read_row(pass, depth, normal, y, upper);
        write_vertices(upper, width, mesh->positions + 3 * (size_t)y * width);
        for (uint32_t x = 0; y > 0 && x + 1 < width; x++)
            add_square(mesh, lower, upper, x, (y - 1) * width, width);
    }
}

nook_result depth_mesh_create(const nook_ao_pass *pass, const float *depth, const uint16_t *normal,
                              depth_mesh *out_mesh)
{
    size_t pixels = (size_t)pass->width * pass->height, squares = (size_t)(pass->width - 1) * (pass->height - 1);
    depth_mesh mesh = { .positions = malloc(pixels * 3 * sizeof *mesh.positions),
                        .indices = malloc((squares + 1) * 6 * sizeof *mesh.indices),
                        .vertex_count = (uint32_t)pixels };
    nook_surface_point *rows = malloc(2 * (size_t)pass->width * sizeof *rows);
    *out_mesh = (depth_mesh){ 0 };
    if (!mesh.positions || !mesh.indices || !rows) {
        depth_mesh_free(&mesh);
        free(rows);
        return nook_fail(NOOK_E_MEMORY, "reference: no memory for the surfaces of %ux%u pixels", pass->width,
                         pass->height);
    }
    fill_mesh(pass, depth, normal, rows, &mesh);
    free(rows);
    *out_mesh = mesh;
    return NOOK_OK;
}

void depth_mesh_free(depth_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
    *mesh = (depth_mesh){ 0 };
}
