#include "engine/core/matrix.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

static void assert_near(double actual, double expected, double tolerance)
{
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", actual, tolerance, expected);
}

static void assert_vector_near(const double actual[3], double x, double y, double z)
{
    assert_near(actual[0], x, 1e-12);
    assert_near(actual[1], y, 1e-12);
    assert_near(actual[2], z, 1e-12);
}

static void assert_matrix_near(const nook_matrix *actual, const nook_matrix *expected, double tolerance)
{
    for (int i = 0; i < 16; i++)
        assert_near(actual->m[i], expected->m[i], tolerance);
}

/** The next number in [-1, 1) of a fixed sequence. */
static double next_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

/** Any shear, rotation, mirroring and scale, away from singular, with a translation of up to 1000. */
static nook_matrix random_affine(uint64_t *seed)
{
    nook_matrix a;
    do {
        a = nook_matrix_identity();
        for (int column = 0; column < 4; column++) {
            for (int row = 0; row < 3; row++)
                a.m[column * 4 + row] = next_random(seed) * (column == 3 ? 1000.0 : 3.0);
        }
    } while (fabs(nook_matrix_determinant3(&a)) < 0.5);
    return a;
}

static void test_matrix_translation_moves_points_and_leaves_vectors(void **state)
{
    (void)state;
    const nook_matrix move = nook_matrix_translation(1, -2, 3);
    const double p[3] = { 10, 20, 30 };
    double out[3];
    nook_matrix_apply_point(&move, p, out);
    assert_vector_near(out, 11, 18, 33);
    nook_matrix_apply_vector(&move, p, out);
    assert_vector_near(out, 10, 20, 30);
}

static void test_matrix_stores_columns_one_after_another(void **state)
{
    (void)state;
    const nook_matrix move = nook_matrix_translation(5, 6, 7);
    assert_true(move.m[12] == 5 && move.m[13] == 6 && move.m[14] == 7 && move.m[15] == 1);
    assert_true(move.m[3] == 0 && move.m[7] == 0 && move.m[11] == 0);
}

static void test_matrix_apply_allows_the_input_as_output(void **state)
{
    (void)state;
    const double quarter_about_z[4] = { 0, 0, sqrt(0.5), sqrt(0.5) }, none[3] = { 0, 0, 0 }, one[3] = { 1, 1, 1 };
    const nook_matrix turn = nook_matrix_compose(none, quarter_about_z, one);
    double p[3] = { 1, 2, 3 };
    nook_matrix_apply_point(&turn, p, p);
    assert_vector_near(p, -2, 1, 3);
}

static void test_matrix_compose_scales_then_turns_then_moves(void **state)
{
    (void)state;
    const double translation[3] = { 100, 0, 0 }, quarter_about_y[4] = { 0, sqrt(0.5), 0, sqrt(0.5) };
    const double scale[3] = { 2, 3, 4 }, corner[3] = { 1, 1, 1 };
    const nook_matrix a = nook_matrix_compose(translation, quarter_about_y, scale);
    double out[3];
    nook_matrix_apply_point(&a, corner, out); /* (2, 3, 4), turned to (4, 3, -2) */
    assert_vector_near(out, 104, 3, -2);
    assert_near(nook_matrix_determinant3(&a), 24, 1e-12);
}

static void test_matrix_compose_turns_about_each_axis_by_the_right_hand(void **state)
{
    (void)state;
    const double none[3] = { 0, 0, 0 }, one[3] = { 1, 1, 1 }, h = sqrt(0.5);
    for (int axis = 0; axis < 3; axis++) {
        double rotation[4] = { 0, 0, 0, h }, from[3] = { 0, 0, 0 }, out[3];
        rotation[axis] = h;
        from[(axis + 1) % 3] = 1;
        const nook_matrix turn = nook_matrix_compose(none, rotation, one);
        nook_matrix_apply_vector(&turn, from, out);
        assert_vector_near(out, axis == 1, axis == 2, axis == 0);
    }
}

static void test_matrix_multiply_applies_the_second_first(void **state)
{
    (void)state;
    const nook_matrix scale = nook_matrix_scale(2, 2, 2), move = nook_matrix_translation(1, 0, 0);
    const nook_matrix moved_first = nook_matrix_multiply(&scale, &move);
    const nook_matrix scaled_first = nook_matrix_multiply(&move, &scale);
    const double p[3] = { 3, 0, 0 };
    double out[3];
    nook_matrix_apply_point(&moved_first, p, out);
    assert_vector_near(out, 8, 0, 0);
    nook_matrix_apply_point(&scaled_first, p, out);
    assert_vector_near(out, 7, 0, 0);
}

static void test_matrix_product_acts_like_its_factors_in_turn(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 100; i++) {
        const nook_matrix a = random_affine(&seed), b = random_affine(&seed), ab = nook_matrix_multiply(&a, &b);
        const double p[3] = { next_random(&seed), next_random(&seed), next_random(&seed) };
        double one_by_one[3], at_once[3];
        nook_matrix_apply_point(&b, p, one_by_one);
        nook_matrix_apply_point(&a, one_by_one, one_by_one);
        nook_matrix_apply_point(&ab, p, at_once);
        for (int k = 0; k < 3; k++)
            assert_near(at_once[k], one_by_one[k], 1e-9);
        assert_near(nook_matrix_determinant3(&ab), nook_matrix_determinant3(&a) * nook_matrix_determinant3(&b), 1e-9);
    }
}

static void test_matrix_inverse_undoes_mirrored_sheared_and_uneven_matrices(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const nook_matrix identity = nook_matrix_identity();
    int mirrored = 0;
    for (int i = 0; i < 500; i++) {
        const nook_matrix a = random_affine(&seed);
        nook_matrix inverse;
        assert_int_equal(nook_matrix_inverse_affine(&a, &inverse), 1);
        const nook_matrix left = nook_matrix_multiply(&inverse, &a), right = nook_matrix_multiply(&a, &inverse);
        assert_matrix_near(&left, &identity, 1e-9); /* translations of 1000 times elements of up to 36 */
        assert_matrix_near(&right, &identity, 1e-9);
        mirrored += nook_matrix_determinant3(&a) < 0;
    }
    assert_in_range(mirrored, 100, 400);
}

static void test_longest_axis_is_the_largest_scale_whatever_turns_and_moves(void **state)
{
    (void)state;
    const double translation[3] = { 100, 200, 300 }, turn[4] = { 0, sqrt(0.5), 0, sqrt(0.5) },
                 scale[3] = { 2, -7, 0.5 };
    const nook_matrix a = nook_matrix_compose(translation, turn, scale);
    assert_true(fabs(nook_matrix_longest_axis(&a) - 7.0) < 1e-12);
}

static void test_matrix_inverse_of_uneven_scale_is_its_reciprocal(void **state)
{
    (void)state;
    const nook_matrix a = nook_matrix_scale(-1e-3, 2, 1e6), expected = nook_matrix_scale(-1e3, 0.5, 1e-6);
    nook_matrix inverse;
    assert_int_equal(nook_matrix_inverse_affine(&a, &inverse), 1);
    assert_matrix_near(&inverse, &expected, 1e-9);
}

static void test_matrix_inverse_refuses_singular_and_not_finite_matrices(void **state)
{
    (void)state;
    const nook_matrix identity = nook_matrix_identity();
    nook_matrix bad[4] = { nook_matrix_scale(1, 0, 1), nook_matrix_scale(NAN, 1, 1), nook_matrix_scale(1, INFINITY, 1),
                           nook_matrix_translation(0, INFINITY, 0) };
    for (int i = 0; i < 4; i++) {
        nook_matrix out = nook_matrix_scale(9, 9, 9);
        assert_int_equal(nook_matrix_inverse_affine(&bad[i], &out), 0);
        assert_memory_equal(&out, &identity, sizeof out);
    }
}

static void test_matrix_survives_the_way_to_float_and_back(void **state)
{
    (void)state;
    const nook_matrix a = nook_matrix_translation(0.5, -1024, 0.0625);
    float as_float[16];
    nook_matrix_to_float(&a, as_float);
    const nook_matrix back = nook_matrix_from_float(as_float);
    assert_memory_equal(&back, &a, sizeof a);
}

static void test_matrix_look_at_puts_the_target_ahead_and_up_above(void **state)
{
    (void)state;
    const double eye[3] = { 1, 2, 3 }, target[3] = { 4, 2, -1 }, up[3] = { 0, 1, 0 }, above[3] = { 1, 5, 3 };
    const nook_matrix view = nook_matrix_look_at(eye, target, up);
    double out[3];
    nook_matrix_apply_point(&view, eye, out);
    assert_vector_near(out, 0, 0, 0);
    nook_matrix_apply_point(&view, target, out);
    assert_vector_near(out, 0, 0, -5);
    nook_matrix_apply_point(&view, above, out);
    assert_vector_near(out, 0, 3, 0);
    assert_near(nook_matrix_determinant3(&view), 1, 1e-12); /* a rotation: no scale, no mirror */
}

/** Clip coordinates of a view position, (x, y, z, w). */
static void project(const nook_matrix *clip_from_view, double x, double y, double z, double out[4])
{
    for (int row = 0; row < 4; row++) {
        const double *m = clip_from_view->m + row;
        out[row] = m[0] * x + m[4] * y + m[8] * z + m[12];
    }
}

static void test_matrix_perspective_has_depth_one_near_and_zero_far(void **state)
{
    (void)state;
    const nook_matrix clip = nook_matrix_perspective_reversed(1.0, 2.0, 0.1);
    double near_point[4], far_point[4];
    project(&clip, 0, 0, -0.1, near_point);
    assert_near(near_point[2] / near_point[3], 1.0, 1e-12);
    project(&clip, 0, 0, -1e9, far_point);
    assert_near(far_point[2] / far_point[3], 0.0, 1e-9);
    assert_true(far_point[2] > 0.0);
}

static void test_matrix_perspective_fills_the_field_of_view(void **state)
{
    (void)state;
    const double fov = 1.2, aspect = 16.0 / 9.0, height = 7.0 * tan(0.5 * fov);
    const nook_matrix clip = nook_matrix_perspective_reversed(fov, aspect, 0.1);
    double corner[4];
    project(&clip, height * aspect, height, -7.0, corner);
    assert_near(corner[0] / corner[3], 1.0, 1e-12);
    assert_near(corner[1] / corner[3], 1.0, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_matrix_translation_moves_points_and_leaves_vectors),
        cmocka_unit_test(test_matrix_stores_columns_one_after_another),
        cmocka_unit_test(test_matrix_apply_allows_the_input_as_output),
        cmocka_unit_test(test_matrix_compose_scales_then_turns_then_moves),
        cmocka_unit_test(test_matrix_compose_turns_about_each_axis_by_the_right_hand),
        cmocka_unit_test(test_matrix_multiply_applies_the_second_first),
        cmocka_unit_test(test_matrix_product_acts_like_its_factors_in_turn),
        cmocka_unit_test(test_matrix_inverse_undoes_mirrored_sheared_and_uneven_matrices),
        cmocka_unit_test(test_longest_axis_is_the_largest_scale_whatever_turns_and_moves),
        cmocka_unit_test(test_matrix_inverse_of_uneven_scale_is_its_reciprocal),
        cmocka_unit_test(test_matrix_inverse_refuses_singular_and_not_finite_matrices),
        cmocka_unit_test(test_matrix_survives_the_way_to_float_and_back),
        cmocka_unit_test(test_matrix_look_at_puts_the_target_ahead_and_up_above),
        cmocka_unit_test(test_matrix_perspective_has_depth_one_near_and_zero_far),
        cmocka_unit_test(test_matrix_perspective_fills_the_field_of_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
