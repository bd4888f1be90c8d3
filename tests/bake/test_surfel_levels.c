/* Levels of a volume of surfels from one pass: the same bits however they are asked for, and as near to the surface as bakes of their own. */
#include "modules/bake/brick_grid.h"
#include "modules/bake/cache.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/wavy_ball.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { ALL = (1 << NOOK_VOXELIZE_LEVELS) - 1 };

static nook_voxelize_desc desc_of(const test_wavy_ball *b, uint32_t resolution)
{
    return (
        nook_voxelize_desc){ .resolution = resolution, .threads = 1, .kind = NOOK_VOLUME_SURFEL, .alphas = &b->alphas };
}

static void make_levels(const test_wavy_ball *b, const nook_voxelize_desc *desc, nook_volume *out)
{
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    memset(out, 0, NOOK_VOXELIZE_LEVELS * sizeof *out);
    assert_int_equal(nook_voxelize_levels(&triangles, desc, ALL, out), NOOK_OK);
}

static void free_levels(nook_volume *volumes)
{
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
        nook_volume_free(&volumes[level]);
}

static void assert_same_levels(const nook_volume *a, const nook_volume *b)
{
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        test_assert_same_surfels(&a[level], &b[level]);
        assert_memory_equal(&a[level].info, &b[level].info, sizeof a->info);
    }
}

/* ---- What a level is ---------------------------------------------------------------------------------------------- */

static void test_the_finest_level_is_the_volume_baked_alone(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    static const uint32_t resolutions[] = { 64, 37, 8, 1 };
    for (size_t i = 0; i < 4; i++) {
        nook_volume levels[NOOK_VOXELIZE_LEVELS], alone;
        const nook_triangles triangles = test_wavy_ball_triangles(b);
        const nook_voxelize_desc desc = desc_of(b, resolutions[i]);
        make_levels(b, &desc, levels);
        assert_int_equal(nook_voxelize(&triangles, &desc, &alone), NOOK_OK);
        test_assert_same_surfels(&levels[0], &alone);
        assert_memory_equal(&levels[0].info, &alone.info, sizeof alone.info);
        nook_volume_free(&alone);
        free_levels(levels);
    }
    free(b);
}

static void test_a_level_is_the_same_whichever_are_asked_for(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    nook_volume levels[NOOK_VOXELIZE_LEVELS], some[NOOK_VOXELIZE_LEVELS];
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    nook_voxelize_desc desc = desc_of(b, 60);
    make_levels(b, &desc, levels);
    for (uint32_t set = 1; set <= ALL; set++) {
        memset(some, 0, sizeof some);
        assert_int_equal(nook_voxelize_levels(&triangles, &desc, set, some), NOOK_OK);
        for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
            if (set >> level & 1)
                test_assert_same_surfels(&some[level], &levels[level]);
            else
                assert_null(some[level].bricks);
            nook_volume_free(&some[level]);
        }
    }
    for (desc.level = 0; desc.level < NOOK_VOXELIZE_LEVELS; desc.level++) {
        nook_volume alone;
        assert_int_equal(nook_voxelize(&triangles, &desc, &alone), NOOK_OK);
        test_assert_same_surfels(&alone, &levels[desc.level]);
        assert_memory_equal(&alone.info, &levels[desc.level].info, sizeof alone.info);
        assert_true(alone.info.content_hash == nook_voxelize_hash(&triangles, &desc));
        nook_volume_free(&alone);
    }
    free_levels(levels);
    free(b);
}

/* Voxels of a level are 2 x 2 x 2 of the level before, the first of both beginning at one point, also where sides are odd. */
static void test_grids_nest(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.0f);
    nook_volume levels[NOOK_VOXELIZE_LEVELS];
    const nook_voxelize_desc desc = desc_of(b, 37);
    make_levels(b, &desc, levels);
    for (uint32_t level = 1; level < NOOK_VOXELIZE_LEVELS; level++) {
        const nook_volume_info *fine = &levels[level - 1].info, *coarse = &levels[level].info;
        const uint32_t fine_sides[] = { fine->width, fine->height, fine->depth };
        const uint32_t coarse_sides[] = { coarse->width, coarse->height, coarse->depth };
        assert_true(coarse->voxel_size == 2.0 * fine->voxel_size);
        assert_true(coarse->content_hash != fine->content_hash);
        for (int axis = 0; axis < 3; axis++) {
            assert_int_equal(coarse_sides[axis] - 2, (fine_sides[axis] - 2 + 1) / 2);
            double first[2] = { fine->origin[axis] + fine->voxel_size, coarse->origin[axis] + coarse->voxel_size };
            assert_true(fabs(first[0] - first[1]) < 1e-12);
        }
    }
    assert_int_equal(levels[3].info.depth, 5 + 2);
    assert_int_equal(nook_voxelize_level_resolution(37, 3), 5);
    free_levels(levels);
    free(b);
}

/* ---- What it must not depend on ----------------------------------------------------------------------------------- */

static void test_threads_and_memory_change_no_bit_of_any_level(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    nook_volume levels[NOOK_VOXELIZE_LEVELS], others[NOOK_VOXELIZE_LEVELS];
    nook_voxelize_desc desc = desc_of(b, 120);
    make_levels(b, &desc, levels);
    static const struct {
        uint32_t threads;
        size_t memory;
    } ways[] = { { 2, 0 }, { 7, 0 }, { 40, 0 }, { 1, 1 }, { 3, 200000 } }; /* bytes: for some 1500 bins, of 60,000 */
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        desc.threads = ways[i].threads;
        desc.memory = ways[i].memory;
        make_levels(b, &desc, others);
        assert_same_levels(levels, others);
        free_levels(others);
    }
    free_levels(levels);
    free(b);
}

static void test_the_order_of_triangles_changes_no_bit_of_any_level(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    nook_volume levels[NOOK_VOXELIZE_LEVELS], others[NOOK_VOXELIZE_LEVELS];
    b->alphas.part_count = 0;
    const nook_voxelize_desc desc = desc_of(b, 50);
    make_levels(b, &desc, levels);
    for (size_t low = 0, high = WAVY_INDICES - 3; low < high; low += 3, high -= 3) {
        uint32_t kept[3];
        memcpy(kept, b->indices + low, sizeof kept);
        memcpy(b->indices + low, b->indices + high, sizeof kept);
        b->indices[high] = kept[1], b->indices[high + 1] = kept[2], b->indices[high + 2] = kept[0];
    }
    make_levels(b, &desc, others);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
        test_assert_same_surfels(&levels[level], &others[level]);
    free_levels(levels);
    free_levels(others);
    free(b);
}

/* ---- How near it is ----------------------------------------------------------------------------------------------- */

/* Root mean square of the heights of the ball's true surface over the planes, in voxels; the middle of each voxel's part of it. */
static double error_of(const nook_volume *v)
{
    double squares = 0.0;
    size_t count = 0;
    const double axes[3] = { 0.8, 0.7, 1.0 };
    for (uint32_t z = 0; z < v->info.depth; z++)
        for (uint32_t y = 0; y < v->info.height; y++)
            for (uint32_t x = 0; x < v->info.width; x++) {
                const nook_surfel *surfel = test_surfel_at(v, x, y, z);
                const uint32_t at[3] = { x, y, z };
                double point[3], metres[3], length = 0.0;
                if (!surfel ||
                    nook_surfel_word_is_plane(surfel->plane[1])) /* where two planes are, which is meant is not known */
                    continue;
                const nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[0]);
                for (int i = 0; i < 3; i++) {
                    metres[i] = v->info.origin[i] + (at[i] + 0.5) * v->info.voxel_size;
                    length += metres[i] * metres[i] / axes[i] / axes[i];
                }
                for (int i = 0; i < 3; i++)
                    metres[i] /= sqrt(length);
                test_to_voxels(v, metres, point);
                double height = test_height_over(&plane, at, point);
                squares += height * height;
                count++;
            }
    assert_true(count > 100);
    return sqrt(squares / (double)count);
}

static void test_a_level_is_as_near_to_the_surface_as_a_bake_of_its_own(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.0f);
    b->alphas.part_count = 0;
    nook_volume levels[NOOK_VOXELIZE_LEVELS];
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    nook_voxelize_desc desc = desc_of(b, 128);
    make_levels(b, &desc, levels);
    for (uint32_t level = 1; level < NOOK_VOXELIZE_LEVELS; level++) {
        nook_volume alone;
        desc.resolution = 128 >> level;
        assert_int_equal(nook_voxelize(&triangles, &desc, &alone), NOOK_OK);
        double merged = error_of(&levels[level]), own = error_of(&alone);
        print_message("level %u: %.5f voxels off, alone %.5f; %u surfels, alone %u\n", level, merged, own,
                      (unsigned)levels[level].info.occupied, (unsigned)alone.info.occupied);
        assert_true(merged < 1.1 * own + 0.002);
        assert_true(fabs((double)levels[level].info.occupied / (double)alone.info.occupied - 1.0) < 0.05);
        nook_volume_free(&alone);
    }
    free_levels(levels);
    free(b);
}

/* A tilted plane is one plane of full coverage in every level, where it is. */
static void test_a_tilted_plane_stays_one_in_all_levels(void **state)
{
    (void)state;
    const float corner[] = { -10.0f, -10.0f, 20.0f }, u[] = { 90.0f, 0.0f, 10.0f }, v[] = { 0.0f, 90.0f, 14.0f };
    test_sheet sheet = test_make_sheet(64.0f, corner, u, v);
    for (int i = 0; i < 4; i++) /* as wide as the grid */
        for (int axis = 0; axis < 2; axis++) {
            float at = i >> axis & 1 ? 64.0f : 0.0f;
            sheet.points[i][axis] = at;
            sheet.points[i][2] = 20.0f + sheet.points[i][0] * 0.111f + sheet.points[i][1] * 0.155f;
        }
    const double length = sqrt(1.0 + 0.111 * 0.111 + 0.155 * 0.155);
    const nook_triangles triangles = test_sheet_triangles(&sheet);
    const nook_voxelize_desc desc = { .resolution = 64, .threads = 1, .kind = NOOK_VOLUME_SURFEL };
    nook_volume levels[NOOK_VOXELIZE_LEVELS];
    assert_int_equal(nook_voxelize_levels(&triangles, &desc, ALL, levels), NOOK_OK);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        const nook_volume *volume = &levels[level];
        size_t found = 0;
        for (uint32_t z = 0; z < volume->info.depth; z++)
            for (uint32_t y = 0; y < volume->info.height; y++)
                for (uint32_t x = 0; x < volume->info.width; x++) {
                    const nook_surfel *surfel = test_surfel_at(volume, x, y, z);
                    const uint32_t at[3] = { x, y, z };
                    if (!surfel)
                        continue;
                    found++;
                    assert_false(nook_surfel_word_is_plane(surfel->plane[1]));
                    const nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[0]);
                    if (fabs(plane.offset) < 0.5) { /* else a corner, which the grid's end may cut off */
                        assert_int_equal(surfel->plane[1], 0);
                        assert_true(plane.alpha >= NOOK_SURFEL_ALPHA_MAX - 1);
                    }
                    const double metres[3] = { volume->info.origin[0] + (x + 0.5) * volume->info.voxel_size,
                                               volume->info.origin[1] + (y + 0.5) * volume->info.voxel_size, 0.0 };
                    const double on_it[3] = { metres[0], metres[1], 20.0 + metres[0] * 0.111 + metres[1] * 0.155 };
                    double point[3];
                    test_to_voxels(volume, on_it, point);
                    assert_true(fabs(test_height_over(&plane, at, point)) < 0.012 / length + 0.0036 + 0.5 * 0.012);
                }
        assert_true(found >= (size_t)(64u >> level) * (64u >> level));
    }
    free_levels(levels);
}

/* ---- What is refused ---------------------------------------------------------------------------------------------- */

static void test_other_kinds_and_levels_are_refused(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.0f);
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    static const struct {
        uint32_t levels, level;
        nook_volume_kind kind;
    } cases[] = { { ALL, 0, NOOK_VOLUME_BINARY }, { ALL, 0, NOOK_VOLUME_DISTANCE },
                  { 0, 0, NOOK_VOLUME_SURFEL },   { 1 << NOOK_VOXELIZE_LEVELS, 0, NOOK_VOLUME_SURFEL },
                  { 0, 1, NOOK_VOLUME_BINARY },   { 0, NOOK_VOXELIZE_LEVELS, NOOK_VOLUME_SURFEL } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nook_volume out[NOOK_VOXELIZE_LEVELS] = { { .info = { .occupied = 77 } } };
        nook_voxelize_desc desc = desc_of(b, 16);
        desc.kind = cases[i].kind;
        desc.level = cases[i].level;
        nook_log_capture log;
        nook_log_capture_begin(&log);
        nook_result result = cases[i].level ? nook_voxelize(&triangles, &desc, out)
                                            : nook_voxelize_levels(&triangles, &desc, cases[i].levels, out);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_RANGE);
        assert_int_equal(log.count, 1);
        assert_int_equal(out[0].info.occupied, 77);
    }
    free(b);
}

/* ---- Through the cache -------------------------------------------------------------------------------------------- */

static void free_bakes(nook_bake *bakes)
{
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
        nook_bake_free(&bakes[level]);
}

static void test_the_cache_keeps_each_level_and_makes_what_it_lacks(void **state)
{
    (void)state;
    char folder[1024], path[1200];
    nook_scratch_path(folder, sizeof folder, "levels");
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    const nook_voxelize_desc desc = desc_of(b, 40);
    nook_bake bakes[NOOK_VOXELIZE_LEVELS], again[NOOK_VOXELIZE_LEVELS], alone;
    assert_int_equal(nook_bake_cached_levels(folder, "ball", &triangles, &desc, ALL, bakes), NOOK_OK);
    snprintf(path, sizeof path, "%s/%016llx.nkv", folder, (unsigned long long)bakes[2].info.content_hash);
    assert_int_equal(remove(path), 0);
    assert_int_equal(nook_bake_cached_levels(folder, "ball", &triangles, &desc, ALL, again), NOOK_OK);
    for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
        assert_true(!bakes[level].cache_hit && bakes[level].keep_error == 0);
        assert_int_equal(again[level].cache_hit, level != 2);
        assert_true(again[level].size == bakes[level].size);
        assert_memory_equal(again[level].bytes, bakes[level].bytes, bakes[level].size);
    }
    assert_int_equal(nook_bake_cached(folder, "ball", &triangles, &desc, &alone), NOOK_OK);
    assert_true(alone.cache_hit); /* the finest is the volume itself */
    nook_bake_free(&alone);
    nook_voxelize_desc own = desc;
    own.resolution = 20;
    assert_int_equal(nook_bake_cached(folder, "ball", &triangles, &own, &alone), NOOK_OK);
    assert_false(alone.cache_hit); /* a level is never taken for a bake of that resolution */
    nook_bake_free(&alone);
    free_bakes(bakes);
    free_bakes(again);
    free(b);
}

static void test_levels_of_other_kinds_are_bakes_of_their_own(void **state)
{
    (void)state;
    test_wavy_ball *b = test_make_wavy_ball(0.05f);
    const nook_triangles triangles = test_wavy_ball_triangles(b);
    nook_voxelize_desc desc = desc_of(b, 30);
    desc.kind = NOOK_VOLUME_BINARY;
    nook_bake bakes[NOOK_VOXELIZE_LEVELS] = { { .bytes = NULL } }, alone;
    assert_int_equal(nook_bake_cached_levels(NULL, "ball", &triangles, &desc, 5, bakes), NOOK_OK);
    assert_true(bakes[0].bytes && !bakes[1].bytes && bakes[2].bytes && !bakes[3].bytes);
    desc.resolution = 8;
    assert_int_equal(nook_bake_cached(NULL, "ball", &triangles, &desc, &alone), NOOK_OK);
    assert_true(alone.size == bakes[2].size);
    assert_memory_equal(alone.bytes, bakes[2].bytes, alone.size);
    nook_bake_free(&alone);
    free_bakes(bakes);
    nook_log_capture log;
    nook_log_capture_begin(&log);
    assert_int_equal(nook_bake_cached_levels(NULL, "ball", &triangles, &desc, 0, bakes), NOOK_E_RANGE);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_finest_level_is_the_volume_baked_alone),
        cmocka_unit_test(test_a_level_is_the_same_whichever_are_asked_for),
        cmocka_unit_test(test_grids_nest),
        cmocka_unit_test(test_threads_and_memory_change_no_bit_of_any_level),
        cmocka_unit_test(test_the_order_of_triangles_changes_no_bit_of_any_level),
        cmocka_unit_test(test_a_level_is_as_near_to_the_surface_as_a_bake_of_its_own),
        cmocka_unit_test(test_a_tilted_plane_stays_one_in_all_levels),
        cmocka_unit_test(test_other_kinds_and_levels_are_refused),
        cmocka_unit_test(test_the_cache_keeps_each_level_and_makes_what_it_lacks),
        cmocka_unit_test(test_levels_of_other_kinds_are_bakes_of_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
