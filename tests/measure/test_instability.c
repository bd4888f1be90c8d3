#include "modules/measure/instability.h"
#include "tests/support/eye.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

/* At 90 degrees and 32 rows the picture of a wall 16 m away has pixels of 1 m. */
enum { SIDE = NOOK_EYE_SIDE, PIXELS = NOOK_EYE_PIXELS };
static const double wall_distance = 16.0;

static void set_visibility(nook_eye *e, float value)
{
    for (int i = 0; i < PIXELS; i++)
        e->visibility[i] = value;
}

/* Looks along -Z at the wall z = -16 from (x, y, z). */
static void face_wall(nook_eye *e, double x, double y, double z)
{
    nook_eye_face_wall(e, x, y, z, wall_distance + z);
    set_visibility(e, 1.0f);
}

static nook_match match(const nook_eye *first, const nook_eye *second)
{
    nook_match result;
    assert_int_equal(nook_match_create(&first->seen, &second->seen, &result), NOOK_OK);
    return result;
}

static nook_instability measure(const nook_eye *first, const nook_eye *second)
{
    nook_match matched = match(first, second);
    nook_instability result = nook_instability_measure(&matched, first->visibility, second->visibility);
    assert_true(result.pixels == matched.shared);
    nook_match_free(&matched);
    return result;
}

static void assert_near(double value, double truth, double tolerance)
{
    if (!(fabs(value - truth) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", value, tolerance, truth);
}

static unsigned next_random(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void test_a_camera_matched_with_itself_is_perfectly_steady(void **state)
{
    (void)state;
    static nook_eye e;
    unsigned seed = 20100712u;
    double eye_at[3] = { 3.7, -2.1, 9.3 }, target[3] = { 0.3, 1.9, -4.0 }, up[3] = { 0.0, 1.0, 0.0 };
    face_wall(&e, 0.0, 0.0, 0.0);
    e.seen.view_from_world = nook_matrix_look_at(eye_at, target, up);
    for (int i = 0; i < PIXELS; i++) { /* ragged: every pixel is a surface of its own */
        e.distances[i] = 0.1f + (float)(next_random(&seed) % 10000);
        e.visibility[i] = (float)(next_random(&seed) % 1000) / 999.0f;
    }
    nook_instability r = measure(&e, &e);
    assert_true(r.valid);
    assert_int_equal(r.pixels, PIXELS);
    assert_true(r.rms == 0.0 && r.relative == 0.0 && r.contrast > 0.1);
}

static void test_constant_change_is_the_instability(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 3.3, 0.0, 0.0);
    set_visibility(&first, 0.75f);
    set_visibility(&second, 0.25f);
    nook_instability r = measure(&first, &second);
    assert_true(r.valid && r.rms == 0.5);
    assert_int_equal(r.pixels, (SIDE - 4) * SIDE); /* the first 3.3 columns are left of the second picture */
    assert_true(r.contrast == 0.25);
    assert_near(r.relative, sqrt(2.0), 1e-12);
}

/* Visibility painted on the wall: linear, so that reading between pixels is exact. */
static void paint(nook_eye *e, double eye_x, double eye_y, double eye_z)
{
    double size = (wall_distance + eye_z) / wall_distance;
    for (int i = 0; i < PIXELS; i++) {
        double x = eye_x + (i % SIDE + 0.5 - 0.5 * SIDE) * size, y = eye_y + (i / SIDE + 0.5 - 0.5 * SIDE) * size;
        e->visibility[i] = (float)(0.5 + 0.01 * x - 0.005 * y);
    }
}

static void test_pattern_fixed_to_the_surface_is_steady(void **state)
{
    (void)state;
    static nook_eye first, second;
    static const double places[][3] = { { 5.0, 0.0, 0.0 }, { 2.25, -3.5, 0.0 }, { 0.0, 0.0, 4.0 }, { 1.3, 2.7, -5.9 } };
    face_wall(&first, 0.0, 0.0, 0.0);
    paint(&first, 0.0, 0.0, 0.0);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double *p = places[i];
        face_wall(&second, p[0], p[1], p[2]);
        paint(&second, p[0], p[1], p[2]);
        nook_instability r = measure(&first, &second);
        assert_true(r.valid && r.pixels > PIXELS / 4);
        assert_near(r.rms, 0.0, 0.02 / 256.0); /* places are rounded to 1/256 of a pixel */
        assert_true(r.relative < 0.001);
    }
}

static void test_pattern_fixed_to_the_picture_changes_by_its_slope_times_the_shift(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 6.0, 0.0, 0.0); /* six pixels */
    for (int i = 0; i < PIXELS; i++)
        first.visibility[i] = second.visibility[i] = (float)(i % SIDE) / 64.0f;
    nook_instability r = measure(&first, &second);
    assert_true(r.rms == 6.0 / 64.0);
    assert_int_equal(r.pixels, (SIDE - 6) * SIDE);
}

static void test_pictures_of_unrelated_noise_are_fully_unsteady_however_faint(void **state)
{
    (void)state;
    static nook_eye first, second;
    unsigned seed = 7u;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 2.0, 0.0, 0.0);
    for (int i = 0; i < PIXELS; i++) { /* 0.9 or 1 by a coin: standard deviation 0.05 */
        first.visibility[i] = next_random(&seed) & 512 ? 0.9f : 1.0f;
        second.visibility[i] = next_random(&seed) & 512 ? 0.9f : 1.0f;
    }
    nook_instability r = measure(&first, &second);
    assert_near(r.contrast, 0.05, 0.002);
    assert_near(r.rms, 0.05 * sqrt(2.0), 0.005);
    assert_near(r.relative, 1.0, 0.1);
}

static void test_what_a_nearer_object_hides_is_not_counted(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 4.0, 0.0, 0.0);
    set_visibility(&first, 0.5f);
    set_visibility(&second, 0.5f);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 10; x < 20; x++) {
            nook_eye_show(&second, x, y, 8.0, nook_eye_towards);
            second.visibility[y * SIDE + x] = 0.0f;
        }
    }
    nook_instability r = measure(&first, &second);
    assert_int_equal(r.pixels, (SIDE - 4 - 10) * SIDE);
    assert_true(r.rms == 0.0);
    r = measure(&second, &first); /* the object's own pixels: the first sees only the wall there */
    assert_int_equal(r.pixels, (SIDE - 4 - 10) * SIDE);
    assert_true(r.rms == 0.0);
}

static void test_reading_between_pixels_never_mixes_in_another_surface(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 0.5, 0.0, 0.0); /* every point lies between two columns */
    for (int y = 0; y < SIDE; y++) {
        nook_eye_show(&second, 12, y, 4.0, nook_eye_towards);
        second.visibility[y * SIDE + 12] = 0.0f;
    }
    nook_instability r = measure(&first, &second);
    assert_int_equal(r.pixels, (SIDE - 1 - 2) * SIDE);
    assert_true(r.rms == 0.0);
}

static void test_surfaces_that_face_elsewhere_are_others(void **state)
{
    (void)state;
    static nook_eye first, second;
    static const struct {
        double degrees;
        uint64_t pixels;
    } cases[] = { { 0.0, PIXELS }, { 25.0, PIXELS }, { 27.0, 0 }, { 90.0, 0 }, { 180.0, 0 } };
    face_wall(&first, 0.0, 0.0, 0.0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double angle = cases[i].degrees / 90.0 * nook_eye_fov;
        const double normal[3] = { sin(angle), 0.0, cos(angle) };
        face_wall(&second, 0.0, 0.0, 0.0);
        for (int p = 0; p < PIXELS; p++)
            nook_eye_show(&second, p % SIDE, p / SIDE, wall_distance, normal);
        assert_int_equal(measure(&first, &second).pixels, cases[i].pixels);
    }
}

static void test_tolerance_of_depth_is_a_footprint_and_grows_with_the_distance(void **state)
{
    (void)state;
    static nook_eye first, second;
    static const struct {
        double scale, offset; /* of the scene; metres behind the wall */
        uint64_t pixels;
    } cases[] = { { 1.0, 0.9, PIXELS }, { 1.0, 1.1, 0 }, { 100.0, 90.0, PIXELS }, { 100.0, 110.0, 0 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        face_wall(&first, 0.0, 0.0, 0.0);
        face_wall(&second, 0.0, 0.0, 0.0);
        for (int p = 0; p < PIXELS; p++) {
            first.distances[p] = (float)(wall_distance * cases[i].scale);
            second.distances[p] = (float)(wall_distance * cases[i].scale + cases[i].offset);
        }
        assert_int_equal(measure(&first, &second).pixels, cases[i].pixels);
    }
}

static void test_wall_seen_from_the_side_matches_along_its_plane(void **state)
{
    (void)state;
    static nook_eye first, second;
    double eye_at[3] = { 12.0, 0.0, -4.0 }, target[3] = { 0.0, 0.0, -16.0 }, up[3] = { 0.0, 1.0, 0.0 };
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 0.0, 0.0, 0.0);
    second.seen.view_from_world = nook_matrix_look_at(eye_at, target, up);
    nook_matrix world_from_second;
    nook_matrix_inverse_affine(&second.seen.view_from_world, &world_from_second);
    paint(&first, 0.0, 0.0, 0.0);
    for (int i = 0; i < PIXELS; i++) { /* the second camera's rays meet the wall */
        double ray[3] = { (i % SIDE + 0.5) / 16.0 - 1.0, (i / SIDE + 0.5) / 16.0 - 1.0, -1.0 };
        nook_matrix_apply_vector(&world_from_second, ray, ray);
        double t = ray[2] < -1e-6 ? (-wall_distance - eye_at[2]) / ray[2] : 0.0;
        second.distances[i] = (float)t;
        second.visibility[i] = (float)(0.5 + 0.01 * (eye_at[0] + t * ray[0]) - 0.005 * (eye_at[1] + t * ray[1]));
    }
    nook_instability r = measure(&first, &second);
    assert_true(r.valid && r.pixels > PIXELS / 8);
    assert_near(r.rms, 0.0, 0.002); /* what bilinear reading loses in perspective */
}

static void test_nothing_shared_is_said_and_is_no_number(void **state)
{
    (void)state;
    static nook_eye first, second;
    double eye_at[3] = { 0.0, 0.0, 0.0 }, behind[3] = { 0.0, 0.0, 1.0 }, up[3] = { 0.0, 1.0, 0.0 };
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 0.0, 0.0, 0.0);
    second.seen.view_from_world = nook_matrix_look_at(eye_at, behind, up);
    nook_match matched = match(&first, &second);
    assert_int_equal(matched.geometry, PIXELS);
    assert_int_equal(matched.shared, 0);
    nook_instability r = nook_instability_measure(&matched, first.visibility, second.visibility);
    nook_match_free(&matched);
    assert_false(r.valid);
    assert_int_equal(r.pixels, 0);
    assert_true(isnan(r.rms) && isnan(r.contrast) && isnan(r.relative));
}

static void test_pixels_without_geometry_are_not_shared(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 0.0, 0.0, 0.0);
    for (int i = 0; i < 100; i++)
        first.distances[i] = 0.0f;
    for (int i = 50; i < 200; i++)
        second.distances[i] = 0.0f;
    for (int i = 0; i < 200; i++)
        first.visibility[i] = second.visibility[i] = NAN;
    nook_match matched = match(&first, &second);
    assert_int_equal(matched.geometry, PIXELS - 100);
    nook_match_free(&matched);
    nook_instability r = measure(&first, &second);
    assert_true(r.valid);
    assert_int_equal(r.pixels, PIXELS - 200);
}

static void test_values_that_are_not_finite_make_the_result_invalid(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 0.5, 0.0, 0.0);
    second.visibility[5 * SIDE + 5] = NAN; /* read by two columns of the first */
    first.visibility[9 * SIDE + 9] = INFINITY;
    nook_instability r = measure(&first, &second);
    assert_false(r.valid);
    assert_int_equal(r.non_finite, 3);
    assert_true(isnan(r.rms) && isnan(r.relative));
}

static void test_constant_pictures_have_no_relative_instability(void **state)
{
    (void)state;
    static nook_eye first, second;
    face_wall(&first, 0.0, 0.0, 0.0);
    face_wall(&second, 1.0, 0.0, 0.0);
    nook_instability r = measure(&first, &second);
    assert_true(r.valid && r.rms == 0.0 && r.contrast == 0.0 && isnan(r.relative));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_camera_matched_with_itself_is_perfectly_steady),
        cmocka_unit_test(test_constant_change_is_the_instability),
        cmocka_unit_test(test_pattern_fixed_to_the_surface_is_steady),
        cmocka_unit_test(test_pattern_fixed_to_the_picture_changes_by_its_slope_times_the_shift),
        cmocka_unit_test(test_pictures_of_unrelated_noise_are_fully_unsteady_however_faint),
        cmocka_unit_test(test_what_a_nearer_object_hides_is_not_counted),
        cmocka_unit_test(test_reading_between_pixels_never_mixes_in_another_surface),
        cmocka_unit_test(test_surfaces_that_face_elsewhere_are_others),
        cmocka_unit_test(test_tolerance_of_depth_is_a_footprint_and_grows_with_the_distance),
        cmocka_unit_test(test_wall_seen_from_the_side_matches_along_its_plane),
        cmocka_unit_test(test_nothing_shared_is_said_and_is_no_number),
        cmocka_unit_test(test_pixels_without_geometry_are_not_shared),
        cmocka_unit_test(test_values_that_are_not_finite_make_the_result_invalid),
        cmocka_unit_test(test_constant_pictures_have_no_relative_instability),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
