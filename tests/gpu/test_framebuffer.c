#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

enum { WIDTH = 24, HEIGHT = 16 };

typedef struct targets {
    nook_texture colour, id, depth;
    nook_framebuffer framebuffer;
} targets;

static void create_targets(nook_gpu *gpu, targets *out)
{
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, WIDTH, HEIGHT, GL_NEAREST, &out->colour), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &out->id), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT, GL_NEAREST, &out->depth),
                     NOOK_OK);
    const nook_texture colours[] = { out->colour, out->id };
    assert_int_equal(nook_framebuffer_create(gpu, colours, 2, out->depth, &out->framebuffer), NOOK_OK);
}

static void destroy_targets(nook_gpu *gpu, targets *self)
{
    nook_framebuffer_destroy(gpu, &self->framebuffer);
    nook_texture_destroy(gpu, &self->colour);
    nook_texture_destroy(gpu, &self->id);
    nook_texture_destroy(gpu, &self->depth);
    assert_int_equal(self->framebuffer.id, 0);
}

/* A triangle over the left half of the target, x in [-1, 0], at one depth. */
static void draw_half(nook_gpu *gpu, nook_program program, float depth, uint32_t id)
{
    nook_program_use(gpu, program);
    nook_uniform_float(gpu, 0, &depth, 1);
    nook_uniform_uint(gpu, 1, &id, 1);
    gpu->gl->DrawArrays(GL_TRIANGLES, 0, 6);
}

/* Reversed Z: depth 1 is near, and floats keep apart what lies at 1e-6, 2e-6 and 3e-6. */
static void test_draws_fill_several_targets_and_the_nearest_stays(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    const nook_gl *gl = gpu->gl;
    const float black[4] = { 0, 0, 0, 0 }, far_depth = 0;
    const uint32_t none[4] = { 0, 0, 0, 0 };
    static const struct {
        float depth;
        uint32_t id;
    } draws[] = { { 1e-6f, 10 }, { 3e-6f, 30 }, { 2e-6f, 20 } };
    uint8_t colour[HEIGHT][WIDTH][4];
    uint32_t ids[HEIGHT][WIDTH];
    float depth[HEIGHT][WIDTH];
    GLuint vertices = 0;
    targets target;
    nook_program program;
    assert_int_equal(
        nook_program_raster(gpu, "tests/gpu/shaders/half.vert.glsl", "tests/gpu/shaders/half.frag.glsl", "", &program),
        NOOK_OK);
    create_targets(gpu, &target);
    gl->CreateVertexArrays(1, &vertices);
    gl->BindVertexArray(vertices);
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    nook_framebuffer_bind(gpu, target.framebuffer);
    gl->ClearNamedFramebufferfv(target.framebuffer.id, GL_COLOR, 0, black);
    gl->ClearNamedFramebufferuiv(target.framebuffer.id, GL_COLOR, 1, none);
    gl->ClearNamedFramebufferfv(target.framebuffer.id, GL_DEPTH, 0, &far_depth);
    nook_program_use(gpu, program);
    for (size_t i = 0; i < NOOK_COUNT(draws); i++)
        draw_half(gpu, program, draws[i].depth, draws[i].id);
    nook_texture_read(gpu, target.colour, GL_RGBA, GL_UNSIGNED_BYTE, colour, sizeof colour);
    nook_texture_read(gpu, target.id, GL_RED_INTEGER, GL_UNSIGNED_INT, ids, sizeof ids);
    nook_texture_read(gpu, target.depth, GL_DEPTH_COMPONENT, GL_FLOAT, depth, sizeof depth);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool inside = x < WIDTH / 2;
            assert_int_equal(ids[y][x], inside ? 30 : 0);
            assert_int_equal(colour[y][x][0], inside ? 30 : 0);
            assert_true(inside ? depth[y][x] > 2.9e-6f && depth[y][x] < 3.1e-6f : !(depth[y][x] > 0));
        }
    gl->DeleteVertexArrays(1, &vertices);
    destroy_targets(gpu, &target);
}

static void test_framebuffer_may_have_depth_alone(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    nook_texture depth;
    nook_framebuffer framebuffer;
    assert_int_equal(nook_texture_create_2d(gpu, GL_DEPTH_COMPONENT32F, 8, 4, GL_NEAREST, &depth), NOOK_OK);
    assert_int_equal(nook_framebuffer_create(gpu, NULL, 0, depth, &framebuffer), NOOK_OK);
    assert_int_equal(framebuffer.width, 8);
    assert_int_equal(framebuffer.height, 4);
    nook_framebuffer_destroy(gpu, &framebuffer);
    nook_texture_destroy(gpu, &depth);
}

static void test_framebuffer_create_refuses_what_does_not_fit(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    nook_texture small, large, compressed, many[9] = { { 0 } };
    nook_framebuffer framebuffer = { .id = 77 };
    nook_log_capture log;
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, 4, 4, GL_NEAREST, &small), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, 8, 4, GL_NEAREST, &large), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_COMPRESSED_RED_RGTC1, 4, 4, GL_NEAREST, &compressed), NOOK_OK);
    const nook_texture pair[] = { small, large }, none = { 0 };
    nook_log_capture_begin(&log);
    nook_result nothing = nook_framebuffer_create(gpu, NULL, 0, none, &framebuffer);
    nook_result too_many = nook_framebuffer_create(gpu, many, 9, none, &framebuffer);
    nook_result unequal = nook_framebuffer_create(gpu, pair, 2, none, &framebuffer);
    nook_result format = nook_framebuffer_create(gpu, &compressed, 1, none, &framebuffer);
    nook_log_capture_end();
    assert_int_equal(nothing, NOOK_E_RANGE);
    assert_int_equal(too_many, NOOK_E_RANGE);
    assert_int_equal(unequal, NOOK_E_RANGE);
    assert_int_equal(format, NOOK_E_DEVICE);
    assert_int_equal(framebuffer.id, 77);
    assert_int_equal(log.count, 4);
    nook_texture_destroy(gpu, &small);
    nook_texture_destroy(gpu, &large);
    nook_texture_destroy(gpu, &compressed);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, test_gpu_setup, test_gpu_teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_draws_fill_several_targets_and_the_nearest_stays),
        TEST(test_framebuffer_may_have_depth_alone),
        TEST(test_framebuffer_create_refuses_what_does_not_fit),
    };
    return cmocka_run_group_tests_name("framebuffers", tests, NULL, NULL);
}
