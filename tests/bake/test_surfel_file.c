/* Surfels in .nkv files: what is accepted, shaders can trust. */
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "modules/bake/brick_grid.h"
#include "modules/bake/surfel_extent.h"
#include "modules/bake/volume_payload.h"
#include "tests/support/surfel_shapes.h"
#include "tests/support/voxel_shapes.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void swallow(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)level, (void)file, (void)line, (void)text;
    ++*(int *)user;
}

/* A box of 9 x 8 x 7, askew: 3 x 3 x 3 bricks, of which the last stand out. */
static nook_volume make_volume(void)
{
    float points[8][3];
    test_make_box(9.0f, 8.0f, 7.0f, points);
    test_rotate(points, 8, 0.5, 0.3);
    nook_triangles box = test_box_triangles(points);
    return test_make_surfels(&box, 8, 1);
}

/* A copy of exactly what the header asks for, so that the sanitizer sees a read past its end. @return the payload's verdict */
static nook_result read_payload(const nook_volume_info *info, const uint8_t *raw, nook_volume *out)
{
    size_t size = nook_payload_size(info);
    uint8_t *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, raw, size);
    *out = (nook_volume){ .info = *info };
    nook_result result = nook_payload_read("copy.nkv", copy, out);
    free(copy);
    return result;
}

static void assert_refused(const nook_volume_info *info, const uint8_t *raw)
{
    int lines = 0;
    nook_volume volume;
    nook_log_set_sink(swallow, &lines);
    assert_int_equal(read_payload(info, raw, &volume), NOOK_E_FORMAT);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 1);
    assert_null(volume.bricks);
    assert_null(volume.surfels);
}

static uint8_t *payload_of(const nook_volume *volume)
{
    uint8_t *raw = malloc(nook_payload_size(&volume->info));
    assert_non_null(raw);
    assert_int_equal(nook_payload_write(volume, raw), NOOK_OK);
    return raw;
}

static void test_surfels_come_back_as_they_were(void **state)
{
    (void)state;
    nook_volume volume = make_volume(), back;
    void *bytes;
    size_t size;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_volume_decode("box.nkv", bytes, size, &back), NOOK_OK);
    assert_int_equal(back.info.kind, NOOK_VOLUME_SURFEL);
    assert_null(back.voxels);
    test_assert_same_surfels(&volume, &back);
    assert_memory_equal(volume.info.origin, back.info.origin, sizeof back.info.origin);
    free(bytes);
    nook_volume_free(&volume);
    nook_volume_free(&back);
}

static void test_a_volume_without_surfels_goes_through_a_file(void **state)
{
    (void)state;
    const float point[3] = { 1, 2, 3 };
    const uint32_t indices[3] = { 0, 0, 0 };
    nook_triangles triangle = { point, 0, 1, indices, 3 };
    nook_volume volume = test_make_surfels(&triangle, 5, 1), back;
    void *bytes;
    size_t size;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_volume_decode("empty.nkv", bytes, size, &back), NOOK_OK);
    assert_int_equal(back.info.occupied, 0);
    assert_int_equal(back.bricks[0].skip, 1);
    free(bytes);
    nook_volume_free(&volume);
    nook_volume_free(&back);
}

static void test_voxels_outside_of_the_volume_are_refused(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    const uint32_t size[3] = { volume.info.width, volume.info.height, volume.info.depth };
    uint32_t counts[3];
    nook_brick_counts(&volume.info, counts);
    for (int axis = 0; axis < 3; axis++) {
        if (size[axis] % 4 == 0)
            continue;
        uint32_t at[3] = { 4, 4, 4 };
        at[axis] = size[axis]; /* one too far, in a brick that there is */
        nook_volume grown = volume;
        size_t bytes = nook_payload_size(&volume.info),
               brick = ((size_t)(at[2] / 4) * counts[1] + at[1] / 4) * counts[0] + at[0] / 4;
        uint32_t bit = nook_brick_bit(at[0], at[1], at[2]);
        uint8_t *raw = malloc(bytes + 8);
        assert_non_null(raw);
        assert_int_equal(nook_payload_write(&volume, raw), NOOK_OK);
        memcpy(raw + bytes, raw + bytes - 8, 8);
        raw[brick * 8 + bit / 8] |= (uint8_t)(1u << (bit % 8));
        grown.info.occupied++;
        assert_refused(&grown.info, raw);
        free(raw);
    }
    nook_volume_free(&volume);
}

static void test_surfels_that_are_no_planes_are_refused(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    uint8_t *raw = payload_of(&volume);
    size_t first = nook_brick_total(&volume.info) * 8;
    static const uint32_t wrong[][2] = {
        { 0, 0 },     { 1u << 24 | 0x80u, 0 }, { 63u << 24 | 3u << 30, 1u << 24 }, { 1u << 24 | 1u << 30, 0 },
        { 0x7fu, 0 }, { 1u << 24, 0x1f00fu }
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        uint8_t before[8];
        memcpy(before, raw + first, 8);
        for (size_t b = 0; b < 8; b++)
            raw[first + b] = (uint8_t)(wrong[i][b / 4] >> (8 * (b % 4)));
        assert_refused(&volume.info, raw);
        memcpy(raw + first, before, 8);
    }
    nook_volume back;
    assert_int_equal(read_payload(&volume.info, raw, &back), NOOK_OK);
    nook_volume_free(&back);
    free(raw);
    nook_volume_free(&volume);
}

static void test_a_count_that_masks_do_not_have_is_refused(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    uint8_t *raw = payload_of(&volume);
    nook_volume_info fewer = volume.info;
    fewer.occupied--;
    assert_refused(&fewer, raw);
    free(raw);
    nook_volume_free(&volume);
}

/* What shaders make of the words of an accepted surfel: planes with a normal, an offset and a part that is there, ends in order. */
static void assert_decodes(const nook_surfel *surfel)
{
    bool two = nook_surfel_word_is_plane(surfel->plane[1]);
    for (int k = 0; k < (two ? 2 : 1); k++) {
        const nook_surfel_plane plane = nook_surfel_unpack(surfel->plane[k]);
        assert_true(fabs(nook_vector_dot(plane.normal, plane.normal) - 1.0) < 1e-9);
        assert_true(fabs(plane.offset) <= NOOK_SURFEL_OFFSET_MAX);
        assert_in_range(plane.alpha, 1, NOOK_SURFEL_ALPHA_MAX);
        assert_true(two || plane.side == NOOK_SIDE_BOTH);
        if (plane.side == NOOK_SIDE_WITHIN) {
            assert_true(plane.interval < NOOK_EXTENT_CODES);
            const nook_surfel_extent extent = nook_surfel_interval_unpack(plane.interval);
            for (int axis = 0; axis < 3; axis++)
                assert_true(extent.low[axis] >= -0.5 && extent.low[axis] < extent.high[axis] &&
                            extent.high[axis] <= 0.5);
        }
    }
    const nook_surfel_extent box = nook_surfel_box_unpack(two ? 0 : surfel->plane[1]);
    for (int axis = 0; axis < 3; axis++)
        assert_true(box.low[axis] >= -0.5 && box.low[axis] < box.high[axis] && box.high[axis] <= 0.5);
}

/* Two words of any bits at all, half of them with a second one that is a box or nearly so. */
static void test_any_two_words_are_refused_or_decode(void **state)
{
    (void)state;
    uint32_t random = 5, sound[2] = { 0, 0 };
    enum { TRIES = 400000 };
    for (int i = 0; i < TRIES; i++) {
        nook_surfel surfel;
        for (int k = 0; k < 2; k++) {
            random = random * 1664525u + 1013904223u;
            uint32_t high = random & 0xffff0000u;
            random = random * 1664525u + 1013904223u;
            surfel.plane[k] = high | random >> 16;
        }
        if (i % 2) {
            surfel.plane[0] &= 0x3fffffffu;
            surfel.plane[1] &= 0x1777777u;
        }
        if (!nook_surfel_is_sound(surfel.plane[0], surfel.plane[1]))
            continue;
        assert_decodes(&surfel);
        sound[i % 2]++;
    }
    assert_in_range(sound[0], TRIES / 4, TRIES / 2 - 1000);
    assert_in_range(sound[1], TRIES / 16, TRIES / 2 - 1000);
}

/* Never a crash, and what is accepted is what shaders rely on. */
static void test_every_changed_byte_is_refused_or_sound(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    uint8_t *raw = payload_of(&volume);
    int lines = 0, accepted = 0, boxes = 0, intervals = 0;
    for (size_t i = 0; i < volume.info.occupied; i++) {
        bool two = nook_surfel_word_is_plane(volume.surfels[i].plane[1]);
        boxes += !two && volume.surfels[i].plane[1] != 0;
        for (int k = 0; two && k < 2; k++)
            intervals += nook_surfel_unpack(volume.surfels[i].plane[k]).side == NOOK_SIDE_WITHIN;
    }
    assert_true(boxes > 0 && intervals > 0); /* words of both sorts are among what is changed */
    nook_log_set_sink(swallow, &lines);
    for (size_t at = 0; at < nook_payload_size(&volume.info); at++) {
        for (int value = 0; value < 256; value += 17) {
            uint8_t before = raw[at];
            nook_volume back;
            raw[at] = (uint8_t)value;
            if (read_payload(&volume.info, raw, &back) == NOOK_OK) {
                uint32_t surfels = 0;
                for (size_t i = 0; i < nook_brick_total(&back.info); i++) {
                    const nook_brick *brick = &back.bricks[i];
                    assert_int_equal(brick->first_surfel, surfels);
                    assert_int_equal(brick->skip == 0, (brick->mask[0] | brick->mask[1]) != 0);
                    for (int bit = 0; bit < 64; bit++)
                        surfels += brick->mask[bit / 32] >> (bit % 32) & 1;
                }
                assert_int_equal(surfels, back.info.occupied);
                for (size_t i = 0; i < back.info.occupied; i++)
                    assert_decodes(&back.surfels[i]);
                accepted++;
                nook_volume_free(&back);
            }
            raw[at] = before;
        }
    }
    nook_log_set_sink(NULL, NULL);
    assert_true(lines > 0);
    assert_true(accepted > 0);
    free(raw);
    nook_volume_free(&volume);
}

static void test_encoding_refuses_surfels_that_no_file_may_hold(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    void *bytes = &volume;
    size_t size = 7;
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    volume.info.occupied--;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.info.occupied++;
    uint32_t before = volume.surfels[3].plane[0];
    volume.surfels[3].plane[0] = 0;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.surfels[3].plane[0] = before;
    volume.info.kind = (nook_volume_kind)NOOK_VOLUME_KINDS;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.info.kind = NOOK_VOLUME_SURFEL;
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 3);
    assert_ptr_equal(bytes, &volume);
    assert_int_equal(size, 7);
    nook_volume_free(&volume);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surfels_come_back_as_they_were),
        cmocka_unit_test(test_a_volume_without_surfels_goes_through_a_file),
        cmocka_unit_test(test_voxels_outside_of_the_volume_are_refused),
        cmocka_unit_test(test_surfels_that_are_no_planes_are_refused),
        cmocka_unit_test(test_a_count_that_masks_do_not_have_is_refused),
        cmocka_unit_test(test_any_two_words_are_refused_or_decode),
        cmocka_unit_test(test_every_changed_byte_is_refused_or_sound),
        cmocka_unit_test(test_encoding_refuses_surfels_that_no_file_may_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
