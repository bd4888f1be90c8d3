#include "engine/core/log.h"
#include "modules/bake/volume_file.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include <cmocka.h>

enum { HEADER = 96 }; /* docs/volume_format.md */

static void swallow(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)level, (void)file, (void)line, (void)text;
    ++*(int *)user;
}

/* A 5x4x3 volume (60 voxels: the last byte of bits is not full) with four of its six inner voxels occupied. */
static nook_volume make_volume(void)
{
    nook_volume volume = { .info = { .kind = NOOK_VOLUME_BINARY,
                                     .width = 5,
                                     .height = 4,
                                     .depth = 3,
                                     .voxel_size = 0.25,
                                     .origin = { -1.5, 1e9 + 0.125, 3.0 },
                                     .content_hash = 0x0123456789abcdefu },
                           .voxels = calloc(60, 1) };
    assert_non_null(volume.voxels);
    static const int occupied[] = { 26, 28, 31, 32 };
    for (size_t i = 0; i < 4; i++, volume.info.occupied++)
        volume.voxels[occupied[i]] = 255;
    return volume;
}

typedef struct image {
    uint8_t *bytes;
    size_t size;
} image;

static image encode(const nook_volume *volume)
{
    void *bytes = NULL;
    image file = { 0 };
    assert_int_equal(nook_volume_encode(volume, &bytes, &file.size), NOOK_OK);
    file.bytes = bytes;
    return file;
}

static image make_file(void)
{
    nook_volume volume = make_volume();
    image file = encode(&volume);
    nook_volume_free(&volume);
    return file;
}

/* The checksum as the format's document states it, worked out here on its own. */
static void seal(image *file)
{
    uint8_t head[HEADER];
    memcpy(head, file->bytes, HEADER - 8);
    uint64_t payload = XXH64(file->bytes + HEADER, file->size - HEADER, 0);
    for (int i = 0; i < 8; i++)
        head[HEADER - 8 + i] = (uint8_t)(payload >> (8 * i));
    uint64_t sum = XXH64(head, HEADER, 0);
    for (int i = 0; i < 8; i++)
        file->bytes[HEADER - 8 + i] = (uint8_t)(sum >> (8 * i));
}

/* A buffer of exactly `size` bytes, so that the sanitizer sees a read past its end. */
static nook_result decode_copy(const void *bytes, size_t size, nook_volume *out)
{
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    nook_result result = nook_volume_decode("copy.nkv", copy, size, out);
    free(copy);
    return result;
}

static void assert_refused(const void *bytes, size_t size)
{
    int lines = 0;
    nook_volume volume = { .voxels = (uint8_t *)&lines }, before = volume;
    nook_log_set_sink(swallow, &lines);
    nook_result result = decode_copy(bytes, size, &volume);
    nook_log_set_sink(NULL, NULL);
    assert_true(result == NOOK_E_FORMAT || result == NOOK_E_VERSION);
    assert_int_equal(lines, 1);
    assert_memory_equal(&volume, &before, sizeof volume);
}

/* Changes one little-endian number in a good file, makes its checksum right again, and expects a refusal. */
static void assert_number_refused(size_t at, int size, uint64_t value)
{
    image file = make_file();
    for (int i = 0; i < size; i++)
        file.bytes[at + (size_t)i] = (uint8_t)(value >> (8 * i));
    seal(&file);
    assert_refused(file.bytes, file.size);
    free(file.bytes);
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void test_volume_comes_back_as_it_was(void **state)
{
    (void)state;
    nook_volume volume = make_volume(), back;
    image file = encode(&volume);
    assert_int_equal(decode_copy(file.bytes, file.size, &back), NOOK_OK);
    assert_memory_equal(back.voxels, volume.voxels, 60);
    assert_int_equal(back.info.kind, NOOK_VOLUME_BINARY);
    assert_int_equal(back.info.width, 5);
    assert_int_equal(back.info.height, 4);
    assert_int_equal(back.info.depth, 3);
    assert_true(back.info.voxel_size == 0.25);
    assert_memory_equal(back.info.origin, volume.info.origin, sizeof back.info.origin);
    assert_true(back.info.content_hash == 0x0123456789abcdefu);
    assert_int_equal(back.info.occupied, 4);
    nook_volume_free(&back);
    nook_volume_free(&volume);
    free(file.bytes);
}

static void test_header_stands_where_the_document_says(void **state)
{
    (void)state;
    image file = make_file();
    assert_memory_equal(file.bytes, "NKV\x1a", 4);
    assert_int_equal(file.bytes[4], NOOK_VOLUME_VERSION);
    assert_int_equal(file.bytes[12], 5);
    assert_int_equal(file.bytes[16], 4);
    assert_int_equal(file.bytes[20], 3);
    assert_memory_equal(file.bytes + 56, "\xef\xcd\xab\x89\x67\x45\x23\x01", 8);
    assert_int_equal(file.bytes[64], 4);
    assert_int_equal(file.bytes[72], 8);
    assert_int_equal(file.bytes[80], file.size - HEADER);
    image sealed = { malloc(file.size), file.size };
    assert_non_null(sealed.bytes);
    memcpy(sealed.bytes, file.bytes, file.size);
    seal(&sealed);
    assert_memory_equal(sealed.bytes, file.bytes, file.size);
    free(sealed.bytes);
    free(file.bytes);
}

static void test_info_is_read_without_voxels(void **state)
{
    (void)state;
    image file = make_file();
    nook_volume_info info;
    assert_int_equal(nook_volume_decode_info("v.nkv", file.bytes, file.size, &info), NOOK_OK);
    assert_int_equal(info.width, 5);
    assert_int_equal(info.occupied, 4);
    free(file.bytes);
}

static void test_same_volume_gives_the_same_bytes(void **state)
{
    (void)state;
    image a = make_file(), b = make_file();
    assert_int_equal(a.size, b.size);
    assert_memory_equal(a.bytes, b.bytes, a.size);
    free(a.bytes);
    free(b.bytes);
}

static void test_volume_read_refuses_every_shorter_file(void **state)
{
    (void)state;
    image file = make_file();
    for (size_t size = 0; size < file.size; size++)
        assert_refused(file.bytes, size);
    free(file.bytes);
}

static void test_volume_read_refuses_trailing_bytes(void **state)
{
    (void)state;
    image file = make_file();
    uint8_t *longer = calloc(file.size + 1, 1);
    assert_non_null(longer);
    memcpy(longer, file.bytes, file.size);
    assert_refused(longer, file.size + 1);
    free(longer);
    free(file.bytes);
}

static void test_volume_read_refuses_every_flipped_bit(void **state)
{
    (void)state;
    image file = make_file();
    for (size_t bit = 0; bit < file.size * 8; bit++) {
        file.bytes[bit / 8] ^= (uint8_t)(1 << (bit % 8));
        assert_refused(file.bytes, file.size);
        file.bytes[bit / 8] ^= (uint8_t)(1 << (bit % 8));
    }
    free(file.bytes);
}

/* With the checksum made right again the other checks stand alone: never a crash, and what is accepted is consistent. */
static void test_volume_read_survives_every_changed_byte_under_a_right_checksum(void **state)
{
    (void)state;
    image file = make_file();
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    for (size_t at = 0; at < file.size; at++)
        for (int value = 0; value < 256; value += 5) {
            uint8_t before = file.bytes[at];
            file.bytes[at] = (uint8_t)value;
            seal(&file);
            nook_volume volume;
            if (decode_copy(file.bytes, file.size, &volume) == NOOK_OK) {
                size_t count = (size_t)volume.info.width * volume.info.height * volume.info.depth, occupied = 0;
                for (size_t i = 0; i < count; i++)
                    occupied += volume.voxels[i] == 255;
                assert_int_equal(occupied, volume.info.occupied);
                assert_true(isfinite(volume.info.voxel_size) && volume.info.voxel_size > 0.0);
                nook_volume_free(&volume);
            }
            file.bytes[at] = before;
        }
    nook_log_set_sink(NULL, NULL);
    assert_true(lines > 0);
    free(file.bytes);
}

static void test_volume_read_refuses_absurd_numbers(void **state)
{
    (void)state;
    assert_number_refused(8, 4, 1); /* kind */
    for (size_t at = 12; at <= 20; at += 4) {
        assert_number_refused(at, 4, 0);
        assert_number_refused(at, 4, NOOK_VOLUME_SIDE_MAX + 1);
        assert_number_refused(at, 4, UINT32_MAX);
    }
    assert_number_refused(24, 8, bits_of(0.0));
    assert_number_refused(24, 8, bits_of(-1.0));
    for (size_t at = 24; at < 56; at += 8) {
        assert_number_refused(at, 8, bits_of((double)NAN));
        assert_number_refused(at, 8, bits_of((double)INFINITY));
    }
    assert_number_refused(64, 8, 19);         /* occupied: not true */
    assert_number_refused(64, 8, UINT64_MAX); /* occupied: impossible */
    assert_number_refused(72, 8, 9);          /* raw size */
    assert_number_refused(72, 8, UINT64_MAX);
    assert_number_refused(80, 8, UINT64_MAX - 95); /* compressed size: wraps when the header is added */
}

static void test_volume_read_refuses_bits_behind_the_last_voxel(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    volume.info.width = 4; /* 48 voxels; the same payload must not pass for it */
    volume.info.occupied = 4;
    image shorter = encode(&volume), file = make_file();
    memcpy(file.bytes + 12, shorter.bytes + 12, 4);
    memcpy(file.bytes + 64, shorter.bytes + 64, 16);
    seal(&file);
    assert_refused(file.bytes, file.size);
    free(shorter.bytes);
    free(file.bytes);

    /* 63 voxels need the same 8 bytes as 64. */
    uint8_t voxels[64] = { [13] = 255, [63] = 255 };
    volume.info = (nook_volume_info){
        .kind = NOOK_VOLUME_BINARY, .width = 4, .height = 4, .depth = 4, .voxel_size = 1.0, .occupied = 2
    };
    free(volume.voxels);
    volume.voxels = voxels;
    file = encode(&volume);
    file.bytes[12] = file.bytes[16] = 3; /* 13 is the middle of its second slice */
    file.bytes[20] = 7;
    file.bytes[64] = 1;
    seal(&file);
    assert_refused(file.bytes, file.size);
    free(file.bytes);
}

static void test_volume_read_refuses_voxels_in_the_outermost_layer(void **state)
{
    (void)state;
    static const int outermost[] = { 0, 59, 2, 25, 29, 22, 37, 47 }; /* corners, and one on each face */
    for (size_t i = 0; i < sizeof outermost / sizeof *outermost; i++) {
        nook_volume volume = make_volume();
        volume.voxels[outermost[i]] = 255;
        volume.info.occupied++;
        image file = encode(&volume);
        assert_refused(file.bytes, file.size);
        free(file.bytes);
        nook_volume_free(&volume);
    }
}

static void test_other_version_asks_to_bake_again(void **state)
{
    (void)state;
    image file = make_file();
    file.bytes[4] = NOOK_VOLUME_VERSION + 1;
    seal(&file);
    int lines = 0;
    nook_volume volume;
    nook_log_set_sink(swallow, &lines);
    assert_int_equal(nook_volume_decode("old.nkv", file.bytes, file.size, &volume), NOOK_E_VERSION);
    nook_log_set_sink(NULL, NULL);
    free(file.bytes);
}

static void test_encoding_refuses_what_is_not_a_binary_volume(void **state)
{
    (void)state;
    nook_volume volume = make_volume();
    void *bytes = &volume;
    size_t size = 7;
    int lines = 0;
    nook_log_set_sink(swallow, &lines);
    volume.voxels[1] = 128;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.voxels[1] = 0;
    volume.info.occupied++;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.info.occupied--;
    volume.info.voxel_size = (double)NAN;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    volume.info.voxel_size = 1.0;
    volume.info.width = 0;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_E_ARG);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 4);
    assert_ptr_equal(bytes, &volume);
    assert_int_equal(size, 7);
    nook_volume_free(&volume);
    nook_volume_free(&volume);
    nook_volume_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volume_comes_back_as_it_was),
        cmocka_unit_test(test_header_stands_where_the_document_says),
        cmocka_unit_test(test_info_is_read_without_voxels),
        cmocka_unit_test(test_same_volume_gives_the_same_bytes),
        cmocka_unit_test(test_volume_read_refuses_every_shorter_file),
        cmocka_unit_test(test_volume_read_refuses_trailing_bytes),
        cmocka_unit_test(test_volume_read_refuses_every_flipped_bit),
        cmocka_unit_test(test_volume_read_survives_every_changed_byte_under_a_right_checksum),
        cmocka_unit_test(test_volume_read_refuses_absurd_numbers),
        cmocka_unit_test(test_volume_read_refuses_bits_behind_the_last_voxel),
        cmocka_unit_test(test_volume_read_refuses_voxels_in_the_outermost_layer),
        cmocka_unit_test(test_other_version_asks_to_bake_again),
        cmocka_unit_test(test_encoding_refuses_what_is_not_a_binary_volume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
