/* reference.sampling = tile: the rays and the filter of the techniques that march volumes, cast against the triangles. */
#include "tests/support/ao_view.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 64, PIXELS = SIDE * SIDE };

/** A floor, a wall and a box, as triangles and as surfels. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(SIDE, SIDE);
    ao_view_add_yard(view, 4.0, 256);
    ao_view_param(view, "ao.falloff", "hard");
    ao_view_param(view, "ao.r_max", "1.5");
    ao_view_param(view, "volume.kind", "surfel");
    *state = view;
    return 0;
}

static void record(nook_fixture_view *view, const char *technique, const char *rays, const char *sampling,
                   const char *filter, float out[PIXELS])
{
    ao_view_param(view, "reference.rays", rays);
    ao_view_param(view, "reference.sampling", sampling);
    ao_view_param(view, "volume.rays", rays);
    ao_view_param(view, "ao.filter", filter);
    ao_view_record(view, technique);
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

static double rmse(const float *picture, const float *truth)
{
    return ao_view_rmse(picture, truth, PIXELS);
}

static uint32_t count_apart(const float a[PIXELS], const float b[PIXELS])
{
    uint32_t apart = 0;
    for (size_t i = 0; i < PIXELS; i++)
        apart += a[i] != b[i];
    return apart;
}

static void test_tile_sampling_casts_the_very_ray_that_a_volume_marches_in_every_pixel(void **state)
{
    static float traced[PIXELS], marched[PIXELS], own[PIXELS];
    record(*state, "volume", "1", "tile", "none", marched); /* one ray: open or not */
    record(*state, "reference", "1", "tile", "none", traced);
    record(*state, "reference", "1", "pixel", "none", own);
    if (count_apart(traced, marched) > PIXELS / 50) /* where one grazes an edge */
        fail_msg("%u of %u pixels are not what the volume sees", count_apart(traced, marched), PIXELS);
    assert_true(count_apart(own, marched) > PIXELS / 10);
}

static void test_tile_sampling_goes_through_the_filter_and_the_truth_does_not(void **state)
{
    static float truth[PIXELS], bare[PIXELS], filtered[PIXELS], unfiltered[PIXELS];
    record(*state, "reference", "1024", "pixel", "tile", truth);
    record(*state, "reference", "1024", "pixel", "none", bare);
    assert_int_equal(count_apart(truth, bare), 0);
    record(*state, "reference", "16", "tile", "none", unfiltered);
    record(*state, "reference", "16", "tile", "tile", filtered);
    double without = rmse(unfiltered, truth), with = rmse(filtered, truth);
    if (!(with < 0.7 * without))
        fail_msg("RMSE %.4f, filtered %.4f", without, with);
}

static void test_surfels_of_open_boxes_are_as_right_as_the_same_rays_against_triangles(void **state)
{
    static float truth[PIXELS], traced[PIXELS], marched[PIXELS];
    record(*state, "reference", "1024", "pixel", "tile", truth);
    record(*state, "reference", "16", "tile", "tile", traced);
    record(*state, "volume", "16", "tile", "tile", marched);
    double rays = rmse(traced, truth), surfels = rmse(marched, truth);
    if (!(surfels < 1.25 * rays && rays < 1.25 * surfels))
        fail_msg("RMSE of rays %.5f, of surfels %.5f", rays, surfels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tile_sampling_casts_the_very_ray_that_a_volume_marches_in_every_pixel),
        cmocka_unit_test(test_tile_sampling_goes_through_the_filter_and_the_truth_does_not),
        cmocka_unit_test(test_surfels_of_open_boxes_are_as_right_as_the_same_rays_against_triangles),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
