#include "engine/core/surface.h"
#include "engine/core/vector.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double step = 0.01; /* between neighbouring pixels, in tangents */

/** What the pixel in direction (x, y, -1) shows of a plane through `at`. */
static nook_surface_point on_plane(double x, double y, const double at[3], const double normal[3])
{
    double ray[3] = { x, y, -1.0 }, n[3] = { 0.0 };
    assert_true(nook_vector_normalize(normal, n));
    double distance = nook_vector_dot(at, n) / nook_vector_dot(ray, n);
    nook_surface_point p = { .position = { x * distance, y * distance, -distance }, .normal = { n[0], n[1], n[2] } };
    return p;
}

static unsigned next_random(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static double random_in(unsigned *seed, double low, double high)
{
    return low + (high - low) * next_random(seed) / 16777216.0;
}

/** A random plane through `at` whose front the eye sees. */
static void random_normal(unsigned *seed, const double at[3], double out[3])
{
    do {
        for (int axis = 0; axis < 3; axis++)
            out[axis] = random_in(seed, -1.0, 1.0);
    } while (!nook_vector_normalize(out, out));
    if (nook_vector_dot(out, at) > 0.0)
        nook_vector_add_scaled((double[3]){ 0 }, -1.0, out, out);
}

static void test_a_plane_is_one_surface_up_to_its_horizon(void **state)
{
    (void)state;
    const double floor_at[3] = { 0.0, -1.5, 0.0 }, up[3] = { 0.0, 1.0, 0.0 };
    for (double y = -1.0; y < -1.1 * step; y += step) { /* the last two are 100 and 136 m away */
        nook_surface_point a = on_plane(0.1, y, floor_at, up), b = on_plane(0.1, y + step, floor_at, up);
        assert_true(nook_surface_joins(&a, &b) && nook_surface_joins(&b, &a));
    }
}

/** Two planes that meet between two pixels: every edge and corner there is, seen from the front. */
static void test_two_planes_that_meet_between_pixels_are_one_surface(void **state)
{
    (void)state;
    unsigned seed = 20221107u;
    for (int i = 0; i < 100000; i++) {
        double x = random_in(&seed, -1.0, 1.0), y = random_in(&seed, -1.0, 1.0), where = random_in(&seed, 0.0, 1.0);
        double distance = random_in(&seed, 0.1, 50.0), normal_a[3], normal_b[3];
        double meeting[3] = { (x + where * step) * distance, y * distance, -distance };
        random_normal(&seed, meeting, normal_a);
        random_normal(&seed, meeting, normal_b);
        nook_surface_point a = on_plane(x, y, meeting, normal_a), b = on_plane(x + step, y, meeting, normal_b);
        if (!(a.position[2] < 0.0 && b.position[2] < 0.0))
            continue; /* past the horizon of its plane: that pixel shows something else */
        if (!nook_surface_joins(&a, &b))
            fail_msg("turn %d: cut at an edge", i);
    }
}

static nook_surface_point on_ball(double x, double y, const double centre[3], double radius)
{
    double ray[3] = { x, y, -1.0 }, along = nook_vector_dot(ray, centre), square = nook_vector_dot(ray, ray);
    double rest = along * along - square * (nook_vector_dot(centre, centre) - radius * radius);
    double distance = rest > 0.0 ? (along - sqrt(rest)) / square : -1.0;
    nook_surface_point p = { .position = { x * distance, y * distance, -distance } };
    for (int axis = 0; axis < 3; axis++)
        p.normal[axis] = (p.position[axis] - centre[axis]) / radius;
    return p;
}

/** What stands edge-on foretells anything behind it: of the limb's pixels the outermost few in a hundred. */
static void test_a_ball_is_one_surface_up_to_its_limb_and_ends_there(void **state)
{
    (void)state;
    const double centre[3] = { 0.7, 0.3, -6.0 }, wall_at[3] = { 0.0, 0.0, -12.0 }, towards[3] = { 0.0, 0.0, 1.0 };
    int inner = 0, limbs = 0, joined = 0;
    for (double y = -0.5; y < 0.5; y += 0.37 * step) {
        for (double x = -0.5; x < 0.5; x += step) {
            nook_surface_point a = on_ball(x, y, centre, 1.0), b = on_ball(x + step, y, centre, 1.0);
            bool seen_a = a.position[2] < 0.0, seen_b = b.position[2] < 0.0;
            if (!seen_a && !seen_b)
                continue;
            if (!seen_a)
                a = on_plane(x, y, wall_at, towards);
            if (!seen_b)
                b = on_plane(x + step, y, wall_at, towards);
            bool one = nook_surface_joins(&a, &b);
            assert_true(one || !(seen_a && seen_b));
            inner += seen_a && seen_b, limbs += seen_a != seen_b, joined += one && seen_a != seen_b;
        }
    }
    assert_true(inner > 1000 && limbs > 100);
    if (joined * 20 > limbs)
        fail_msg("%d of %d pixels of the limb are joined with the wall", joined, limbs);
}

static void test_walls_facing_the_camera_part_at_a_step_of_one_pixel(void **state)
{
    (void)state;
    const double towards[3] = { 0.0, 0.0, 1.0 };
    for (double pixels = 0.25; pixels < 8.0; pixels *= 2.0) {
        double behind[3] = { 0.0, 0.0, -(10.0 + 0.99 * pixels * 10.0 * step) }, before[3] = { 0.0, 0.0, -10.0 };
        nook_surface_point a = on_plane(0.0, 0.0, before, towards), b = on_plane(step, 0.0, behind, towards);
        assert_true(nook_surface_joins(&a, &b) == (pixels <= 1.0));
        assert_true(nook_surface_joins(&b, &a) == (pixels <= 1.0));
    }
}

static void test_rounding_of_depth_is_no_gap_however_small_the_pixels(void **state)
{
    (void)state;
    const double distance = 1000.0;
    nook_surface_point a = { .position = { 0.0, 0.0, -distance }, .normal = { 0.0, 0.0, 1.0 } };
    nook_surface_point b = { .position = { 1e-7, 0.0, -distance * (1.0 + 1e-6) }, .normal = { 0.0, 0.0, 1.0 } };
    assert_true(nook_surface_joins(&a, &b));
    b.position[2] = -distance * (1.0 + 1e-5);
    assert_false(nook_surface_joins(&a, &b));
}

static void test_what_is_not_a_number_joins_nothing(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        nook_surface_point a = { .position = { 0.0, 0.0, -1.0 }, .normal = { 0.0, 0.0, 1.0 } }, b = a;
        *(i < 3 ? &a.position[i] : &a.normal[i - 3]) = NAN;
        *(i < 3 ? &b.position[i] : &b.normal[i - 3]) = NAN;
        assert_false(nook_surface_joins(&a, &b));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_plane_is_one_surface_up_to_its_horizon),
        cmocka_unit_test(test_two_planes_that_meet_between_pixels_are_one_surface),
        cmocka_unit_test(test_a_ball_is_one_surface_up_to_its_limb_and_ends_there),
        cmocka_unit_test(test_walls_facing_the_camera_part_at_a_step_of_one_pixel),
        cmocka_unit_test(test_rounding_of_depth_is_no_gap_however_small_the_pixels),
        cmocka_unit_test(test_what_is_not_a_number_joins_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
