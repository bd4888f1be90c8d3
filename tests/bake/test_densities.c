/* The largest alpha in each voxel: panes, masks, textures, and what is refused. */
#include "modules/bake/density_bake.h"
#include "tests/support/log_capture.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* Two panes of 1 m across z, at z = 0.25 and 0.75; specks hold the box of 1 m. uv is xy. */
static const float points[10][3] = { { 0, 0, 0.25f }, { 1, 0, 0.25f }, { 1, 1, 0.25f }, { 0, 1, 0.25f },
                                     { 0, 0, 0.75f }, { 1, 0, 0.75f }, { 1, 1, 0.75f }, { 0, 1, 0.75f },
                                     { 0, 0, 0 },     { 1, 1, 1 } };
static const uint32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 8, 8, 9, 9, 9 };
static const float uvs[10][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
static const nook_triangles panes = { points[0], 0, 10, indices, 18 };
enum { SIDE = 16 };

static nook_volume make(const nook_alphas *alphas, uint32_t threads)
{
    nook_volume volume;
    const nook_voxelize_desc desc = {
        .resolution = SIDE, .threads = threads, .kind = NOOK_VOLUME_DENSITY, .alphas = alphas
    };
    assert_int_equal(nook_voxelize(&panes, &desc, &volume), NOOK_OK);
    return volume;
}

static uint8_t at(const nook_volume *v, uint32_t x, uint32_t y, uint32_t z)
{
    return v->voxels[((size_t)z * v->info.height + y) * v->info.width + x];
}

/* z = 0.25 lies on the boundary under layer 5 (the border is layer 0), 0.75 on that under 13. */
enum { LOWER = 5, UPPER = 13 };

static void test_opaque_densities_are_where_voxels_are(void **state)
{
    (void)state;
    nook_volume v = make(NULL, 1), binary;
    assert_int_equal(nook_voxelize(&panes, &(nook_voxelize_desc){ .resolution = SIDE }, &binary), NOOK_OK);
    assert_true(v.info.occupied == binary.info.occupied);
    assert_memory_equal(v.voxels, binary.voxels, (size_t)v.info.width * v.info.height * v.info.depth);
    nook_volume_free(&v);
    nook_volume_free(&binary);
}

static void test_each_pane_has_its_alpha_in_every_voxel(void **state)
{
    (void)state;
    const nook_alpha_part parts[] = { { .first_index = 0, .index_count = 6, .alpha = 0.4f },
                                      { .first_index = 6, .index_count = 6, .alpha = 0.8f } };
    const nook_alphas alphas = { parts, 2, NULL };
    nook_volume v = make(&alphas, 1);
    for (uint32_t y = 1; y <= SIDE; y++)
        for (uint32_t x = 1; x <= SIDE; x++) {
            assert_int_equal(at(&v, x, y, LOWER), 102);
            assert_int_equal(at(&v, x, y, UPPER), 204);
        }
    assert_int_equal(at(&v, 1, 1, 1), 255); /* a speck */
    nook_volume_free(&v);
}

static void test_the_largest_alpha_of_a_voxel_counts(void **state)
{
    (void)state;
    nook_triangles twice = panes;
    const uint32_t both[] = { 0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3, 8, 8, 8, 9, 9, 9 };
    const nook_alpha_part parts[] = { { .first_index = 0, .index_count = 6, .alpha = 0.4f },
                                      { .first_index = 6, .index_count = 6, .alpha = 0.2f } };
    const nook_alphas alphas = { parts, 2, NULL };
    nook_volume v;
    const nook_voxelize_desc desc = { .resolution = SIDE, .kind = NOOK_VOLUME_DENSITY, .alphas = &alphas };
    twice.indices = both;
    assert_int_equal(nook_voxelize(&twice, &desc, &v), NOOK_OK);
    assert_int_equal(at(&v, 4, 4, LOWER), 102);
    nook_volume_free(&v);
}

/* 2 x 1 texels: the left half has an alpha of 51, the right one of 255. */
static const uint8_t texels[8] = { 0, 0, 0, 51, 0, 0, 0, 255 };

static void test_masked_textures_leave_holes_and_blended_ones_multiply(void **state)
{
    (void)state;
    nook_alpha_part parts[] = { { .index_count = 6, .alpha = 1, .masked = true, .cutoff = 0.5f, .texels = texels },
                                { .first_index = 6, .index_count = 6, .alpha = 0.5f, .texels = texels } };
    for (int i = 0; i < 2; i++)
        parts[i].width = 2, parts[i].height = 1;
    const nook_alphas alphas = { parts, 2, uvs[0] };
    nook_volume v = make(&alphas, 1);
    assert_int_equal(at(&v, 3, 8, LOWER), 0);
    assert_int_equal(at(&v, 14, 8, LOWER), 255);
    assert_int_equal(at(&v, 3, 8, UPPER), 26); /* 51 / 2, rounded */
    assert_int_equal(at(&v, 14, 8, UPPER), 128);
    nook_volume_free(&v);
}

static void test_threads_change_no_density_and_what_is_seen_changes_the_hash(void **state)
{
    (void)state;
    nook_alpha_part part = { .index_count = 6, .alpha = 0.5f, .texels = texels, .width = 2, .height = 1 };
    const nook_alphas alphas = { &part, 1, uvs[0] };
    nook_volume one = make(&alphas, 1), many = make(&alphas, 3);
    assert_memory_equal(one.voxels, many.voxels, (size_t)one.info.width * one.info.height * one.info.depth);
    part.alpha = 0.6f;
    nook_volume other = make(&alphas, 1), opaque = make(NULL, 1);
    assert_true(one.info.content_hash == many.info.content_hash);
    assert_true(one.info.content_hash != other.info.content_hash);
    assert_true(one.info.content_hash != opaque.info.content_hash);
    nook_volume_free(&one);
    nook_volume_free(&many);
    nook_volume_free(&other);
    nook_volume_free(&opaque);
}

static void test_parts_that_are_none_are_refused(void **state)
{
    (void)state;
    const nook_alpha_part good = { .first_index = 6, .index_count = 6, .alpha = 0.5f };
    nook_alpha_part wrong[][2] = { { good, good },
                                   { { .first_index = 15, .index_count = 6 }, good },
                                   { { .first_index = 1, .index_count = 3 }, good },
                                   { { .index_count = 2 }, good },
                                   { { .index_count = 3, .texels = texels, .width = 2, .height = 1 }, good } };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        nook_volume v = { .info = { .occupied = 77 } };
        const nook_alphas alphas = { wrong[i], 2, NULL };
        const nook_voxelize_desc desc = { .resolution = 4, .kind = NOOK_VOLUME_DENSITY, .alphas = &alphas };
        assert_int_equal(nook_voxelize(&panes, &desc, &v), NOOK_E_ARG);
        assert_int_equal(v.info.occupied, 77);
    }
    nook_log_capture_end();
    assert_int_equal(log.count, (int)(sizeof wrong / sizeof *wrong));
}

static void test_a_file_of_densities_comes_back_and_one_that_is_none_is_refused(void **state)
{
    (void)state;
    const nook_alpha_part part = { .index_count = 12, .alpha = 0.3f };
    const nook_alphas alphas = { &part, 1, NULL };
    nook_volume v = make(&alphas, 1), back;
    void *bytes;
    size_t size;
    nook_log_capture log;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_volume_decode("densities", bytes, size, &back), NOOK_OK);
    assert_int_equal(back.info.kind, NOOK_VOLUME_DENSITY);
    assert_memory_equal(back.voxels, v.voxels, (size_t)v.info.width * v.info.height * v.info.depth);
    free(bytes);
    nook_log_capture_begin(&log);
    v.voxels[3] = 9; /* in the outermost layer, where marching looks at nothing */
    v.info.occupied++;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_E_ARG);
    v.voxels[3] = 0;
    assert_int_equal(nook_volume_encode(&v, &bytes, &size), NOOK_E_ARG); /* one more than there are */
    nook_log_capture_end();
    nook_volume_free(&v);
    nook_volume_free(&back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_opaque_densities_are_where_voxels_are),
        cmocka_unit_test(test_each_pane_has_its_alpha_in_every_voxel),
        cmocka_unit_test(test_the_largest_alpha_of_a_voxel_counts),
        cmocka_unit_test(test_masked_textures_leave_holes_and_blended_ones_multiply),
        cmocka_unit_test(test_threads_change_no_density_and_what_is_seen_changes_the_hash),
        cmocka_unit_test(test_parts_that_are_none_are_refused),
        cmocka_unit_test(test_a_file_of_densities_comes_back_and_one_that_is_none_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
