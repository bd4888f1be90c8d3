/* Levels of a soup that was edited: each is that of a whole bake bit for bit, and only the bricks that its changed triangles touch are made. */
#include "modules/bake/brick_grid.h"
#include "modules/bake/cache.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/test_mask.h"
#include "tests/support/wavy_ball.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { LEVELS = NOOK_VOXELIZE_LEVELS, ALL = (1 << LEVELS) - 1, TRIANGLES = 300, BOX = 2 };

/* Triangles of all sizes anywhere in a box, the last half masked; behind them one without area that holds the box. */
typedef struct soup {
    float points[3 * TRIANGLES + BOX][3], uvs[3 * TRIANGLES + BOX][2];
    uint32_t indices[3 * (TRIANGLES + 1)];
    uint8_t texels[16];
    nook_alpha_part part;
    nook_alphas alphas;
} soup;

static const float sides[3] = { 37.0f, 64.0f, 29.0f };

static float random_unit(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

/* A triangle of which one in eight lies in a face of the box. */
static void place_triangle(soup *s, uint32_t triangle, uint32_t *state)
{
    float size = 0.01f + 0.6f * powf(random_unit(state), 4.0f), middle[3];
    const uint32_t face = (uint32_t)(8.0f * random_unit(state)), axis = (uint32_t)(3.0f * random_unit(state)) % 3;
    const float side = random_unit(state) < 0.5f ? 0.0f : 1.0f;
    for (int i = 0; i < 3; i++)
        middle[i] = random_unit(state);
    for (uint32_t corner = 0; corner < 3; corner++)
        for (uint32_t i = 0; i < 3; i++) {
            float at = middle[i] + size * (random_unit(state) - 0.5f);
            at = face == 0 && i == axis ? side : fminf(fmaxf(at, 0.0f), 1.0f);
            s->points[3 * triangle + corner][i] = at * sides[i];
        }
}

static soup *copy_of(const soup *from)
{
    soup *s = malloc(sizeof *s);
    assert_non_null(s);
    memcpy(s, from, sizeof *s);
    s->part.texels = s->texels;
    s->alphas = (nook_alphas){ &s->part, from->alphas.part_count, s->uvs[0] };
    return s;
}

static soup *make_soup(uint32_t *state)
{
    soup *s = calloc(1, sizeof *s), *made;
    assert_non_null(s);
    for (uint32_t t = 0; t < TRIANGLES; t++)
        place_triangle(s, t, state);
    for (uint32_t i = 0; i < 3 * TRIANGLES; i++) {
        s->indices[i] = i;
        s->uvs[i][0] = 3.0f * random_unit(state), s->uvs[i][1] = 3.0f * random_unit(state);
    }
    memcpy(s->points[3 * TRIANGLES + 1], sides, sizeof sides);
    for (uint32_t i = 0; i < 3; i++)
        s->indices[3 * TRIANGLES + i] = 3 * TRIANGLES + i % 2;
    for (int i = 0; i < 16; i++)
        s->texels[i] = i % 3 ? 255 : 0;
    s->part = test_mask(3 * TRIANGLES / 2, 3 * TRIANGLES / 2, NULL, 4); /* the texels are the copy's */
    s->alphas.part_count = 1;
    made = copy_of(s);
    free(s);
    return made;
}

static nook_triangles triangles_of(const soup *s)
{
    return (nook_triangles){ s->points[0], 0, 3 * TRIANGLES + BOX, s->indices, 3 * (TRIANGLES + 1) };
}

static nook_voxelize_desc desc_of(const nook_alphas *alphas, uint32_t resolution, uint32_t threads)
{
    return (nook_voxelize_desc){
        .resolution = resolution, .threads = threads, .kind = NOOK_VOLUME_SURFEL, .alphas = alphas
    };
}

static void free_levels(nook_volume *volumes)
{
    for (int level = 0; level < LEVELS; level++)
        nook_volume_free(&volumes[level]);
}

/* A soup before and after, at a resolution. */
typedef struct edit {
    nook_triangles was, is;
    const nook_alphas *alphas_was, *alphas_is;
    uint32_t resolution;
} edit;

static void make_levels(const nook_triangles *triangles, const nook_alphas *alphas, uint32_t resolution,
                        nook_volume *out)
{
    const nook_voxelize_desc desc = desc_of(alphas, resolution, 2);
    memset(out, 0, LEVELS * sizeof *out);
    assert_int_equal(nook_voxelize_levels(triangles, &desc, ALL, out), NOOK_OK);
}

/* Makes some levels of an edited soup of what they were, holds them against `whole`. @param out_bricks  of each level */
static void hold_again(const edit *e, uint32_t levels, uint32_t threads, size_t memory, const nook_volume *old,
                       const nook_volume *whole, size_t *out_bricks)
{
    const nook_voxelize_before older = { &e->was, e->alphas_was, old };
    nook_volume again[LEVELS] = { { .bricks = NULL } };
    nook_voxelize_desc desc = desc_of(e->alphas_is, e->resolution, threads);
    desc.memory = memory;
    memset(out_bricks, 0, LEVELS * sizeof *out_bricks);
    assert_int_equal(nook_voxelize_levels_again(&e->is, &desc, levels, &older, again, out_bricks), NOOK_OK);
    for (uint32_t level = 0; level < LEVELS; level++) {
        if (levels >> level & 1) {
            test_assert_same_surfels(&again[level], &whole[level]);
            assert_memory_equal(&again[level].info, &whole[level].info, sizeof whole->info);
        } else {
            assert_null(again[level].bricks);
            assert_int_equal(out_bricks[level], 0);
        }
    }
    free_levels(again);
}

/* All sets of levels, threads, little memory, and each level by itself. @param out_bricks  of each level, of all at once */
static void rebake(const edit *e, size_t *out_bricks)
{
    nook_volume old[LEVELS], whole[LEVELS], alone;
    size_t bricks[LEVELS];
    make_levels(&e->was, e->alphas_was, e->resolution, old);
    make_levels(&e->is, e->alphas_is, e->resolution, whole);
    hold_again(e, ALL, 1, 0, old, whole, out_bricks);
    for (uint32_t levels = 1; levels <= ALL; levels++) {
        hold_again(e, levels, 1 + levels % 3, levels & 4 ? 1 : 0, old, whole, bricks);
        for (uint32_t level = 0; level < LEVELS; level++)
            assert_int_equal(bricks[level], levels >> level & 1 ? out_bricks[level] : 0);
    }
    for (uint32_t level = 0; level < LEVELS; level++) {
        nook_voxelize_desc desc = desc_of(e->alphas_is, e->resolution, 1);
        const nook_voxelize_before older = { &e->was, e->alphas_was, &old[level] };
        desc.level = level;
        assert_int_equal(nook_voxelize_again(&e->is, &desc, &older, &alone, &bricks[level]), NOOK_OK);
        test_assert_same_surfels(&alone, &whole[level]);
        assert_memory_equal(&alone.info, &whole[level].info, sizeof alone.info);
        assert_int_equal(bricks[level], out_bricks[level]);
        nook_volume_free(&alone);
    }
    free_levels(old);
    free_levels(whole);
}

static void rebake_soup(const soup *before, const soup *after, uint32_t resolution, size_t *out_bricks)
{
    const edit e = { triangles_of(before), triangles_of(after), &before->alphas, &after->alphas, resolution };
    rebake(&e, out_bricks);
}

/* ---- The same bits ----------------------------------------------------------------------------------------------- */

static void test_levels_of_any_edited_soup_are_those_of_a_whole_bake(void **state)
{
    (void)state;
    static const uint32_t resolutions[] = { 64, 61, 37, 90, 13, 5, 1 };
    for (uint32_t i = 0; i < sizeof resolutions / sizeof *resolutions; i++) {
        uint32_t seed = 77 + i;
        soup *before = make_soup(&seed), *after = copy_of(before);
        size_t bricks[LEVELS];
        for (uint32_t edits = 1; edits <= 16; edits *= 4) {
            print_message("resolution %u, seed %u, %u triangles\n", resolutions[i], 77 + i, edits);
            for (uint32_t k = 0; k < edits; k++)
                place_triangle(after, (uint32_t)(TRIANGLES * random_unit(&seed)) % TRIANGLES, &seed);
            rebake_soup(before, after, resolutions[i], bricks);
            assert_true(bricks[0] >= 1 && bricks[LEVELS - 1] >= 1);
        }
        free(before);
        free(after);
    }
}

static void test_nothing_changed_makes_nothing_in_any_level(void **state)
{
    (void)state;
    uint32_t seed = 5;
    soup *s = make_soup(&seed);
    size_t bricks[LEVELS];
    rebake_soup(s, s, 50, bricks);
    for (uint32_t level = 0; level < LEVELS; level++)
        assert_int_equal(bricks[level], 0);
    free(s);
}

/* From triangles at one place of the list on all others move up. */
static void test_triangles_that_come_and_go_change_all_levels(void **state)
{
    (void)state;
    uint32_t seed = 6;
    soup *before = make_soup(&seed), *after = copy_of(before);
    size_t gone[LEVELS], back[LEVELS];
    const size_t at = 3 * 41, count = sizeof before->indices / sizeof *before->indices;
    memmove(after->indices + at, after->indices + at + 3, (count - at - 3) * sizeof *after->indices);
    after->part.first_index -= 3;
    edit e = { triangles_of(before), triangles_of(after), &before->alphas, &after->alphas, 45 };
    e.is.index_count -= 3;
    rebake(&e, gone);
    e = (edit){ e.is, e.was, e.alphas_is, e.alphas_was, 45 };
    rebake(&e, back);
    assert_memory_equal(gone, back, sizeof gone);
    assert_true(gone[0] >= 1 && gone[3] >= 1 && gone[3] <= gone[0]);
    free(before);
    free(after);
}

static void test_another_texture_changes_all_levels_of_what_it_lies_on(void **state)
{
    (void)state;
    uint32_t seed = 7;
    soup *before = make_soup(&seed), *after = copy_of(before);
    size_t bricks[LEVELS];
    after->texels[5] = 0;
    rebake_soup(before, after, 45, bricks);
    assert_true(bricks[0] > 20 && bricks[3] >= 1);
    free(before);
    free(after);
}

/* A closed mesh of which all surfels change places in their lists when some go. */
static void test_a_dent_in_a_ball_changes_no_bit_but_its_own(void **state)
{
    (void)state;
    test_wavy_ball *before = test_make_wavy_ball(0.05f), *after = test_make_wavy_ball(0.05f);
    for (uint32_t row = 10; row < 13; row++)
        for (uint32_t column = 30; column < 33; column++)
            for (uint32_t axis = 0; axis < 3; axis++)
                after->points[row * (WAVY_SIDES + 1) + column][axis] *= 0.9f;
    static const uint32_t resolutions[] = { 128, 99, 40 };
    for (uint32_t i = 0; i < 3; i++) {
        const edit e = { test_wavy_ball_triangles(before), test_wavy_ball_triangles(after), &before->alphas,
                         &after->alphas, resolutions[i] };
        nook_volume old[LEVELS];
        size_t bricks[LEVELS];
        make_levels(&e.was, e.alphas_was, e.resolution, old);
        rebake(&e, bricks);
        for (uint32_t level = 0; level < LEVELS; level++)
            assert_true(bricks[level] >= 1 && bricks[level] < nook_brick_total(&old[level].info));
        assert_true(16 * bricks[0] < nook_brick_total(&old[0].info));
        free_levels(old);
    }
    free(before);
    free(after);
}

/* ---- Which bricks are made --------------------------------------------------------------------------------------- */

/* How many bricks of a level hold the voxels from `first` to `last` of level 0, along one axis. */
static size_t bricks_along(uint32_t first, uint32_t last, uint32_t level)
{
    const uint32_t up = (1u << level) - 1;
    return ((last + up) >> level) / NOOK_BRICK_SIDE - ((first + up) >> level) / NOOK_BRICK_SIDE + 1;
}

/* In a box of 64 voxels of 1 m a point at x metres lies in voxel x + 1, behind the border. */
static void test_only_bricks_in_the_boxes_of_changed_triangles_are_made(void **state)
{
    (void)state;
    static const struct {
        float from[3], to[3];
        uint32_t first[3], last[3]; /* voxels */
    } moves[] = {
        { { 20.3f, 20.3f, 20.3f }, { 20.4f, 20.3f, 20.3f }, { 21, 21, 21 }, { 21, 21, 21 } },
        { { 0.2f, 63.5f, 30.5f }, { 30.2f, 63.5f, 34.5f }, { 1, 64, 31 }, { 31, 64, 35 } },
        { { 30.5f, 30.5f, 30.5f }, { 31.5f, 31.5f, 31.5f }, { 31, 31, 31 }, { 32, 32, 32 } },
    };
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        float before[5][3] = { { 0 }, { 0 }, { 0 }, { 0 }, { 64.0f, 64.0f, 64.0f } }, after[5][3];
        static const uint32_t indices[] = { 0, 1, 2, 3, 4, 3 };
        memcpy(after, before, sizeof after);
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++) {
                const float off = corner == axis ? 0.05f : 0.0f;
                before[corner][axis] = moves[i].from[axis] + off;
                after[corner][axis] = moves[i].to[axis] + off;
            }
        const edit e = { { before[0], 0, 5, indices, 6 }, { after[0], 0, 5, indices, 6 }, NULL, NULL, 64 };
        size_t bricks[LEVELS];
        rebake(&e, bricks);
        for (uint32_t level = 0; level < LEVELS; level++) {
            size_t most = 1;
            for (int axis = 0; axis < 3; axis++)
                most *= bricks_along(moves[i].first[axis], moves[i].last[axis], level);
            assert_int_equal(bricks[level], most == 1 ? 1 : 2); /* the boxes before and after are a brick each */
        }
    }
}

/* With 37 and with 38 layers along y there are 19 of level 1 in the same place. The sheet at 37 m was in the last layer, and is in the one before. */
static void test_a_box_that_only_the_finest_grid_shows_makes_all(void **state)
{
    (void)state;
    float points[6][3] = { { 0.0f, 37.0f, 0.0f },
                           { 64.0f, 37.0f, 0.0f },
                           { 0.0f, 37.0f, 20.0f },
                           { 0.0f, 0.0f, 0.0f },
                           { 64.0f, 37.0f, 20.0f } },
          wider[6][3];
    static const uint32_t indices[] = { 0, 1, 2, 3, 4, 3 };
    memcpy(wider, points, sizeof wider);
    wider[4][1] = 38.0f;
    const edit e = { { points[0], 0, 5, indices, 6 }, { wider[0], 0, 5, indices, 6 }, NULL, NULL, 64 };
    nook_volume old[LEVELS], is[LEVELS];
    size_t bricks[LEVELS];
    make_levels(&e.was, NULL, e.resolution, old);
    make_levels(&e.is, NULL, e.resolution, is);
    assert_int_equal(old[0].info.height + 1, is[0].info.height);
    assert_int_equal(old[1].info.height, is[1].info.height);
    assert_memory_equal(old[1].info.origin, is[1].info.origin, sizeof is->info.origin);
    rebake(&e, bricks);
    for (uint32_t level = 0; level < LEVELS; level++)
        assert_int_equal(bricks[level], nook_brick_total(&old[level].info));
    free_levels(old);
    free_levels(is);
}

/* ---- What is refused ---------------------------------------------------------------------------------------------- */

static nook_result try_again(const edit *e, uint32_t levels, nook_volume_kind kind, const nook_volume *old)
{
    const nook_voxelize_before older = { &e->was, e->alphas_was, old };
    nook_volume out[LEVELS] = { { .info = { .occupied = 77 } } };
    size_t bricks[LEVELS] = { 88 };
    nook_voxelize_desc desc = desc_of(e->alphas_is, e->resolution, 1);
    nook_log_capture log;
    desc.kind = kind;
    nook_log_capture_begin(&log);
    nook_result result = nook_voxelize_levels_again(&e->is, &desc, levels, &older, out, bricks);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_true(out[0].info.occupied == 77 && bricks[0] == 88);
    return result;
}

static void test_levels_of_something_else_are_refused(void **state)
{
    (void)state;
    uint32_t seed = 8;
    soup *before = make_soup(&seed), *other = make_soup(&seed);
    edit e = { triangles_of(before), triangles_of(before), &before->alphas, &before->alphas, 30 };
    nook_volume old[LEVELS], swapped[LEVELS];
    make_levels(&e.was, e.alphas_was, e.resolution, old);
    memcpy(swapped, old, sizeof swapped);
    swapped[2] = old[3]; /* borrowed */
    assert_int_equal(try_again(&e, ALL, NOOK_VOLUME_SURFEL, swapped), NOOK_E_ARG);
    assert_int_equal(try_again(&e, 0, NOOK_VOLUME_SURFEL, old), NOOK_E_RANGE);
    assert_int_equal(try_again(&e, 1 << LEVELS, NOOK_VOLUME_SURFEL, old), NOOK_E_RANGE);
    assert_int_equal(try_again(&e, 1, NOOK_VOLUME_BINARY, old), NOOK_E_RANGE);
    e.was = triangles_of(other);
    assert_int_equal(try_again(&e, ALL, NOOK_VOLUME_SURFEL, old), NOOK_E_ARG);
    assert_int_equal(try_again(&e, 8, NOOK_VOLUME_SURFEL, old), NOOK_E_ARG);
    free_levels(old);
    free(before);
    free(other);
}

/* ---- Through the cache -------------------------------------------------------------------------------------------- */

static void bake(const char *folder, const soup *s, const soup *before, uint32_t levels, nook_bake *out)
{
    const nook_triangles triangles = triangles_of(s), was = triangles_of(before ? before : s);
    const nook_voxelize_desc desc = desc_of(&s->alphas, 40, 2);
    const nook_bake_before older = { &was, before ? &before->alphas : NULL };
    memset(out, 0, LEVELS * sizeof *out);
    assert_int_equal(
        nook_bake_cached_levels_again(folder, "soup", &triangles, &desc, levels, before ? &older : NULL, out), NOOK_OK);
}

static void test_the_cache_makes_levels_of_those_that_it_holds_and_the_others_whole(void **state)
{
    (void)state;
    char folder[1024];
    nook_scratch_path(folder, sizeof folder, "levels_again");
    uint32_t seed = 9;
    soup *before = make_soup(&seed), *after = copy_of(before), *later;
    place_triangle(after, 17, &seed);
    later = copy_of(after);
    place_triangle(later, 200, &seed);
    nook_bake first[LEVELS], unknown[LEVELS], some[LEVELS], whole[LEVELS], there[LEVELS], all[LEVELS];
    bake(folder, before, after, 5, first); /* what is not there cannot help */
    bake(folder, after, before, ALL, unknown);
    bake(folder, later, after, 11, some);
    bake(folder, later, after, ALL, there);
    bake(NULL, after, before, ALL, whole);
    bake(NULL, later, NULL, ALL, all);
    for (uint32_t level = 0; level < LEVELS; level++) {
        assert_int_equal(first[level].bricks, 0);
        assert_int_equal(unknown[level].bricks > 0, level == 0 || level == 2);
        assert_int_equal(some[level].bricks > 0, level != 2);
        assert_int_equal(whole[level].bricks, 0);
        assert_int_equal(there[level].cache_hit, level != 2);
        assert_int_equal(there[level].bricks > 0, level == 2);
        assert_true(unknown[level].size == whole[level].size && there[level].size == all[level].size);
        assert_memory_equal(unknown[level].bytes, whole[level].bytes, whole[level].size);
        assert_memory_equal(there[level].bytes, all[level].bytes, all[level].size);
        nook_bake *made[] = { first, unknown, some, whole, there, all };
        for (size_t i = 0; i < 6; i++)
            nook_bake_free(&made[i][level]);
    }
    free(before);
    free(after);
    free(later);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_levels_of_any_edited_soup_are_those_of_a_whole_bake),
        cmocka_unit_test(test_nothing_changed_makes_nothing_in_any_level),
        cmocka_unit_test(test_triangles_that_come_and_go_change_all_levels),
        cmocka_unit_test(test_another_texture_changes_all_levels_of_what_it_lies_on),
        cmocka_unit_test(test_a_dent_in_a_ball_changes_no_bit_but_its_own),
        cmocka_unit_test(test_only_bricks_in_the_boxes_of_changed_triangles_are_made),
        cmocka_unit_test(test_a_box_that_only_the_finest_grid_shows_makes_all),
        cmocka_unit_test(test_levels_of_something_else_are_refused),
        cmocka_unit_test(test_the_cache_makes_levels_of_those_that_it_holds_and_the_others_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
