/* shaders/ao/box_weight.glsl against rays through a grid on the unit disc. */
#include "engine/core/matrix.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { BOXES = 240, GRID = 300 };

/** struct Box of box_weight.comp.glsl. */
typedef struct box {
    float low[4], high[4], axes[3][4];
} box;

/** In [0, 1). */
static double next(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0;
}

/** Turned, stretched, sheared or mirrored axes; flat, long or cubic; near and far, above, across and below the plane. */
static box make_box(uint32_t *state, int i)
{
    const double half = 3.0 * next(state), length = next(state), none[3] = { 0, 0, 0 };
    const double rotation[4] = { sin(half) * length, 0.0, sin(half) * sqrt(1.0 - length * length), cos(half) };
    double scale[3], from[3];
    box b = { .axes = { { 0 } } };
    for (int axis = 0; axis < 3; axis++) {
        scale[axis] = (0.3 + next(state)) * (i % 5 == 0 && axis == 1 ? -1.0 : 1.0);
        double size = i % 3 == axis ? 0.05 + 0.2 * next(state) : 0.3 + 2.0 * next(state);
        from[axis] = (i % 4 == 0 ? 1.0 : 3.0) * (2.0 * next(state) - 1.0);
        b.low[axis] = (float)(from[axis] - 0.5 * size);
        b.high[axis] = (float)(from[axis] + 0.5 * size);
    }
    nook_matrix m = nook_matrix_compose(none, rotation, scale);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            b.axes[column][row] = (float)m.m[column * 4 + row];
    }
    if (i % 7 == 0)
        b.axes[2][0] += 0.5f;
    return b;
}

static bool is_inside(const box *b)
{
    bool inside = true;
    for (int axis = 0; axis < 3; axis++)
        inside = inside && b->low[axis] <= 0.0f && b->high[axis] >= 0.0f;
    return inside;
}

static bool is_met(const box *b, const double along[3])
{
    double enter = 0.0, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double x = (double)b->low[axis] / along[axis], y = (double)b->high[axis] / along[axis];
        enter = fmax(enter, fmin(x, y));
        leave = fmin(leave, fmax(x, y));
    }
    return enter < leave;
}

static double count_rays(const box *b)
{
    nook_matrix axes = nook_matrix_identity(), inverse;
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            axes.m[column * 4 + row] = (double)b->axes[column][row];
    }
    assert_true(nook_matrix_inverse_affine(&axes, &inverse));
    int met = 0, all = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        double x = (i % GRID + 0.5) / GRID * 2.0 - 1.0, y = ((double)(i / GRID) + 0.5) / GRID * 2.0 - 1.0;
        if (x * x + y * y >= 1.0)
            continue;
        double direction[3] = { x, y, sqrt(1.0 - x * x - y * y) };
        nook_matrix_apply_vector(&inverse, direction, direction);
        met += is_met(b, direction);
        all++;
    }
    return (double)met / all;
}

static void evaluate(nook_gpu *gpu, const box *boxes, float *weights, size_t count)
{
    test_gpu_map(gpu, "tests/ao/box_weight.comp.glsl", boxes, sizeof *boxes, weights, sizeof *weights, count);
}

static void test_a_box_takes_the_part_of_the_sky_in_which_rays_meet_it(void **state)
{
    box boxes[BOXES];
    float weights[BOXES];
    uint32_t seed = 1, hidden = 0, across = 0;
    for (int i = 0; i < BOXES; i++) {
        do
            boxes[i] = make_box(&seed, i);
        while (is_inside(&boxes[i]));
    }
    evaluate(test_gpu_of(state), boxes, weights, BOXES);
    for (int i = 0; i < BOXES; i++) {
        double counted = count_rays(&boxes[i]);
        hidden += counted == 0.0;
        across += counted > 0.2;
        if (!(fabs((double)weights[i] - counted) < 0.004))
            fail_msg("box %d: %.5f, rays say %.5f", i, (double)weights[i], counted);
    }
    print_message("%u of %u boxes are hidden, %u take more than a fifth\n", hidden, BOXES, across);
    assert_true(hidden > 5 && across > 5); /* some of each */
}

static void test_a_wide_ceiling_takes_it_all_and_a_floor_below_nothing(void **state)
{
    const box boxes[] = {
        { { -1e4f, -1e4f, 1 }, { 1e4f, 1e4f, 2 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
        { { -1e4f, -1e4f, -2 }, { 1e4f, 1e4f, -1 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
        { { 1, -1e4f, -1e4f }, { 2, 1e4f, 1e4f }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, /* a wall: half */
        { { -1, -1, 1 }, { 1, 1, 1.0001f }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },       /* a square */
    };
    /* A quarter of the square, a = 1 from its corner: (a / r atan(a / r) twice) / (2 pi), r = sqrt(1 + a^2). */
    const double square = 4.0 * 2.0 * sqrt(0.5) * atan(sqrt(0.5)) / (2.0 * 3.14159265358979);
    const double expected[] = { 1.0, 0.0, 0.5, square };
    float weights[NOOK_COUNT(boxes)];
    evaluate(test_gpu_of(state), boxes, weights, NOOK_COUNT(boxes));
    for (size_t i = 0; i < NOOK_COUNT(boxes); i++) {
        if (!(fabs((double)weights[i] - expected[i]) < 2e-4))
            fail_msg("box %zu: %.6f instead of %.6f", i, (double)weights[i], expected[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_box_takes_the_part_of_the_sky_in_which_rays_meet_it),
        cmocka_unit_test(test_a_wide_ceiling_takes_it_all_and_a_floor_below_nothing),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
