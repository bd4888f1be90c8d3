/* Many surfel volumes in two texture buffers: each keeps its own bricks and surfels, whatever comes and goes around it. */
#include "modules/ao/brick_pool_internal.h"
#include "modules/bake/brick_grid.h"
#include "tests/support/log_capture.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/test_gpu.h"
#include "tests/support/voxel_shapes.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { VOLUMES = 24 };

typedef struct held {
    uint32_t id; /* 0: removed */
    nook_volume copy;
} held;

static nook_volume make_volume(uint32_t seed)
{
    float points[8][3];
    test_make_box(3.0f + (float)(seed % 5), 4.0f, 5.0f + (float)(seed % 3), points);
    test_rotate(points, 8, 0.1 * seed, 0.3);
    nook_triangles box = test_box_triangles(points);
    return test_make_surfels(&box, 5 + seed * 7 % 20, 1);
}

static void add(brick_pool *pool, held *item, uint32_t id, uint32_t seed)
{
    nook_volume volume = make_volume(seed);
    *item = (held){ .id = id, .copy = make_volume(seed) };
    assert_int_equal(brick_pool_add(pool, id, &volume), NOOK_OK);
    assert_null(volume.bricks); /* taken */
}

static void drop(brick_pool *pool, held *item)
{
    brick_pool_remove(pool, item->id);
    nook_volume_free(&item->copy);
    item->id = 0;
}

static void check(brick_pool *pool, const held *items, uint32_t count)
{
    assert_int_equal(brick_pool_flush(pool), NOOK_OK);
    uint8_t *bricks = malloc(pool->bricks.buffer.size), *surfels = malloc(pool->surfels.buffer.size);
    assert_non_null(bricks);
    assert_non_null(surfels);
    nook_buffer_read(pool->gpu, pool->bricks.buffer, 0, bricks, pool->bricks.buffer.size);
    nook_buffer_read(pool->gpu, pool->surfels.buffer, 0, surfels, pool->surfels.buffer.size);
    for (uint32_t i = 0; i < count; i++) {
        const nook_volume *copy = &items[i].copy;
        const pool_entry *entry = items[i].id ? brick_pool_find(pool, items[i].id) : NULL;
        assert_true((entry != NULL) == (items[i].id != 0));
        if (!entry)
            continue;
        assert_int_equal(entry->bricks.count, nook_brick_total(&copy->info));
        for (uint32_t b = 0; b < entry->bricks.count; b++) {
            nook_brick brick;
            memcpy(&brick, bricks + (entry->bricks.first + b) * sizeof brick, sizeof brick);
            assert_int_equal(brick.first_surfel, copy->bricks[b].first_surfel + entry->surfels.first);
            brick.first_surfel = copy->bricks[b].first_surfel;
            assert_memory_equal(&brick, &copy->bricks[b], sizeof brick);
        }
        assert_memory_equal(surfels + entry->surfels.first * sizeof(nook_surfel), copy->surfels,
                            entry->surfels.count * sizeof(nook_surfel));
    }
    free(bricks);
    free(surfels);
}

static void test_pool_keeps_every_volume_through_growth_and_removal(void **state)
{
    brick_pool pool;
    held items[VOLUMES] = { 0 };
    brick_pool_init(&pool, test_gpu_of(state));
    for (uint32_t i = 0; i < VOLUMES; i++) {
        add(&pool, &items[i], 1 + i * 7 % 25, i); /* in no order of ids */
        if (i % 5 == 0)
            check(&pool, items, i + 1);
    }
    for (uint32_t i = 0; i < VOLUMES; i += 3)
        drop(&pool, &items[i]);
    check(&pool, items, VOLUMES);
    for (uint32_t i = 0; i < VOLUMES; i += 3)
        add(&pool, &items[i], 100 + i, 50 + i);
    check(&pool, items, VOLUMES);
    for (uint32_t i = 0; i < VOLUMES; i++)
        drop(&pool, &items[i]);
    assert_int_equal(brick_pool_bytes(&pool), 0);
    assert_int_equal(pool.bricks.buffer.id, 0);
    brick_pool_release(&pool);
}

static void test_pool_puts_a_volume_where_one_was_removed(void **state)
{
    brick_pool pool;
    held items[3] = { 0 };
    brick_pool_init(&pool, test_gpu_of(state));
    for (uint32_t i = 0; i < 3; i++)
        add(&pool, &items[i], i + 1, 4);
    uint64_t bytes = brick_pool_bytes(&pool);
    for (uint32_t round = 0; round < 20; round++) {
        drop(&pool, &items[round % 3]);
        add(&pool, &items[round % 3], 10 + round, 4);
        assert_int_equal(brick_pool_bytes(&pool), bytes);
    }
    check(&pool, items, 3);
    for (uint32_t i = 0; i < 3; i++)
        drop(&pool, &items[i]);
    brick_pool_release(&pool);
}

static void test_pool_refuses_what_the_device_cannot_hold(void **state)
{
    nook_gpu small = *test_gpu_of(state);
    brick_pool pool;
    held item = { 0 };
    nook_log_capture line;
    small.max_texture_buffer_size = 1200;
    brick_pool_init(&pool, &small);
    add(&pool, &item, 1, 2); /* 986 surfels */
    nook_volume another = make_volume(2);
    uint64_t bytes = brick_pool_bytes(&pool);
    nook_log_capture_begin(&line);
    nook_result result = brick_pool_add(&pool, 2, &another);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_MEMORY);
    assert_int_equal(line.count, 1);
    assert_non_null(strstr(line.text, "texture buffers of 1200"));
    assert_non_null(another.bricks); /* still the caller's */
    assert_int_equal(brick_pool_bytes(&pool), bytes);
    nook_volume_free(&another);
    check(&pool, &item, 1);
    drop(&pool, &item);
    brick_pool_release(&pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pool_keeps_every_volume_through_growth_and_removal),
        cmocka_unit_test(test_pool_puts_a_volume_where_one_was_removed),
        cmocka_unit_test(test_pool_refuses_what_the_device_cannot_hold),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
