#include "tests/support/voxel_shapes.h"
#include "engine/core/angle.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

nook_volume test_voxelize(const nook_triangles *triangles, uint32_t resolution, uint32_t threads)
{
    nook_volume volume = { 0 };
    nook_voxelize_desc desc = { .resolution = resolution, .threads = threads };
    assert_int_equal(nook_voxelize(triangles, &desc, &volume), NOOK_OK);
    return volume;
}

int test_voxel_at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z)
{
    return v->voxels[((size_t)z * v->info.height + y) * v->info.width + x];
}

size_t test_voxel_count(const nook_volume *v)
{
    return (size_t)v->info.width * v->info.height * v->info.depth;
}

uint64_t test_count_occupied(const nook_volume *v)
{
    uint64_t count = 0;
    for (size_t i = 0; i < test_voxel_count(v); i++) {
        assert_true(v->voxels[i] == 0 || v->voxels[i] == 255);
        count += v->voxels[i] == 255;
    }
    return count;
}

void test_assert_border_empty(const nook_volume *v)
{
    for (uint32_t z = 0; z < v->info.depth; z++)
        for (uint32_t y = 0; y < v->info.height; y++)
            for (uint32_t x = 0; x < v->info.width; x++)
                if (x == 0 || y == 0 || z == 0 || x + 1 == v->info.width || y + 1 == v->info.height ||
                    z + 1 == v->info.depth)
                    assert_int_equal(test_voxel_at(v, x, y, z), 0);
}

void test_assert_same_voxels(const nook_volume *a, const nook_volume *b)
{
    assert_int_equal(a->info.width, b->info.width);
    assert_int_equal(a->info.height, b->info.height);
    assert_int_equal(a->info.depth, b->info.depth);
    assert_memory_equal(a->voxels, b->voxels, test_voxel_count(a));
}

/* ---- Shapes ----------------------------------------------------------------------------------------------------- */

const uint32_t test_box_indices[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };

void test_make_box(float x, float y, float z, float out[8][3])
{
    for (int i = 0; i < 8; i++) {
        out[i][0] = i & 1 ? x : 0.0f;
        out[i][1] = i & 2 ? y : 0.0f;
        out[i][2] = i & 4 ? z : 0.0f;
    }
}

void test_rotate(float (*points)[3], uint32_t count, double about_x, double about_y)
{
    for (uint32_t i = 0; i < count; i++) {
        double x = points[i][0], y = points[i][1], z = points[i][2];
        double y1 = cos(about_x) * y - sin(about_x) * z, z1 = sin(about_x) * y + cos(about_x) * z;
        points[i][0] = (float)(cos(about_y) * x + sin(about_y) * z1);
        points[i][1] = (float)y1;
        points[i][2] = (float)(-sin(about_y) * x + cos(about_y) * z1);
    }
}

test_sphere *test_make_sphere(double radius)
{
    test_sphere *s = malloc(sizeof *s);
    assert_non_null(s);
    size_t n = 0;
    for (int r = 0; r <= RINGS; r++)
        for (int c = 0; c < SECTORS; c++) {
            double latitude = NOOK_PI * r / RINGS, longitude = 2.0 * NOOK_PI * c / SECTORS;
            float *p = s->points[r * SECTORS + c];
            p[0] = (float)(radius * sin(latitude) * cos(longitude));
            p[1] = (float)(radius * cos(latitude));
            p[2] = (float)(radius * sin(latitude) * sin(longitude));
        }
    for (uint32_t r = 0; r < RINGS; r++)
        for (uint32_t c = 0; c < SECTORS; c++) {
            uint32_t a = r * SECTORS + c, b = r * SECTORS + (c + 1) % SECTORS;
            const uint32_t quad[6] = { a, b, a + SECTORS, b, b + SECTORS, a + SECTORS };
            memcpy(s->indices + n, quad, sizeof quad);
            n += 6;
        }
    return s;
}

nook_triangles test_sphere_triangles(const test_sphere *s)
{
    return (nook_triangles){ s->points[0], 0, SPHERE_VERTICES, s->indices, SPHERE_INDICES };
}

nook_triangles test_box_triangles(float (*points)[3])
{
    return (nook_triangles){ points[0], 0, 8, test_box_indices, 36 };
}
