/* Volumes that come and go piece by piece, and the room that they share. */
#include "modules/ao/brick_pool_internal.h"
#include "modules/ao/residency.h"
#include "modules/ao/volume_atlas_internal.h"
#include "modules/ao_volume/corners.h"
#include "modules/bake/brick_grid.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* ---- The tree of boxes ------------------------------------------------------------------------------------------------ */

enum { BOXES = 40, ROUNDS = 4000 };

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static uint64_t free_voxels(const box_tree *tree)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < tree->count; i++)
        sum += tree->nodes[i].state == BOX_FREE ? box_voxels(tree->nodes[i].box.size) : 0;
    return sum;
}

static uint64_t largest_free(const box_tree *tree)
{
    uint64_t most = 0;
    for (uint32_t i = 0; i < tree->count; i++)
        if (tree->nodes[i].state == BOX_FREE && box_voxels(tree->nodes[i].box.size) > most)
            most = box_voxels(tree->nodes[i].box.size);
    return most;
}

static void test_boxes_that_are_given_back_are_joined_whatever_came_between(void **state)
{
    (void)state;
    const uint32_t whole[3] = { 96, 80, 64 };
    box_tree tree = { .count = 0 };
    uint32_t places[BOXES], seed = 7, held = 0;
    uint64_t taken[BOXES], sum = 0;
    assert_true(box_tree_reset(&tree, whole));
    assert_true(box_tree_reserve(&tree, 4 * BOXES));
    uint32_t capacity = tree.capacity;
    for (int round = 0; round < ROUNDS; round++) {
        uint32_t i = next_random(&seed) % BOXES;
        const uint32_t size[3] = { 4 + next_random(&seed) % 24, 4 + next_random(&seed) % 24,
                                   4 + next_random(&seed) % 24 };
        atlas_box box;
        if (i < held) {
            sum -= taken[i];
            box_tree_give(&tree, places[i]);
            places[i] = places[--held];
            taken[i] = taken[held];
        } else if (held < BOXES && box_tree_take(&tree, size, &box, &places[held])) {
            assert_memory_equal(box.size, size, sizeof size);
            taken[held++] = box_voxels(size);
            sum += box_voxels(size);
        }
        assert_true(free_voxels(&tree) + sum == box_voxels(whole)); /* none is lost */
    }
    assert_int_equal(tree.capacity, capacity); /* nor does the tree grow for ever */
    while (held > 0)
        box_tree_give(&tree, places[--held]);
    assert_true(largest_free(&tree) == box_voxels(whole));
    box_tree_release(&tree);
}

static void test_a_tree_that_grew_is_one_box_when_nothing_is_left_in_it(void **state)
{
    (void)state;
    box_tree tree = { .count = 0 };
    atlas_box box;
    uint32_t places[12];
    for (uint32_t i = 0; i < 12; i++) {
        const uint32_t size[3] = { 5 + i, 9, 20 - i };
        if (!box_tree_take(&tree, size, &box, &places[i])) {
            assert_true(box_tree_grow(&tree, size, 4096));
            assert_true(box_tree_take(&tree, size, &box, &places[i]));
        }
    }
    for (uint32_t i = 0; i < 12; i++)
        box_tree_give(&tree, places[i * 5 % 12]);
    assert_true(largest_free(&tree) == box_voxels(tree.size));
    box_tree_release(&tree);
}

/* ---- Voxels ----------------------------------------------------------------------------------------------------------- */

static nook_volume voxels_of(uint32_t width, uint32_t height, uint32_t depth, uint8_t value)
{
    nook_volume volume = { .info = { .width = width, .height = height, .depth = depth, .voxel_size = 1.0 } };
    size_t count = (size_t)width * height * depth;
    volume.voxels = malloc(count);
    assert_non_null(volume.voxels);
    for (size_t i = 0; i < count; i++)
        volume.voxels[i] = (uint8_t)(value + i % 7);
    return volume;
}

static void expect_voxels(volume_atlas *atlas, uint32_t id, const nook_volume *volume)
{
    const atlas_entry *entry = volume_atlas_find(atlas, id);
    assert_non_null(entry);
    size_t bytes = (size_t)volume_atlas_bytes(atlas);
    uint8_t *texels = malloc(bytes);
    assert_non_null(texels);
    nook_texture_read(atlas->gpu, atlas->texture, GL_RED, GL_UNSIGNED_BYTE, texels, bytes);
    const uint32_t *at = entry->box.origin, *size = entry->box.size;
    for (size_t v = 0; v < (size_t)box_voxels(size); v++) {
        size_t x = at[0] + v % size[0], y = at[1] + v / size[0] % size[1], z = at[2] + v / size[0] / size[1];
        assert_int_equal(texels[(z * atlas->texture.height + y) * atlas->texture.width + x], volume->voxels[v]);
    }
    free(texels);
}

static void write_whole(volume_atlas *atlas, uint32_t id, const nook_volume *volume)
{
    bool whole = false;
    assert_true(volume_atlas_place(atlas, id, &volume->info));
    assert_int_equal(volume_atlas_grow(atlas), NOOK_OK);
    while (!whole) {
        assert_true(volume_atlas_write(atlas, id, volume->voxels, 600, &whole) <= 600);
        assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
    }
}

static void test_a_volume_is_seen_when_its_last_slice_is_there_and_the_old_one_until_then(void **state)
{
    volume_atlas atlas;
    volume_atlas_init(&atlas, test_gpu_of(state));
    nook_volume coarse = voxels_of(6, 7, 8, 10), fine = voxels_of(12, 14, 16, 90);
    bool whole;
    write_whole(&atlas, 5, &coarse);
    expect_voxels(&atlas, 5, &coarse);
    assert_true(volume_atlas_place(&atlas, 5, &fine.info));
    assert_int_equal(volume_atlas_grow(&atlas), NOOK_OK);
    assert_int_equal(volume_atlas_write(&atlas, 5, fine.voxels, 100, &whole), 0); /* no slice is as small */
    assert_int_equal(volume_atlas_write(&atlas, 5, fine.voxels, 15 * 12 * 14 + 5, &whole), 15 * 12 * 14);
    assert_false(whole);
    expect_voxels(&atlas, 5, &coarse);
    assert_int_equal(volume_atlas_write(&atlas, 5, fine.voxels, 1000, &whole), 12 * 14);
    assert_true(whole);
    expect_voxels(&atlas, 5, &fine);
    volume_atlas_remove(&atlas, 5);
    assert_true(volume_atlas_bytes(&atlas) == 0); /* the old one's place is given back, too */
    nook_volume_free(&coarse);
    nook_volume_free(&fine);
    volume_atlas_release(&atlas);
}

static void test_a_room_does_not_grow_and_another_one_keeps_what_fits(void **state)
{
    const uint32_t large[3] = { 32, 32, 32 }, small[3] = { 20, 20, 20 }, tiny[3] = { 8, 8, 8 }, none[3] = { 0, 0, 0 };
    volume_atlas atlas;
    nook_log_capture line;
    volume_atlas_init(&atlas, test_gpu_of(state));
    nook_volume pinned = voxels_of(10, 10, 10, 3), copy = voxels_of(10, 10, 10, 3), big = voxels_of(18, 18, 18, 50),
                other = voxels_of(9, 8, 7, 120);
    assert_int_equal(volume_atlas_set_room(&atlas, large), NOOK_OK);
    assert_true(volume_atlas_bytes(&atlas) == 32 * 32 * 32);
    assert_int_equal(volume_atlas_add(&atlas, 1, &pinned), NOOK_OK);
    assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK);
    write_whole(&atlas, 2, &big);
    write_whole(&atlas, 3, &other);
    assert_false(volume_atlas_place(&atlas, 4, &big.info));
    assert_true(volume_atlas_place(&atlas, 4, &other.info)); /* comes, and is given up by the next room */
    assert_int_equal(volume_atlas_set_room(&atlas, small), NOOK_OK);
    assert_true(volume_atlas_bytes(&atlas) == 20 * 20 * 20);
    assert_null(volume_atlas_find(&atlas, 2));
    assert_false(volume_atlas_is_placed(&atlas, 4));
    expect_voxels(&atlas, 1, &copy);
    expect_voxels(&atlas, 3, &other);
    nook_log_capture_begin(&line);
    assert_int_equal(volume_atlas_set_room(&atlas, tiny), NOOK_E_RANGE); /* does not hold what was added whole */
    nook_log_capture_end();
    assert_int_equal(line.count, 1);
    expect_voxels(&atlas, 1, &copy);
    assert_int_equal(volume_atlas_set_room(&atlas, none), NOOK_OK);
    write_whole(&atlas, 2, &big); /* grows again */
    expect_voxels(&atlas, 2, &big);
    expect_voxels(&atlas, 3, &other);
    volume_atlas_remove(&atlas, 1);
    volume_atlas_remove(&atlas, 2);
    volume_atlas_remove(&atlas, 3);
    assert_true(volume_atlas_bytes(&atlas) == 0);
    nook_volume_free(&copy);
    nook_volume_free(&big);
    nook_volume_free(&other);
    volume_atlas_release(&atlas);
}

static void fit_corners(volume_corners *corners, volume_atlas *atlas)
{
    const nook_ao_pass pass = { .gpu = atlas->gpu,
                                .volume_atlas = atlas->texture,
                                .volume_atlas_version = atlas->version,
                                .volume_atlas_change_count = atlas->changes.count,
                                .volume_atlas_changes = atlas->changes.boxes };
    assert_int_equal(volume_corners_fit(corners, &pass), NOOK_OK);
}

/* Of the boxes of volumes, and of the cells before them, in whatever room: nobody reads others. */
static void expect_the_same_corners(volume_atlas *atlas, const volume_corners *parts)
{
    volume_corners whole = { 0 };
    const uint32_t width = atlas->texture.width, height = atlas->texture.height;
    const nook_ao_pass pass = { .gpu = atlas->gpu,
                                .volume_atlas = atlas->texture,
                                .volume_atlas_version = atlas->version,
                                .volume_atlas_change_count = NOOK_AO_CHANGED_ALL };
    assert_int_equal(volume_corners_fit(&whole, &pass), NOOK_OK);
    uint8_t *a = malloc(parts->buffer.size), *b = malloc(whole.buffer.size);
    assert_true(a && b && parts->buffer.size == whole.buffer.size);
    nook_buffer_read(atlas->gpu, parts->buffer, 0, a, parts->buffer.size);
    nook_buffer_read(atlas->gpu, whole.buffer, 0, b, whole.buffer.size);
    for (uint32_t i = 0; i < atlas->seen.count; i++) {
        const atlas_box *box = &atlas->seen.items[i].box;
        for (uint32_t z = box->origin[2] - (box->origin[2] > 0); z < box->origin[2] + box->size[2]; z++)
            for (uint32_t y = box->origin[1] - (box->origin[1] > 0); y < box->origin[1] + box->size[1]; y++)
                for (uint32_t x = box->origin[0] - (box->origin[0] > 0); x < box->origin[0] + box->size[0]; x++)
                    if (a[(z * height + y) * width + x] != b[(z * height + y) * width + x])
                        fail_msg("volume %u, cell (%u, %u, %u)", atlas->seen.items[i].id, x, y, z);
    }
    free(a);
    free(b);
    volume_corners_release(&whole, atlas->gpu);
}

static void test_corners_made_part_by_part_are_those_made_at_once(void **state)
{
    const uint32_t sides[3] = { 40, 24, 64 };
    nook_gpu *gpu = test_gpu_of(state);
    volume_atlas atlas;
    volume_corners parts = { 0 };
    volume_atlas_init(&atlas, gpu);
    assert_int_equal(volume_atlas_set_room(&atlas, sides), NOOK_OK);
    nook_volume nothing = voxels_of(sides[0], sides[1], sides[2], 0); /* what is undefined may not differ by chance */
    nook_texture_write(gpu, atlas.texture, GL_RED, GL_UNSIGNED_BYTE, nothing.voxels, 40 * 24 * 64);
    assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK);
    fit_corners(&parts, &atlas);
    for (uint32_t i = 1; i <= 4; i++) {
        nook_volume volume = voxels_of(9 + i, 11, 13 + i, (uint8_t)(124 + i)); /* full and empty ones */
        bool done = false;
        assert_true(volume_atlas_place(&atlas, i, &volume.info));
        for (uint32_t frame = 0; !done; frame++) {
            volume_atlas_write(&atlas, i, volume.voxels, 700, &done);
            assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK);
            assert_int_equal(atlas.changes.count, 1);
            if (i != 3 || frame != 1) /* a view that is not drawn in one frame */
                fit_corners(&parts, &atlas);
        }
        nook_volume_free(&volume);
    }
    expect_the_same_corners(&atlas, &parts);
    nook_volume_free(&nothing);
    volume_corners_release(&parts, gpu);
    volume_atlas_release(&atlas);
}

/* Puts a volume in, whole, with corners after each part. */
static void bring(volume_atlas *atlas, volume_corners *corners, uint32_t id, uint32_t side)
{
    nook_volume volume = voxels_of(side, side + 1, side + 2, (uint8_t)(120 + id));
    bool done = false;
    assert_true(volume_atlas_place(atlas, id, &volume.info));
    while (!done) {
        assert_int_equal(volume_atlas_grow(atlas), NOOK_OK);
        volume_atlas_write(atlas, id, volume.voxels, 900, &done);
        assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
        fit_corners(corners, atlas);
    }
    nook_volume_free(&volume);
}

static void test_corners_of_another_texture_are_made_of_what_it_holds_alone(void **state)
{
    const uint32_t sides[3] = { 64, 48, 64 }, fewer[3] = { 48, 64, 64 }; /* as many voxels */
    nook_gpu *gpu = test_gpu_of(state);
    volume_atlas atlas;
    volume_corners corners = { 0 };
    volume_atlas_init(&atlas, gpu);
    for (uint32_t i = 1; i <= 4; i++) { /* each makes it grow */
        bring(&atlas, &corners, i, 9 + i);
        expect_the_same_corners(&atlas, &corners);
    }
    nook_volume half = voxels_of(12, 12, 12, 255);
    bool done;
    assert_true(volume_atlas_place(&atlas, 5, &half.info));
    assert_int_equal(volume_atlas_grow(&atlas), NOOK_OK);
    assert_true(volume_atlas_write(&atlas, 5, half.voxels, 600, &done) > 0 && !done);
    bring(&atlas, &corners, 6, 20); /* grows, while a part of another has been written */
    volume_atlas_write(&atlas, 5, half.voxels, SIZE_MAX, &done);
    assert_true(done);
    assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK);
    fit_corners(&corners, &atlas);
    expect_the_same_corners(&atlas, &corners);
    for (int turn = 0; turn < 2; turn++) {
        uint64_t cells = 0;
        assert_int_equal(volume_atlas_set_room(&atlas, turn ? fewer : sides), NOOK_OK);
        assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK);
        assert_int_equal(atlas.changes.count, 6);
        for (uint32_t i = 0; i < atlas.changes.count; i++)
            cells += box_voxels(atlas.changes.boxes[i].size);
        assert_true(cells < 64 * 48 * 64 / 4);
        fit_corners(&corners, &atlas);
        expect_the_same_corners(&atlas, &corners);
    }
    nook_volume_free(&half);
    volume_corners_release(&corners, gpu);
    volume_atlas_release(&atlas);
}

/* ---- Surfels ---------------------------------------------------------------------------------------------------------- */

/* A volume of so many bricks, each with surfels of its own numbers. */
static nook_volume bricks_of(uint32_t bricks, uint32_t seed)
{
    nook_volume volume = { .info = { .kind = NOOK_VOLUME_SURFEL,
                                     .width = 4 * bricks,
                                     .height = 4,
                                     .depth = 4,
                                     .voxel_size = 1.0,
                                     .occupied = 2 * (uint64_t)bricks } };
    volume.bricks = calloc(bricks, sizeof *volume.bricks);
    volume.surfels = calloc(2 * (size_t)bricks, sizeof *volume.surfels);
    assert_true(volume.bricks && volume.surfels);
    assert_int_equal(nook_brick_total(&volume.info), bricks);
    for (uint32_t i = 0; i < bricks; i++) {
        volume.bricks[i].mask[0] = 3;
        volume.bricks[i].first_surfel = 2 * i;
        volume.surfels[2 * i].plane[0] = seed + i;
        volume.surfels[2 * i + 1].plane[0] = seed + i + 1000;
    }
    return volume;
}

static void expect_bricks(const brick_pool *pool, uint32_t id, uint32_t bricks, uint32_t seed)
{
    const pool_entry *entry = brick_pool_find(pool, id);
    assert_non_null(entry);
    for (uint32_t i = 0; i < bricks; i++) {
        nook_brick brick;
        nook_surfel surfel;
        nook_buffer_read(pool->gpu, pool->bricks.buffer, (entry->bricks.first + i) * sizeof brick, &brick,
                         sizeof brick);
        assert_int_equal(brick.first_surfel, entry->surfels.first + 2 * i);
        nook_buffer_read(pool->gpu, pool->surfels.buffer, (brick.first_surfel + 1) * sizeof surfel, &surfel,
                         sizeof surfel);
        assert_int_equal(surfel.plane[0], seed + i + 1000);
    }
}

static void write_bricks(brick_pool *pool, uint32_t id, uint32_t bricks, uint32_t seed)
{
    nook_volume volume = bricks_of(bricks, seed);
    bool whole = false;
    assert_true(brick_pool_place(pool, id, &volume.info));
    assert_int_equal(brick_pool_flush(pool), NOOK_OK);
    for (int frame = 0; !whole; frame++) {
        size_t most = frame == 0 || frame == 2 ? 0 : 100; /* others may have had all of a frame */
        assert_null(brick_pool_find(pool, id));
        assert_true(brick_pool_write(pool, id, &volume, most, &whole) <= most);
    }
    nook_volume_free(&volume);
}

static void test_surfels_come_in_parts_and_find_their_bricks_in_another_room(void **state)
{
    brick_pool pool;
    brick_pool_init(&pool, test_gpu_of(state));
    assert_int_equal(brick_pool_set_room(&pool, 60, 100), NOOK_OK);
    assert_true(brick_pool_bytes(&pool) == 60 * sizeof(nook_brick) + 100 * sizeof(nook_surfel));
    write_bricks(&pool, 9, 20, 7);
    write_bricks(&pool, 4, 15, 300);
    expect_bricks(&pool, 9, 20, 7);
    expect_bricks(&pool, 4, 15, 300);
    nook_volume large = bricks_of(20, 1);
    assert_false(brick_pool_place(&pool, 1, &large.info)); /* bricks would fit, surfels do not */
    nook_volume_free(&large);
    brick_pool_remove(&pool, 9);
    write_bricks(&pool, 2, 12, 5000);
    assert_int_equal(brick_pool_set_room(&pool, 20, 40), NOOK_OK);
    expect_bricks(&pool, 2, 12, 5000);
    assert_null(brick_pool_find(&pool, 4)); /* by ids, what fits stays */
    brick_pool_remove(&pool, 2);
    write_bricks(&pool, 4, 15, 300);
    assert_int_equal(brick_pool_set_room(&pool, 16, 31), NOOK_OK);
    expect_bricks(&pool, 4, 15, 300);
    brick_pool_remove(&pool, 4);
    assert_int_equal(brick_pool_set_room(&pool, 0, 0), NOOK_OK);
    assert_true(brick_pool_bytes(&pool) == 0);
    assert_int_equal(pool.bricks.buffer.id, 0);
    brick_pool_release(&pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes_that_are_given_back_are_joined_whatever_came_between),
        cmocka_unit_test(test_a_tree_that_grew_is_one_box_when_nothing_is_left_in_it),
        cmocka_unit_test(test_a_volume_is_seen_when_its_last_slice_is_there_and_the_old_one_until_then),
        cmocka_unit_test(test_a_room_does_not_grow_and_another_one_keeps_what_fits),
        cmocka_unit_test(test_corners_made_part_by_part_are_those_made_at_once),
        cmocka_unit_test(test_corners_of_another_texture_are_made_of_what_it_holds_alone),
        cmocka_unit_test(test_surfels_come_in_parts_and_find_their_bricks_in_another_room),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
