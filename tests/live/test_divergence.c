/* shaders/live/divergence.frag.glsl on counts that are made up: which part of their lanes' steps groups of 8 x 4 pixels wait. */
#include "tests/support/test_gpu.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 32, HEIGHT = 16, PIXELS = WIDTH * HEIGHT, SHADES = 256 };

typedef struct bench {
    test_gpu device;
    nook_texture counts, colours, image;
    nook_framebuffer target;
    uint32_t vertex_array;
    uint32_t steps[PIXELS];
    uint8_t shown[PIXELS][4];
} bench;

/** Shades of grey: red is the part of waiting, 255 all. */
static int setup(void **state)
{
    static bench b;
    static uint8_t shades[SHADES][4];
    assert_int_equal(test_gpu_create(NULL, &b.device), NOOK_OK);
    nook_gpu *gpu = b.device.gpu;
    for (int i = 0; i < SHADES; i++)
        shades[i][0] = shades[i][1] = shades[i][2] = (uint8_t)i;
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &b.counts), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, SHADES, 1, GL_NEAREST, &b.colours), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, WIDTH, HEIGHT, GL_NEAREST, &b.image), NOOK_OK);
    nook_texture_write(gpu, b.colours, GL_RGBA, GL_UNSIGNED_BYTE, shades, sizeof shades);
    assert_int_equal(nook_framebuffer_create(gpu, &b.image, 1, (nook_texture){ 0 }, &b.target), NOOK_OK);
    gpu->gl->CreateVertexArrays(1, &b.vertex_array);
    *state = &b;
    return 0;
}

static int teardown(void **state)
{
    bench *b = *state;
    nook_gpu *gpu = b->device.gpu;
    gpu->gl->DeleteVertexArrays(1, &b->vertex_array);
    nook_framebuffer_destroy(gpu, &b->target);
    nook_texture_destroy(gpu, &b->image);
    nook_texture_destroy(gpu, &b->colours);
    nook_texture_destroy(gpu, &b->counts);
    assert_false(nook_gpu_check(gpu, "the test"));
    test_gpu_destroy(&b->device);
    return 0;
}

static void show(bench *b, int32_t scale, const int32_t part[4])
{
    nook_gpu *gpu = b->device.gpu;
    nook_program program;
    nook_texture_write(gpu, b->counts, GL_RED_INTEGER, GL_UNSIGNED_INT, b->steps, sizeof b->steps);
    assert_int_equal(nook_program_raster(gpu, "shaders/render/fullscreen.vert.glsl",
                                         "shaders/live/divergence.frag.glsl", "", &program),
                     NOOK_OK);
    nook_framebuffer_bind(gpu, b->target);
    nook_program_use(gpu, program);
    nook_uniform_int(gpu, 0, &scale, 1);
    nook_uniform_int(gpu, 1, part, 4);
    nook_bind_texture(gpu, 0, b->counts);
    nook_bind_texture(gpu, 3, b->colours);
    gpu->gl->BindVertexArray(b->vertex_array);
    gpu->gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gpu->gl->BindVertexArray(0);
    gpu->gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    nook_texture_read(gpu, b->image, GL_RGBA, GL_UNSIGNED_BYTE, b->shown, sizeof b->shown);
}

/** @param waiting  part of the steps */
static void assert_shown(const bench *b, int x, int y, double waiting)
{
    assert_int_equal(b->shown[y * WIDTH + x][0], lround(255.0 * waiting));
}

static const int32_t whole[4] = { 0, 0, WIDTH, HEIGHT };

static void test_lanes_with_as_many_steps_wait_for_nobody(void **state)
{
    bench *b = *state;
    for (int i = 0; i < PIXELS; i++)
        b->steps[i] = i % WIDTH < 8 ? 0 : 48;
    show(b, 1, whole);
    for (int i = 0; i < PIXELS; i++)
        assert_int_equal(b->shown[i][0], 0);
}

static void test_all_lanes_of_a_group_wait_for_its_longest_and_no_other_group_does(void **state)
{
    bench *b = *state;
    memset(b->steps, 0, sizeof b->steps);
    b->steps[5 * WIDTH + 9] = 160;
    show(b, 1, whole);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++)
            assert_shown(b, x, y, x / 8 == 1 && y / 4 == 1 ? 31.0 / 32.0 : 0.0);
    }
}

static void test_half_as_many_steps_in_half_of_the_lanes_are_a_quarter_of_waiting(void **state)
{
    bench *b = *state;
    for (int i = 0; i < PIXELS; i++)
        b->steps[i] = i % WIDTH % 8 < 4 ? 32 : 64;
    show(b, 1, whole);
    for (int i = 0; i < PIXELS; i++)
        assert_shown(b, i % WIDTH, i / WIDTH, 0.25);
}

/** At half resolution a group covers 16 x 8 pixels, each four of which hold a share of one lane's steps. */
static void test_groups_grow_with_the_scale_of_the_trace(void **state)
{
    bench *b = *state;
    for (int i = 0; i < PIXELS; i++)
        b->steps[i] = i % WIDTH < 16 && i / WIDTH < 8 && i % WIDTH / 2 == 3 && i / WIDTH / 2 == 2 ? 40 : 0;
    show(b, 2, whole);
    assert_shown(b, 0, 0, 31.0 / 32.0);
    assert_shown(b, 15, 7, 31.0 / 32.0);
    assert_shown(b, 16, 0, 0.0);
    assert_shown(b, 0, 8, 0.0);
}

/** Lanes of a view beside it, with whatever they hold, are none of its group. */
static void test_lanes_outside_of_the_view_do_not_count(void **state)
{
    bench *b = *state;
    for (int i = 0; i < PIXELS; i++)
        b->steps[i] = i % WIDTH < 4 ? 1000 : 64;
    show(b, 1, (const int32_t[]){ 4, 0, WIDTH, HEIGHT });
    assert_shown(b, 4, 0, 0.0);
    show(b, 1, whole);
    assert_shown(b, 4, 0, 1.0 - 0.5 * (1000.0 + 64.0) / 1000.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lanes_with_as_many_steps_wait_for_nobody),
        cmocka_unit_test(test_all_lanes_of_a_group_wait_for_its_longest_and_no_other_group_does),
        cmocka_unit_test(test_half_as_many_steps_in_half_of_the_lanes_are_a_quarter_of_waiting),
        cmocka_unit_test(test_groups_grow_with_the_scale_of_the_trace),
        cmocka_unit_test(test_lanes_outside_of_the_view_do_not_count),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
