/* A soup that was edited: only the bricks that its changed triangles touch are made, and no bit differs from making all. */
#include "modules/bake/brick_grid.h"
#include "modules/bake/cache.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 40, CELLS = 64, POINTS = (CELLS + 1) * (CELLS + 1), TRIANGLES = 2 * CELLS * CELLS };

/* Hills over a square, 40 voxels a side; the highest and lowest points are corners that no test moves. */
typedef struct hills {
    float points[POINTS + 2][3];
    float uvs[POINTS + 2][2];
    uint32_t indices[3 * (TRIANGLES + 1)];
    size_t index_count;
    uint8_t texels[16];
    nook_alpha_part part; /* the last half of the triangles */
    nook_alphas alphas;
} hills;

static hills *make_hills(void)
{
    hills *h = calloc(1, sizeof *h);
    assert_non_null(h);
    for (uint32_t i = 0; i < POINTS; i++) {
        float x = (float)(i % (CELLS + 1)) / CELLS, y = (float)(i / (CELLS + 1)) / CELLS;
        h->points[i][0] = x * SIDE, h->points[i][1] = y * SIDE;
        h->points[i][2] = SIDE * (0.5f + 0.2f * sinf(9.0f * x) * cosf(7.0f * y));
        h->uvs[i][0] = 20.0f * x, h->uvs[i][1] = 20.0f * y;
    }
    h->points[POINTS][2] = 0, h->points[POINTS + 1][2] = SIDE; /* a triangle without area that holds the box */
    uint32_t *next = h->indices;
    for (uint32_t i = 0; i < CELLS * CELLS; i++) {
        uint32_t low = i / CELLS * (CELLS + 1) + i % CELLS, high = low + CELLS + 1;
        const uint32_t cell[] = { low, low + 1, high, high, low + 1, high + 1 };
        memcpy(next, cell, sizeof cell);
        next += 6;
    }
    *next++ = POINTS, *next++ = POINTS + 1, *next++ = POINTS;
    h->index_count = (size_t)(next - h->indices);
    for (int i = 0; i < 16; i++)
        h->texels[i] = i % 3 ? 255 : 0;
    h->part = test_mask(3 * TRIANGLES / 2, 3 * TRIANGLES / 2, h->texels, 4);
    h->alphas = (nook_alphas){ &h->part, 1, h->uvs[0] };
    return h;
}

static hills *copy_of(const hills *from)
{
    hills *h = malloc(sizeof *h);
    assert_non_null(h);
    memcpy(h, from, sizeof *h);
    h->part.texels = h->texels;
    h->alphas = (nook_alphas){ &h->part, from->alphas.part_count, h->uvs[0] };
    return h;
}

static nook_triangles triangles_of(const hills *h)
{
    return (nook_triangles){ h->points[0], 0, POINTS + 2, h->indices, h->index_count };
}

static nook_voxelize_desc desc_of(const hills *h, uint32_t threads)
{
    return (
        nook_voxelize_desc){ .resolution = SIDE, .threads = threads, .kind = NOOK_VOLUME_SURFEL, .alphas = &h->alphas };
}

static nook_volume make(const hills *h)
{
    nook_volume volume;
    const nook_triangles triangles = triangles_of(h);
    const nook_voxelize_desc desc = desc_of(h, 1);
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    return volume;
}

/* Makes `after` of the volume of `before`, holds it against one that is made whole. @return bricks that were made */
static size_t rebake(const hills *before, const hills *after)
{
    nook_volume old = make(before), whole = make(after), again;
    const nook_triangles was = triangles_of(before), is = triangles_of(after);
    const nook_voxelize_before older = { &was, &before->alphas, &old };
    size_t bricks = 0;
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        const nook_voxelize_desc desc = desc_of(after, threads);
        assert_int_equal(nook_voxelize_again(&is, &desc, &older, &again, &bricks), NOOK_OK);
        test_assert_same_surfels(&again, &whole);
        assert_memory_equal(&again.info, &whole.info, sizeof whole.info);
        nook_volume_free(&again);
    }
    nook_volume_free(&old);
    nook_volume_free(&whole);
    return bricks;
}

static void test_nothing_changed_makes_nothing(void **state)
{
    (void)state;
    hills *h = make_hills();
    assert_int_equal(rebake(h, h), 0);
    free(h);
}

/* Six triangles of 0.6 voxels around the vertex, here and 3 voxels higher: bricks are 4 voxels. */
static void test_a_moved_vertex_changes_the_bricks_around_it(void **state)
{
    (void)state;
    hills *before = make_hills(), *after = copy_of(before);
    static const uint32_t moved[] = { 30 * (CELLS + 1) + 20, 50 * (CELLS + 1) + 33, 5 * (CELLS + 1) };
    for (size_t i = 0; i < 3; i++) {
        after->points[moved[i]][2] += 3.0f;
        size_t bricks = rebake(before, after);
        assert_true(bricks >= 1 && bricks <= 12 * (i + 1));
    }
    free(before);
    free(after);
}

static void test_triangles_that_come_and_go_change_their_bricks(void **state)
{
    (void)state;
    hills *before = make_hills(), *after = copy_of(before);
    const size_t at = 3 * 1000;
    memmove(after->indices + at, after->indices + at + 6, (after->index_count - at - 6) * sizeof *after->indices);
    after->index_count -= 6;
    after->part.first_index -= 6;
    size_t gone = rebake(before, after), back = rebake(after, before);
    assert_true(gone >= 1 && gone <= 4);
    assert_int_equal(gone, back);
    free(before);
    free(after);
}

static size_t count_ended(const nook_volume *v)
{
    size_t count = 0;
    for (size_t i = 0; i < v->info.occupied; i++)
        count += (v->surfels[i].plane[1] != 0 && !nook_surfel_word_is_plane(v->surfels[i].plane[1])) ||
                 nook_surfel_unpack(v->surfels[i].plane[0]).side == NOOK_SIDE_WITHIN;
    return count;
}

/* The sheet's last column, which lay on voxels' faces, moved into the voxels: they are told where it ends. */
static void test_an_end_that_moves_within_its_voxels_is_made_anew(void **state)
{
    (void)state;
    hills *before = make_hills(), *after = copy_of(before);
    for (uint32_t row = 8; row < 24; row++)
        after->points[row * (CELLS + 1) + CELLS][0] -= 0.4f;
    nook_volume was = make(before), is = make(after);
    assert_true(count_ended(&is) >= count_ended(&was) + 8); /* 15 cells of 0.6 voxels */
    nook_volume_free(&was);
    nook_volume_free(&is);
    assert_in_range(rebake(before, after), 2, 24);
    assert_true(rebake(after, before) > 0);
    free(before);
    free(after);
}

/* The masked half takes up half of the square. */
static void test_another_texture_changes_what_it_lies_on(void **state)
{
    (void)state;
    hills *before = make_hills(), *after = copy_of(before);
    nook_volume v = make(before);
    size_t total = nook_brick_total(&v.info), slabs = (SIDE + 2 + 3) / 4;
    nook_volume_free(&v);
    after->texels[5] = 0;
    size_t bricks = rebake(before, after);
    assert_true(bricks >= slabs * slabs / 2 && bricks < total / 2);
    memcpy(after->texels, before->texels, sizeof after->texels);
    after->uvs[3][0] += 0.25f; /* on what is opaque */
    assert_int_equal(rebake(before, after), 0);
    after->uvs[50 * (CELLS + 1) + 33][0] += 0.25f; /* on the mask */
    assert_in_range(rebake(before, after), 1, 12);
    after->alphas.part_count = 0;
    assert_int_equal(rebake(before, after), bricks);
    free(before);
    free(after);
}

static void test_another_box_makes_all(void **state)
{
    (void)state;
    hills *before = make_hills(), *after = copy_of(before);
    nook_volume v = make(before);
    after->points[POINTS + 1][2] += 8.0f;
    assert_int_equal(rebake(before, after), nook_brick_total(&v.info));
    nook_volume_free(&v);
    free(before);
    free(after);
}

static void test_a_volume_of_something_else_is_refused(void **state)
{
    (void)state;
    hills *before = make_hills(), *other = copy_of(before);
    other->points[7][2] += 1.0f;
    nook_volume old = make(other), out = { .info = { .occupied = 77 } };
    const nook_triangles was = triangles_of(before);
    const nook_voxelize_before older = { &was, &before->alphas, &old };
    const nook_voxelize_desc desc = desc_of(before, 1);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_voxelize_again(&was, &desc, &older, &out, NULL), NOOK_E_ARG);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_int_equal(out.info.occupied, 77);
    nook_volume_free(&old);
    free(before);
    free(other);
}

/* Of all kinds, also those of which nothing stays, and all levels. */
static void test_triangles_that_are_left_out_are_counted_in_one_warning(void **state)
{
    (void)state;
    hills *h = make_hills();
    h->points[POINTS / 2][2] = NAN;
    const nook_triangles triangles = triangles_of(h);
    for (uint32_t i = 0; i < NOOK_VOLUME_KINDS + NOOK_VOXELIZE_LEVELS; i++) {
        nook_volume old, again;
        nook_log_capture log;
        nook_voxelize_desc desc = desc_of(h, 1);
        desc.kind = i < NOOK_VOLUME_KINDS ? (nook_volume_kind)i : NOOK_VOLUME_SURFEL;
        desc.level = i < NOOK_VOLUME_KINDS ? 0 : i - NOOK_VOLUME_KINDS;
        nook_log_capture_begin(&log);
        assert_int_equal(nook_voxelize(&triangles, &desc, &old), NOOK_OK);
        assert_int_equal(log.count, 1);
        const nook_voxelize_before older = { &triangles, &h->alphas, &old };
        assert_int_equal(nook_voxelize_again(&triangles, &desc, &older, &again, NULL), NOOK_OK);
        nook_log_capture_end();
        assert_int_equal(log.count, 2);
        nook_volume_free(&old);
        nook_volume_free(&again);
    }
    free(h);
}

/* ---- Through the cache ------------------------------------------------------------------------------------------- */

static nook_bake bake(const char *folder, const hills *h, const hills *before)
{
    nook_bake made;
    const nook_triangles triangles = triangles_of(h), was = triangles_of(before ? before : h);
    const nook_voxelize_desc desc = desc_of(h, 2);
    const nook_bake_before older = { &was, before ? &before->alphas : NULL };
    assert_int_equal(nook_bake_cached_again(folder, "hills", &triangles, &desc, before ? &older : NULL, &made),
                     NOOK_OK);
    return made;
}

static void test_the_cache_makes_an_edited_mesh_of_what_it_holds(void **state)
{
    (void)state;
    char folder[1024];
    nook_scratch_path(folder, sizeof folder, "again");
    hills *before = make_hills(), *after = copy_of(before);
    after->points[30 * (CELLS + 1) + 20][2] += 3.0f;
    nook_bake whole = bake(NULL, after, NULL), unknown = bake(folder, after, before);
    assert_int_equal(unknown.bricks, 0); /* there was nothing to make it of */
    hills *later = copy_of(after);
    later->points[60 * (CELLS + 1) + 9][2] -= 2.0f;
    nook_bake again = bake(folder, later, after), there = bake(folder, later, after), all = bake(NULL, later, NULL);
    assert_true(again.bricks >= 1 && again.bricks <= 12 && !again.cache_hit);
    assert_true(there.cache_hit && there.bricks == 0);
    assert_true(again.size == all.size && whole.size == unknown.size);
    assert_memory_equal(again.bytes, all.bytes, all.size);
    assert_memory_equal(unknown.bytes, whole.bytes, whole.size);
    nook_bake *made[] = { &whole, &unknown, &again, &there, &all };
    for (size_t i = 0; i < 5; i++)
        nook_bake_free(made[i]);
    free(before);
    free(after);
    free(later);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

/* Three floors of 128 x 128 voxels in one slab: twice as many bins as fit into the least memory there is. */
static void test_memory_changes_no_bit(void **state)
{
    (void)state;
    enum { WIDE = 128, BRICK_BINS = 64 * 384 };
    float points[12][3];
    uint32_t indices[18];
    for (uint32_t i = 0; i < 12; i++) {
        points[i][0] = i & 1 ? WIDE : 0.0f, points[i][1] = i & 2 ? WIDE : 0.0f;
        points[i][2] = 1.5f * (float)(i / 4) + (i & 1 ? 0.0f : 0.013f * (float)(i / 4));
    }
    for (uint32_t i = 0; i < 18; i++)
        indices[i] = i / 6 * 4 + (const uint32_t[]){ 0, 1, 2, 2, 1, 3 }[i % 6];
    const nook_triangles triangles = { points[0], 0, 12, indices, 18 };
    nook_voxelize_desc desc = { .resolution = WIDE, .threads = 1, .kind = NOOK_VOLUME_SURFEL };
    nook_volume much, little;
    assert_int_equal(nook_voxelize(&triangles, &desc, &much), NOOK_OK);
    assert_true(much.info.depth <= 6 && much.info.occupied > BRICK_BINS);
    desc.memory = 1;
    assert_int_equal(nook_voxelize(&triangles, &desc, &little), NOOK_OK);
    test_assert_same_surfels(&much, &little);
    assert_true(much.info.content_hash == little.info.content_hash);
    nook_volume_free(&much);
    nook_volume_free(&little);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_changed_makes_nothing),
        cmocka_unit_test(test_a_moved_vertex_changes_the_bricks_around_it),
        cmocka_unit_test(test_triangles_that_come_and_go_change_their_bricks),
        cmocka_unit_test(test_an_end_that_moves_within_its_voxels_is_made_anew),
        cmocka_unit_test(test_another_texture_changes_what_it_lies_on),
        cmocka_unit_test(test_another_box_makes_all),
        cmocka_unit_test(test_a_volume_of_something_else_is_refused),
        cmocka_unit_test(test_triangles_that_are_left_out_are_counted_in_one_warning),
        cmocka_unit_test(test_the_cache_makes_an_edited_mesh_of_what_it_holds),
        cmocka_unit_test(test_memory_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
