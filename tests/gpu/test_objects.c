#include "engine/core/log.h"
#include "engine/gpu/gpu.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static void ignore_log(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)level, (void)file, (void)line, (void)text;
    ++*(int *)user;
}

static nook_program compute(nook_gpu *gpu, const char *path, const char *defines)
{
    nook_program program = { 0 };
    assert_int_equal(nook_program_compute(gpu, path, defines, &program), NOOK_OK);
    return program;
}

static void test_gpu_says_what_it_is(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    assert_non_null(strstr(gpu->version, "4.5"));
    assert_true(gpu->software);
    assert_false(nook_gpu_timer_trusted(gpu));
    assert_true(gpu->max_texture_size >= 16384);
    assert_true(gpu->max_texture_3d_size >= 2048);
}

static void test_gpu_create_refuses_a_thread_without_a_context(void **state)
{
    (void)state;
    test_gpu test;
    assert_int_equal(test_gpu_create(NULL, &test), NOOK_OK);
    nook_gl_get_proc get_proc = nook_context_get_proc(test.context);
    test_gpu_destroy(&test);
    int lines = 0;
    nook_gpu *gpu = NULL;
    nook_log_set_sink(ignore_log, &lines);
    nook_result result = nook_gpu_create(&(nook_gpu_desc){ .get_proc = get_proc, .source_root = "." }, &gpu);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(result, NOOK_E_DEVICE);
    assert_null(gpu);
    assert_int_equal(lines, 1);
}

static void test_compute_writes_a_texture_that_is_read_back(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    enum { WIDTH = 37, HEIGHT = 19 };
    float texels[HEIGHT][WIDTH];
    nook_texture texture;
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32F, WIDTH, HEIGHT, GL_NEAREST, &texture), NOOK_OK);
    nook_bind_image(gpu, 0, texture, GL_WRITE_ONLY);
    nook_dispatch(gpu, compute(gpu, "tests/gpu/shaders/gradient.comp.glsl", "#define SCALE 0.25\n"),
                  nook_groups(WIDTH, 8), nook_groups(HEIGHT, 8), 1);
    nook_texture_read(gpu, texture, GL_RED, GL_FLOAT, texels, sizeof texels);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_true(texels[y][x] == (float)(x + 1000 * y) * 0.25f);
    nook_texture_destroy(gpu, &texture);
    assert_int_equal(texture.id, 0);
}

/* Samples a volume at points given in a buffer: textures of three dimensions, storage buffers and uniforms at once. */
static void test_volume_is_sampled_trilinearly(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    enum { SIDE = 4, COUNT = 5 };
    uint8_t texels[SIDE][SIDE][SIDE];
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                texels[z][y][x] = (uint8_t)(16 * x + 4 * y + z); /* linear, so that its interpolation is known */
    /* In texels, centres at .5: a centre, between two on each axis, between eight, beyond the edge (clamped). */
    const float points[COUNT][4] = {
        { 1.5f, 2.5f, 3.5f, 0 }, { 2.0f, 2.5f, 3.5f, 0 },  { 1.5f, 2.0f, 3.5f, 0 },
        { 2.0f, 1.0f, 3.0f, 0 }, { -5.0f, 1.5f, 1.5f, 0 },
    };
    const float expected[COUNT] = { 16 + 8 + 3, 24 + 8 + 3, 16 + 6 + 3, 24 + 2 + 2.5f, 0 + 4 + 1 };
    const uint32_t sizes[4] = { COUNT, SIDE, 0, 0 };
    float values[COUNT];
    nook_texture volume;
    nook_buffer in, out, block;
    assert_int_equal(nook_texture_create_3d(gpu, GL_R8, SIDE, SIDE, SIDE, GL_LINEAR, &volume), NOOK_OK);
    nook_texture_write(gpu, volume, GL_RED, GL_UNSIGNED_BYTE, texels, sizeof texels);
    assert_int_equal(nook_buffer_create(gpu, points, sizeof points, &in), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, NULL, sizeof values, &out), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, sizes, sizeof sizes, &block), NOOK_OK);
    nook_bind_texture(gpu, 2, volume);
    nook_bind_storage(gpu, 3, in);
    nook_bind_storage(gpu, 4, out);
    nook_bind_uniform(gpu, 1, block);
    nook_dispatch(gpu, compute(gpu, "tests/gpu/shaders/sample_volume.comp.glsl", ""), 1, 1, 1);
    nook_buffer_read(gpu, out, 0, values, sizeof values);
    for (int i = 0; i < COUNT; i++)
        /* llvmpipe interpolates 8 bit texels in 8 bits: whole steps come back */
        assert_true(values[i] > expected[i] - 0.75f && values[i] < expected[i] + 0.75f);
    nook_buffer_destroy(gpu, &in);
    nook_buffer_destroy(gpu, &out);
    nook_buffer_destroy(gpu, &block);
    nook_texture_destroy(gpu, &volume);
}

static void test_texture_write_box_touches_only_its_box(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    enum { SIDE = 5 };
    uint8_t texels[SIDE][SIDE][SIDE] = { { { 0 } } };
    const uint8_t box[2][1][3] = { { { 1, 2, 3 } }, { { 4, 5, 6 } } };
    const uint32_t origin[3] = { 1, 2, 3 }, extent[3] = { 3, 1, 2 };
    nook_texture texture;
    assert_int_equal(nook_texture_create_3d(gpu, GL_R8, SIDE, SIDE, SIDE, GL_NEAREST, &texture), NOOK_OK);
    nook_texture_write(gpu, texture, GL_RED, GL_UNSIGNED_BYTE, texels, sizeof texels);
    nook_texture_write_box(gpu, texture, origin, extent, GL_RED, GL_UNSIGNED_BYTE, box, sizeof box);
    memset(texels, 255, sizeof texels);
    nook_texture_read(gpu, texture, GL_RED, GL_UNSIGNED_BYTE, texels, sizeof texels);
    for (uint32_t z = 0; z < SIDE; z++)
        for (uint32_t y = 0; y < SIDE; y++)
            for (uint32_t x = 0; x < SIDE; x++) {
                int inside = x >= 1 && x < 4 && y == 2 && z >= 3 && z < 5;
                assert_int_equal(texels[z][y][x], inside ? (int)(1 + (x - 1) + 3 * (z - 3)) : 0);
            }
    nook_texture_destroy(gpu, &texture);
}

static void test_textures_are_moved_without_changing_the_hosts_alignments(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    uint8_t texels[9] = { 0 };
    GLint pack, unpack;
    nook_texture texture;
    assert_int_equal(nook_texture_create_2d(gpu, GL_R8, 3, 3, GL_NEAREST, &texture), NOOK_OK);
    gpu->gl->PixelStorei(GL_PACK_ALIGNMENT, 8);
    gpu->gl->PixelStorei(GL_UNPACK_ALIGNMENT, 2);
    nook_texture_write(gpu, texture, GL_RED, GL_UNSIGNED_BYTE, texels, sizeof texels);
    nook_texture_read(gpu, texture, GL_RED, GL_UNSIGNED_BYTE, texels, sizeof texels);
    gpu->gl->GetIntegerv(GL_PACK_ALIGNMENT, &pack);
    gpu->gl->GetIntegerv(GL_UNPACK_ALIGNMENT, &unpack);
    gpu->gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    gpu->gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    nook_texture_destroy(gpu, &texture);
    assert_int_equal(pack, 8);
    assert_int_equal(unpack, 2);
}

static void test_mipped_texture_averages_its_texels(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    uint8_t texels[3][5][4], last[4]; /* neither square nor a power of two */
    for (int i = 0; i < 15; i++)
        memcpy(((uint8_t(*)[4])texels)[i], (uint8_t[4]){ 200, 100, 0, 255 }, 4);
    nook_texture texture;
    assert_int_equal(nook_texture_create_mipped(gpu, GL_RGBA8, 5, 3, texels, &texture), NOOK_OK);
    gpu->gl->GetTextureImage(texture.id, 2, GL_RGBA, GL_UNSIGNED_BYTE, sizeof last, last);
    assert_memory_equal(last, ((uint8_t[4]){ 200, 100, 0, 255 }), 4);
    nook_texture_destroy(gpu, &texture);
}

static void test_texture_create_refuses_sizes_and_formats_it_cannot_have(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    int lines = 0;
    nook_texture texture = { .id = 77 };
    nook_log_set_sink(ignore_log, &lines);
    nook_result empty = nook_texture_create_2d(gpu, GL_R8, 0, 4, GL_NEAREST, &texture);
    nook_result wide = nook_texture_create_2d(gpu, GL_R8, gpu->max_texture_size + 1, 4, GL_NEAREST, &texture);
    nook_result deep = nook_texture_create_3d(gpu, GL_R8, 4, 4, gpu->max_texture_3d_size + 1, GL_NEAREST, &texture);
    nook_result memory = nook_texture_create_3d(gpu, GL_RGBA32F, 2048, 2048, 2048, GL_NEAREST, &texture);
    nook_result format = nook_texture_create_2d(gpu, GL_RGBA, 4, 4, GL_NEAREST, &texture);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(empty, NOOK_E_RANGE);
    assert_int_equal(wide, NOOK_E_RANGE);
    assert_int_equal(deep, NOOK_E_RANGE);
    assert_int_equal(memory, NOOK_E_MEMORY);
    assert_int_equal(format, NOOK_E_RANGE);
    assert_int_equal(texture.id, 77);
    assert_false(nook_gpu_check(gpu, "the refusals"));
}

static void test_buffer_update_replaces_only_its_bytes(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    const uint8_t start[8] = { 1, 2, 3, 4, 5, 6, 7, 8 }, change[3] = { 30, 40, 50 };
    uint8_t end[8] = { 0 };
    nook_buffer buffer;
    assert_int_equal(nook_buffer_create(gpu, start, sizeof start, &buffer), NOOK_OK);
    assert_int_equal(buffer.size, 8);
    nook_buffer_update(gpu, buffer, 2, change, sizeof change);
    nook_buffer_read(gpu, buffer, 0, end, sizeof end);
    assert_memory_equal(end, ((uint8_t[8]){ 1, 2, 30, 40, 50, 6, 7, 8 }), 8);
    nook_buffer_destroy(gpu, &buffer);
    assert_int_equal(buffer.id, 0);
}

static void test_texture_of_a_buffer_shows_what_the_buffer_holds_now(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    enum { COUNT = 5 };
    float numbers[COUNT][4], values[COUNT][4];
    nook_buffer buffer, out;
    nook_texture texture;
    assert_int_equal(nook_buffer_create(gpu, NULL, sizeof numbers, &buffer), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, NULL, sizeof values, &out), NOOK_OK);
    assert_int_equal(nook_texture_create_buffer(gpu, GL_RGBA32F, buffer, &texture), NOOK_OK);
    assert_int_equal(texture.width, COUNT);
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < COUNT * 4; i++)
            numbers[i / 4][i % 4] = (float)(100 * turn + i) + 0.125f;
        nook_buffer_update(gpu, buffer, 0, numbers, sizeof numbers);
        nook_bind_texture(gpu, 2, texture);
        nook_bind_storage(gpu, 4, out);
        nook_dispatch(gpu, compute(gpu, "tests/gpu/shaders/read_texels.comp.glsl", ""), 1, 1, 1);
        nook_buffer_read(gpu, out, 0, values, sizeof values);
        assert_memory_equal(values, numbers, sizeof values);
    }
    nook_texture_destroy(gpu, &texture);
    nook_buffer_destroy(gpu, &buffer);
    nook_buffer_destroy(gpu, &out);
}

static void test_texture_of_a_buffer_refuses_more_texels_than_the_device_takes(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    nook_buffer buffer;
    nook_texture texture = { .id = 7 };
    GLint most = 0;
    int lines = 0;
    gpu->gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    assert_int_equal(nook_buffer_create(gpu, NULL, 16, &buffer), NOOK_OK);
    const nook_buffer larger = { buffer.id, ((size_t)most + 1) * 16 }; /* it is refused before it is looked at */
    nook_log_set_sink(ignore_log, &lines);
    assert_int_equal(nook_texture_create_buffer(gpu, GL_RGBA32F, larger, &texture), NOOK_E_RANGE);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 1);
    assert_int_equal(texture.id, 7);
    nook_buffer_destroy(gpu, &buffer);
}

static void test_buffer_create_refuses_no_bytes(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    int lines = 0;
    nook_buffer buffer = { .id = 77 };
    nook_log_set_sink(ignore_log, &lines);
    nook_result result = nook_buffer_create(gpu, NULL, 0, &buffer);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(result, NOOK_E_RANGE);
    assert_int_equal(buffer.id, 77);
}

static void test_gpu_check_tells_an_error_once(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    int lines = 0;
    assert_false(nook_gpu_check(gpu, "nothing"));
    nook_log_set_sink(ignore_log, &lines);
    gpu->gl->Enable(0x1234);
    bool first = nook_gpu_check(gpu, "a wrong call");
    bool second = nook_gpu_check(gpu, "no call");
    nook_log_set_sink(NULL, NULL);
    assert_true(first);
    assert_false(second);
    assert_int_equal(lines, 2); /* the driver's own words and ours */
}

static void test_gpu_check_still_tells_what_a_creation_found(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    int lines = 0;
    nook_texture texture;
    nook_log_set_sink(ignore_log, &lines);
    gpu->gl->Enable(0x1234);
    nook_result result = nook_texture_create_2d(gpu, GL_R8, 4, 4, GL_NEAREST, &texture);
    bool told = nook_gpu_check(gpu, "a wrong call and a creation");
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(result, NOOK_OK); /* it was not this call's fault */
    assert_true(told);
    nook_texture_destroy(gpu, &texture);
}

static void test_timer_measures_without_errors(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    nook_gpu_timer timer;
    nook_gpu_timer_create(gpu, &timer);
    nook_gpu_timer_begin(gpu, timer);
    nook_gpu_finish(gpu);
    nook_gpu_timer_end(gpu, timer);
    double ms = nook_gpu_timer_ms(gpu, timer);
    assert_true(ms >= 0 && ms < 60000); /* software GL: no more than that can be asked of it */
    nook_gpu_timer_destroy(gpu, &timer);
    assert_int_equal(timer.begin, 0);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, test_gpu_setup, test_gpu_teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_gpu_says_what_it_is),
        cmocka_unit_test(test_gpu_create_refuses_a_thread_without_a_context),
        TEST(test_compute_writes_a_texture_that_is_read_back),
        TEST(test_volume_is_sampled_trilinearly),
        TEST(test_texture_write_box_touches_only_its_box),
        TEST(test_textures_are_moved_without_changing_the_hosts_alignments),
        TEST(test_mipped_texture_averages_its_texels),
        TEST(test_texture_create_refuses_sizes_and_formats_it_cannot_have),
        TEST(test_buffer_update_replaces_only_its_bytes),
        TEST(test_texture_of_a_buffer_shows_what_the_buffer_holds_now),
        TEST(test_texture_of_a_buffer_refuses_more_texels_than_the_device_takes),
        TEST(test_buffer_create_refuses_no_bytes),
        TEST(test_gpu_check_tells_an_error_once),
        TEST(test_gpu_check_still_tells_what_a_creation_found),
        TEST(test_timer_measures_without_errors),
    };
    return cmocka_run_group_tests_name("gpu objects", tests, NULL, NULL);
}
