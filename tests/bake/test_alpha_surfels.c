/* Surfels and voxels of what is not opaque: a voxel counts by the area that its textures leave. */
#include "tests/support/surfel_shapes.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 16, LAYER = 9 }; /* z = 8.5 m of 16, and the border */
#define FULL NOOK_SURFEL_ALPHA_MAX

/* A square across z over all of the grid; uv is 0 to `repeat` along x and y. */
typedef struct square {
    test_sheet sheet;
    float uvs[6][2];
    nook_alpha_part part;
    nook_alphas alphas;
} square;

static square *make_square(float repeat, const nook_alpha_part *part)
{
    square *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->sheet = test_make_sheet(SIDE, (const float[]){ 0, 0, 8.5f }, (const float[]){ SIDE, 0, 0 },
                               (const float[]){ 0, SIDE, 0 });
    for (int k = 0; k < 4; k++) {
        s->uvs[k][0] = k & 1 ? repeat : 0.0f;
        s->uvs[k][1] = k & 2 ? repeat : 0.0f;
    }
    s->part = *part;
    s->part.index_count = 6;
    s->alphas = (nook_alphas){ &s->part, 1, s->uvs[0] };
    return s;
}

static nook_volume make(const square *s, nook_volume_kind kind, uint32_t threads)
{
    nook_volume volume;
    const nook_triangles triangles = test_sheet_triangles(&s->sheet);
    const nook_voxelize_desc desc = {
        .resolution = SIDE, .threads = threads, .kind = kind, .alphas = s->part.index_count ? &s->alphas : NULL
    };
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    return volume;
}

static double covered_at(const nook_volume *v, uint32_t x, uint32_t y)
{
    return test_covered_across_z(test_surfel_at(v, x, y, LAYER));
}

/* @return in voxel areas */
static double area_of(const nook_volume *v)
{
    double area = 0.0;
    for (uint32_t y = 1; y <= SIDE; y++)
        for (uint32_t x = 1; x <= SIDE; x++)
            area += covered_at(v, x, y);
    return area;
}

static double area_of_square(float repeat, const nook_alpha_part *part)
{
    square *s = make_square(repeat, part);
    nook_volume v = make(s, NOOK_VOLUME_SURFEL, 1);
    double area = area_of(&v);
    nook_volume_free(&v);
    free(s);
    return area;
}

/* A mask of `cells` x `cells` fields, of which every other one is there. @return owned by the part */
static nook_alpha_part checker(uint32_t cells)
{
    uint8_t *texels = malloc((size_t)cells * cells);
    assert_non_null(texels);
    for (uint32_t i = 0; i < cells * cells; i++)
        texels[i] = (i % cells + i / cells) % 2 ? 127 : 128;
    return test_mask(0, 0, texels, cells);
}

static void free_checker(nook_alpha_part *part)
{
    free((void *)(uintptr_t)part->texels);
}

/* Fields as large as two voxels, as one, and as parts of one; fields that lie askew to voxels; and so many that blocks are looked at. */
static void test_a_checker_leaves_half_of_a_square(void **state)
{
    (void)state;
    static const uint32_t cells[] = { 8, 16, 32, 128, 13, 200, 512 };
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
        nook_alpha_part part = checker(cells[i]);
        double kept = (cells[i] * cells[i] + 1) / 2 / (double)(cells[i] * cells[i]);
        assert_true(fabs(area_of_square(1.0f, &part) / (SIDE * SIDE) - kept) < 0.5 / FULL);
        free_checker(&part);
    }
}

static void test_repeated_textures_leave_as_much_however_often(void **state)
{
    (void)state;
    static const float repeats[] = { 2, 7, 40, 1000, -3, 1e7f, 1e30f };
    nook_alpha_part part = checker(32);
    for (size_t i = 0; i < sizeof repeats / sizeof *repeats; i++)
        assert_true(fabs(area_of_square(repeats[i], &part) / (SIDE * SIDE) - 0.5) < 0.6 / FULL);
    free_checker(&part);
}

/* As the rays of the reference see it: engine/core/alpha.h. */
static void test_a_texture_without_a_place_leaves_all(void **state)
{
    (void)state;
    nook_alpha_part part = checker(32);
    assert_true(area_of_square(NAN, &part) == SIDE * SIDE);
    assert_true(area_of_square(INFINITY, &part) == SIDE * SIDE);
    free_checker(&part);
}

static void test_each_voxel_has_the_area_of_its_own_texels(void **state)
{
    (void)state;
    nook_alpha_part part = checker(SIDE);
    square *s = make_square(1.0f, &part);
    nook_volume v = make(s, NOOK_VOLUME_SURFEL, 1);
    for (uint32_t y = 1; y <= SIDE; y++)
        for (uint32_t x = 1; x <= SIDE; x++) /* boundaries of voxels lie 1/1000 voxel below those of texels */
            assert_true(fabs(covered_at(&v, x, y) - ((x + y) % 2 ? 0.0 : 1.0)) <= 1.0 / FULL);
    nook_volume_free(&v);
    free(s);
    free_checker(&part);
}

/* A quarter of each voxel is there, at its low corner: the plane is where the whole square is. */
static void test_what_a_mask_leaves_lies_in_the_plane_of_the_surface(void **state)
{
    (void)state;
    uint8_t texels[32 * 32];
    for (int i = 0; i < 32 * 32; i++)
        texels[i] = i % 2 == 0 && i / 32 % 2 == 0 ? 255 : 0;
    const nook_alpha_part part = test_mask(0, 0, texels, 32);
    square *s = make_square(1.0f, &part);
    nook_volume v = make(s, NOOK_VOLUME_SURFEL, 1);
    for (uint32_t x = 2; x < SIDE; x++) {
        nook_surfel_plane plane = nook_surfel_unpack(test_surfel_at(&v, x, 5, LAYER)->plane[0]);
        assert_true(fabs(covered_at(&v, x, 5) - 0.25) < 0.5 / FULL);
        assert_true(fabs(plane.normal[2]) == 1.0);
        assert_true(fabs(plane.offset) <= 0.5 * NOOK_SURFEL_OFFSET_MAX / 127.0);
    }
    nook_volume_free(&v);
    free(s);
}

static void test_blended_surfaces_count_by_their_alpha(void **state)
{
    (void)state;
    const uint8_t texels[] = { 51, 255 };
    const nook_alpha_part plain = { .alpha = 0.4f }, clear = { .alpha = 0.0f };
    const nook_alpha_part textured = { .alpha = 0.5f, .texels = texels, .width = 2, .height = 1, .texel_size = 1 };
    assert_true(fabs(area_of_square(1.0f, &plain) / (SIDE * SIDE) - 0.4) < 0.5 / FULL);
    assert_true(area_of_square(1.0f, &clear) == 0.0);
    assert_true(fabs(area_of_square(1.0f, &textured) / (SIDE * SIDE) - 0.3) < 0.5 / FULL);
}

static void test_a_mask_that_keeps_all_changes_no_bit(void **state)
{
    (void)state;
    const uint8_t texel = 200;
    const nook_alpha_part part = test_mask(0, 0, &texel, 1);
    square *s = make_square(3.0f, &part);
    nook_volume masked = make(s, NOOK_VOLUME_SURFEL, 1);
    s->part.index_count = 0;
    nook_volume opaque = make(s, NOOK_VOLUME_SURFEL, 1);
    test_assert_same_surfels(&masked, &opaque);
    assert_true(masked.info.content_hash != opaque.info.content_hash);
    nook_volume_free(&masked);
    nook_volume_free(&opaque);
    free(s);
}

static void test_neither_threads_nor_the_first_corner_change_a_bit(void **state)
{
    (void)state;
    nook_alpha_part part = checker(50);
    square *s = make_square(1.0f, &part);
    nook_volume one = make(s, NOOK_VOLUME_SURFEL, 1), many = make(s, NOOK_VOLUME_SURFEL, 3);
    const uint32_t turned[] = { 2, 0, 1, 3, 2, 1, 4, 4, 4, 5, 5, 5 };
    memcpy(s->sheet.indices, turned, sizeof turned);
    nook_volume other = make(s, NOOK_VOLUME_SURFEL, 1);
    test_assert_same_surfels(&one, &many);
    test_assert_same_surfels(&one, &other);
    nook_volume_free(&one);
    nook_volume_free(&many);
    nook_volume_free(&other);
    free(s);
    free_checker(&part);
}

static uint64_t occupied_of(const square *s, uint64_t *out_hash)
{
    nook_volume v = make(s, NOOK_VOLUME_BINARY, 2);
    uint64_t occupied = v.info.occupied;
    *out_hash = v.info.content_hash;
    nook_volume_free(&v);
    return occupied;
}

/* The two specks that hold the box are two voxels. */
static void test_voxels_have_the_holes_of_masks_and_take_glass_whole(void **state)
{
    (void)state;
    nook_alpha_part part = checker(8);
    square *s = make_square(1.0f, &part);
    uint64_t hash[3];
    assert_int_equal(occupied_of(s, &hash[0]), 2 + SIDE * SIDE / 2);
    s->part.masked = false;
    s->part.alpha = 0.1f;
    assert_int_equal(occupied_of(s, &hash[1]), 2 + SIDE * SIDE);
    s->part.index_count = 0;
    assert_int_equal(occupied_of(s, &hash[2]), 2 + SIDE * SIDE);
    assert_true(hash[0] != hash[2]);
    assert_true(hash[1] == hash[2]); /* they are the same voxels */
    free(s);
    free_checker(&part);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_checker_leaves_half_of_a_square),
        cmocka_unit_test(test_repeated_textures_leave_as_much_however_often),
        cmocka_unit_test(test_a_texture_without_a_place_leaves_all),
        cmocka_unit_test(test_each_voxel_has_the_area_of_its_own_texels),
        cmocka_unit_test(test_what_a_mask_leaves_lies_in_the_plane_of_the_surface),
        cmocka_unit_test(test_blended_surfaces_count_by_their_alpha),
        cmocka_unit_test(test_a_mask_that_keeps_all_changes_no_bit),
        cmocka_unit_test(test_neither_threads_nor_the_first_corner_change_a_bit),
        cmocka_unit_test(test_voxels_have_the_holes_of_masks_and_take_glass_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
