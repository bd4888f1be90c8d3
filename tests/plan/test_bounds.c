/* The planner's bounds against closed forms and against counted rays. */
#include "modules/ao/sampling.h"
#include "modules/plan/bounds.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

static void test_a_sphere_overhead_takes_its_bound_and_one_aside_takes_less(void **state)
{
    (void)state;
    /* A sphere of radius r, its centre l away at an angle whose cosine is c, above the horizon: c r^2 / l^2. */
    for (double l = 1.1; l < 20.0; l *= 1.3) {
        double bound = nook_plan_sphere_bound(1.0, l - 1.0);
        assert_true(fabs(bound - 1.0 / (l * l)) < 1e-12);
        for (double c = 1.0 / l; c <= 1.0; c += 0.05)
            assert_true(c / (l * l) <= bound);
    }
    assert_true(nook_plan_sphere_bound(1.0, 0.0) == 1.0);
    assert_true(nook_plan_sphere_bound(1.0, -0.5) == 1.0);
}

/* What a rectangle a x b takes that lies parallel to a floor, one corner c above a point of it. */
static double rectangle(double a, double b, double c)
{
    double x = a / c, y = b / c, u = sqrt(1.0 + x * x), v = sqrt(1.0 + y * y);
    return (x / u * atan(y / u) + y / v * atan(x / v)) / (2.0 * pi);
}

static void test_no_plate_overhead_takes_more_than_the_bound_of_its_faces(void **state)
{
    (void)state;
    double tightest = 0.0;
    for (double side = 0.01; side < 8.0; side *= 1.5)
        for (double other = 0.01; other < 8.0; other *= 1.5)
            for (double height = 0.05; height < 10.0; height *= 1.4) {
                const nook_plan_box plate = { { -side, height, -other }, { side, height, other } };
                double taken = 4.0 * rectangle(side, other, height), bound = nook_plan_face_bound(&plate, height);
                assert_true(taken <= bound);
                tightest = fmax(tightest, taken / bound);
            }
    assert_true(tightest > 0.999); /* it is not a bound of just anything: small plates take all of it */
}

static void test_gaps_are_between_nearest_points(void **state)
{
    (void)state;
    const nook_plan_box a = { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
    const nook_plan_box beside = { { 4.0, 0.5, 0.5 }, { 5.0, 2.0, 2.0 } },
                        across = { { 4.0, 5.0, -1.0 }, { 9.0, 9.0, 9.0 } };
    const nook_plan_box inside = { { 0.2, 0.2, 0.2 }, { 0.3, 0.3, 0.3 } };
    const double point[3] = { 2.0, 0.5, -1.0 };
    assert_true(nook_plan_box_gap(&a, &beside) == 3.0);
    assert_true(nook_plan_box_gap(&across, &a) == 5.0);
    assert_true(nook_plan_box_gap(&a, &inside) == 0.0);
    assert_true(fabs(nook_plan_point_gap(&a, point) - sqrt(2.0)) < 1e-15);
    nook_plan_box grown = nook_plan_box_grow(&a, 0.5);
    assert_true(nook_plan_box_gap(&grown, &beside) == 2.5);
}

/* ---- Rays of a picture ------------------------------------------------------------------------------------------ */

enum { RAYS = 64, BLOCKS = NOOK_DIRECTION_BLOCKS };

/* The largest share of a block's rays in cones around many directions. */
static double counted_share(const float *directions, double sine)
{
    double cosine = sqrt(1.0 - sine * sine);
    uint32_t most = 0;
    for (int axis = 0; axis < 4000; axis++) {
        float point[2], d[3];
        nook_sobol_point((uint32_t)axis, 77, point);
        nook_cosine_direction(point, d);
        for (int block = 0; block < BLOCKS; block++) {
            uint32_t count = 0;
            for (int i = 0; i < RAYS; i++) {
                const float *r = directions + (size_t)(block * RAYS + i) * 4;
                count += (double)r[0] * d[0] + (double)r[1] * d[1] + (double)r[2] * d[2] >= cosine;
            }
            most = count > most ? count : most;
        }
    }
    return (double)most / RAYS;
}

static void test_no_cone_holds_more_rays_than_the_share_says(void **state)
{
    (void)state;
    float directions[BLOCKS * RAYS * 4];
    nook_fill_directions(RAYS, 0, 0, directions);
    double before = 0.0;
    for (double sine = 0.02; sine < 0.75; sine *= 1.5) {
        double share = nook_plan_ray_share(directions, BLOCKS, RAYS, sine), counted = counted_share(directions, sine);
        assert_true(counted <= share);
        assert_true(share >= 1.0 / RAYS); /* some ray is there, wherever the cone is */
        assert_true(share >= before);
        before = share;
    }
    assert_true(nook_plan_ray_share(directions, BLOCKS, RAYS, 0.8) == 1.0);
    assert_true(nook_plan_ray_share(directions, BLOCKS, RAYS, 0.1) < 0.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sphere_overhead_takes_its_bound_and_one_aside_takes_less),
        cmocka_unit_test(test_no_plate_overhead_takes_more_than_the_bound_of_its_faces),
        cmocka_unit_test(test_gaps_are_between_nearest_points),
        cmocka_unit_test(test_no_cone_holds_more_rays_than_the_share_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
