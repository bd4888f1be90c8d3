/* Many volumes in one 3D texture: they never overlap, and each keeps its own voxels. */
#include "modules/ao/volume_atlas_internal.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { VOLUMES = 60 };

typedef struct held {
    uint32_t id, size[3], seed; /* id 0: removed */
} held;

static uint8_t voxel_of(uint32_t seed, size_t index)
{
    uint32_t x = seed * 2654435761u + (uint32_t)index * 40503u;
    return (uint8_t)(x >> 11);
}

static nook_volume make_volume(const uint32_t size[3], uint32_t seed)
{
    nook_volume volume = { .info = { .width = size[0], .height = size[1], .depth = size[2], .voxel_size = 1.0 } };
    size_t count = (size_t)size[0] * size[1] * size[2];
    volume.voxels = malloc(count);
    assert_non_null(volume.voxels);
    for (size_t i = 0; i < count; i++)
        volume.voxels[i] = voxel_of(seed, i);
    return volume;
}

static void add(volume_atlas *atlas, held *item, uint32_t width, uint32_t height, uint32_t depth, uint32_t seed)
{
    /* Any id that is not there: also one between those of others. */
    uint32_t id = 1 + seed * 7919 % 60013;
    while (volume_atlas_find(atlas, id))
        id++;
    *item = (held){ .id = id, .size = { width, height, depth }, .seed = seed };
    nook_volume volume = make_volume(item->size, seed);
    assert_int_equal(volume_atlas_add(atlas, id, &volume), NOOK_OK);
    assert_null(volume.voxels); /* taken */
}

static int overlap(const atlas_box *a, const atlas_box *b)
{
    int all = 1;
    for (int axis = 0; axis < 3; axis++)
        all = all && a->origin[axis] < b->origin[axis] + b->size[axis] &&
              b->origin[axis] < a->origin[axis] + a->size[axis];
    return all;
}

static void check_boxes(const volume_atlas *atlas)
{
    for (uint32_t i = 0; i < atlas->seen.count; i++) {
        const atlas_box *box = &atlas->seen.items[i].box;
        for (int axis = 0; axis < 3; axis++)
            assert_true(box->origin[axis] + box->size[axis] <= atlas->tree.size[axis]);
        for (uint32_t k = 0; k < i; k++)
            assert_false(overlap(box, &atlas->seen.items[k].box));
        for (uint32_t k = 0; k < atlas->tree.count; k++)
            assert_false(atlas->tree.nodes[k].state == BOX_FREE && overlap(box, &atlas->tree.nodes[k].box));
    }
}

static void check_voxels(volume_atlas *atlas, const held *items, uint32_t count)
{
    assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
    size_t bytes = (size_t)volume_atlas_bytes(atlas);
    uint8_t *texels = malloc(bytes);
    assert_non_null(texels);
    nook_texture_read(atlas->gpu, atlas->texture, GL_RED, GL_UNSIGNED_BYTE, texels, bytes);
    for (uint32_t i = 0; i < count; i++) {
        const atlas_entry *entry = volume_atlas_find(atlas, items[i].id);
        assert_true((entry != NULL) == (items[i].id != 0));
        if (!entry)
            continue;
        const uint32_t *at = entry->box.origin, *size = items[i].size;
        assert_memory_equal(entry->box.size, size, sizeof entry->box.size);
        for (size_t v = 0; v < (size_t)size[0] * size[1] * size[2]; v++) {
            size_t x = at[0] + v % size[0], y = at[1] + v / size[0] % size[1], z = at[2] + v / size[0] / size[1];
            assert_int_equal(texels[(z * atlas->texture.height + y) * atlas->texture.width + x],
                             voxel_of(items[i].seed, v));
        }
    }
    free(texels);
}

static void test_atlas_keeps_every_volume_through_growth_and_removal(void **state)
{
    volume_atlas atlas;
    held items[VOLUMES];
    volume_atlas_init(&atlas, test_gpu_of(state));
    for (uint32_t i = 0; i < VOLUMES; i++) {
        add(&atlas, &items[i], 1 + i * 7 % 23, 1 + i * 5 % 17, 1 + i * 11 % 29, i);
        if (i % 20 == 19) {
            check_boxes(&atlas);
            check_voxels(&atlas, items, i + 1); /* flushed in between: later ones make the texture grow */
        }
    }
    for (uint32_t i = 0; i < VOLUMES; i += 3) {
        volume_atlas_remove(&atlas, items[i].id);
        items[i].id = 0;
    }
    check_voxels(&atlas, items, VOLUMES);
    for (uint32_t i = 0; i < VOLUMES; i += 3)
        add(&atlas, &items[i], 1 + i * 3 % 19, 1 + i * 13 % 11, 1 + i * 2 % 31, 1000 + i);
    check_boxes(&atlas);
    check_voxels(&atlas, items, VOLUMES);
    volume_atlas_release(&atlas);
}

static void test_atlas_puts_a_volume_of_the_same_size_where_one_was_removed(void **state)
{
    volume_atlas atlas;
    held items[8];
    volume_atlas_init(&atlas, test_gpu_of(state));
    for (uint32_t i = 0; i < 8; i++)
        add(&atlas, &items[i], 9, 6, 13, i);
    uint64_t bytes = volume_atlas_bytes(&atlas);
    for (uint32_t round = 0; round < 50; round++) {
        held *item = &items[round * 3 % 8];
        volume_atlas_remove(&atlas, item->id);
        add(&atlas, item, 9, 6, 13, 100 + round);
    }
    assert_true(volume_atlas_bytes(&atlas) == bytes);
    check_voxels(&atlas, items, 8);
    volume_atlas_release(&atlas);
}

static void test_atlas_that_is_emptied_holds_any_sizes_anew_and_gives_its_memory_back(void **state)
{
    volume_atlas atlas;
    volume_atlas_init(&atlas, test_gpu_of(state));
    held item;
    add(&atlas, &item, 64, 64, 64, 1);
    volume_atlas_remove(&atlas, item.id);
    assert_true(volume_atlas_bytes(&atlas) == 0);
    for (uint32_t round = 1; round < 40; round++) { /* a level is left, another one entered */
        held items[4];
        uint64_t voxels = 0;
        for (uint32_t i = 0; i < 4; i++) {
            add(&atlas, &items[i], 16 + round % 16, 20 + i, 30 - round % 13, round + i);
            voxels += (uint64_t)(16 + round % 16) * (20 + i) * (30 - round % 13);
        }
        check_boxes(&atlas);
        assert_true(volume_atlas_bytes(&atlas) < 2 * voxels); /* nothing of the 64^3 is left */
        if (round % 8 == 0)
            check_voxels(&atlas, items, 4);
        for (uint32_t i = 0; i < 4; i++)
            volume_atlas_remove(&atlas, items[i].id);
    }
    assert_true(volume_atlas_bytes(&atlas) == 0);
    volume_atlas_release(&atlas);
}

static void test_atlas_knows_no_id_that_was_removed(void **state)
{
    volume_atlas atlas;
    held first, second;
    volume_atlas_init(&atlas, test_gpu_of(state));
    assert_null(volume_atlas_find(&atlas, 0));
    assert_int_equal(volume_atlas_flush(&atlas), NOOK_OK); /* nothing to do */
    add(&atlas, &first, 3, 3, 3, 1);
    volume_atlas_remove(&atlas, first.id);
    volume_atlas_remove(&atlas, first.id);
    volume_atlas_remove(&atlas, 4711);
    add(&atlas, &second, 3, 3, 3, 2);
    assert_true(second.id != first.id);
    assert_null(volume_atlas_find(&atlas, first.id));
    check_voxels(&atlas, &second, 1);
    volume_atlas_release(&atlas);
}

static void test_atlas_refuses_what_the_device_cannot_hold(void **state)
{
    nook_gpu small = *test_gpu_of(state);
    small.max_texture_3d_size = 32;
    volume_atlas atlas;
    held items[9];
    uint32_t count = 0;
    nook_log_capture line;
    volume_atlas_init(&atlas, &small);
    nook_volume wide = make_volume((const uint32_t[]){ 33, 2, 2 }, 0);
    nook_log_capture_begin(&line);
    nook_result result = volume_atlas_add(&atlas, 1, &wide);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_MEMORY);
    assert_non_null(strstr(line.text, "33x2x2"));
    assert_non_null(wide.voxels); /* still the caller's */
    nook_volume_free(&wide);

    for (; count < 8; count++) /* eight of 16 fill a texture of 32 */
        add(&atlas, &items[count], 16, 16, 16, count);
    nook_volume ninth = make_volume((const uint32_t[]){ 16, 16, 16 }, 9);
    nook_log_capture_begin(&line);
    result = volume_atlas_add(&atlas, 70000, &ninth);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_MEMORY);
    assert_int_equal(line.count, 1);
    assert_null(volume_atlas_find(&atlas, 70000));
    nook_volume_free(&ninth);
    check_boxes(&atlas);
    check_voxels(&atlas, items, 8);
    volume_atlas_release(&atlas);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_atlas_keeps_every_volume_through_growth_and_removal),
        cmocka_unit_test(test_atlas_puts_a_volume_of_the_same_size_where_one_was_removed),
        cmocka_unit_test(test_atlas_that_is_emptied_holds_any_sizes_anew_and_gives_its_memory_back),
        cmocka_unit_test(test_atlas_knows_no_id_that_was_removed),
        cmocka_unit_test(test_atlas_refuses_what_the_device_cannot_hold),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
