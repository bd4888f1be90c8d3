#include "tests/support/surfel_shapes.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_extent.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

nook_volume test_make_surfels(const nook_triangles *triangles, uint32_t resolution, uint32_t threads)
{
    nook_volume volume = { 0 };
    nook_voxelize_desc desc = { .resolution = resolution, .threads = threads, .kind = NOOK_VOLUME_SURFEL };
    assert_int_equal(nook_voxelize(triangles, &desc, &volume), NOOK_OK);
    assert_int_equal(volume.info.kind, NOOK_VOLUME_SURFEL);
    return volume;
}

const nook_surfel *test_surfel_at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z)
{
    uint32_t counts[3], below = 0, bit = nook_brick_bit(x, y, z);
    nook_brick_counts(&v->info, counts);
    const nook_brick *brick = &v->bricks[((size_t)(z / 4) * counts[1] + y / 4) * counts[0] + x / 4];
    if (!(brick->mask[bit / 32] >> (bit % 32) & 1))
        return NULL;
    for (uint32_t i = 0; i < bit; i++)
        below += brick->mask[i / 32] >> (i % 32) & 1;
    return &v->surfels[brick->first_surfel + below];
}

void test_assert_same_surfels(const nook_volume *a, const nook_volume *b)
{
    assert_int_equal(a->info.occupied, b->info.occupied);
    assert_int_equal(nook_brick_total(&a->info), nook_brick_total(&b->info));
    assert_memory_equal(a->bricks, b->bricks, nook_brick_total(&a->info) * sizeof *a->bricks);
    assert_memory_equal(a->surfels, b->surfels, (size_t)a->info.occupied * sizeof *a->surfels);
}

double test_covered_across_z(const nook_surfel *surfel)
{
    if (!surfel)
        return 0.0;
    assert_false(nook_surfel_word_is_plane(surfel->plane[1]));
    nook_surfel_extent box = nook_surfel_box_unpack(surfel->plane[1]);
    double alpha = nook_surfel_unpack(surfel->plane[0]).alpha / (double)NOOK_SURFEL_ALPHA_MAX;
    return alpha * (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
}

void test_to_voxels(const nook_volume *v, const double metres[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (metres[i] - v->info.origin[i]) / v->info.voxel_size;
}

double test_height_over(const nook_surfel_plane *plane, const uint32_t voxel[3], const double point[3])
{
    double height = -plane->offset;
    for (int i = 0; i < 3; i++)
        height += plane->normal[i] * (point[i] - voxel[i] - 0.5);
    return height;
}

test_sheet test_make_sheet(float side, const float corner[3], const float u[3], const float v[3])
{
    test_sheet sheet = { .indices = { 0, 1, 2, 2, 1, 3, 4, 4, 4, 5, 5, 5 } };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++)
            sheet.points[k][i] = corner[i] + (k & 1 ? u[i] : 0.0f) + (k & 2 ? v[i] : 0.0f);
        sheet.points[5][i] = side;
    }
    return sheet;
}

nook_triangles test_sheet_triangles(const test_sheet *sheet)
{
    return (nook_triangles){ sheet->points[0], 0, 6, sheet->indices, 12 };
}
