/* nook_ao_frame.counts = NOOK_AO_COUNTS_STEPS: turns of the loops in which rays are followed, pixel by pixel. */
#include "modules/ao_volume/limits.def"
#include "tests/support/ao_view.h"
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT, UNIT = NOOK_AO_FETCH_UNITS, RAYS = 4, STEPS = 7 };
enum { LINE = 28 + 28 + 28 }; /* voxels: the volume of a box of 24, whole bricks of surfels */
/* Of a pixel whatever its rays do: depth and normal when they are prepared, and again when it is traced. */
enum { PREPARED = 4 * UNIT, DIRECTIONS = RAYS * UNIT };

static const char *const one_fetch_a_step[] = { "binary", "density", "distance" };

/** A wall that fills the picture, and a box in front of its left half. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    nook_fixture_mesh box = { 0 };
    nook_fixture_add_box(&box, (double[]){ -0.6, -0.3, -1.8 }, (double[]){ -0.2, 0.3, -1.4 }, 63);
    for (uint32_t i = 0; i < PIXELS; i++)
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 2.0, (double[]){ 0, 0, 1 });
    ao_view_add(view, &box, 24);
    nook_fixture_mesh_free(&box);
    ao_view_param(view, "ao.filter", "none");
    ao_view_param(view, "ao.r_max", "0.5");
    ao_view_param(view, "volume.rays", "4");
    ao_view_param(view, "volume.steps", "7");
    ao_view_param(view, "volume.stepping", "fixed");
    *state = view;
    return 0;
}

static void count(nook_fixture_view *view, const char *technique, uint32_t what, uint32_t out[PIXELS])
{
    nook_texture image;
    memset(out, 0, PIXELS * sizeof *out);
    assert_int_equal(nook_texture_create_2d(view->gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &image), NOOK_OK);
    nook_texture_write(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, out, PIXELS * sizeof *out);
    view->fetches = (nook_ao_texture){ image.id, WIDTH, HEIGHT };
    view->counts = what;
    ao_view_record(view, technique);
    nook_texture_read(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, out, PIXELS * sizeof *out);
    view->fetches = (nook_ao_texture){ 0 };
    view->counts = NOOK_AO_COUNTS_FETCHES;
    nook_texture_destroy(view->gpu, &image);
}

static void test_a_step_is_a_fetch_of_a_volume_and_nothing_else_is_a_step(void **state)
{
    nook_fixture_view *view = *state;
    for (size_t kind = 0; kind < NOOK_COUNT(one_fetch_a_step); kind++) {
        uint32_t fetches[PIXELS], steps[PIXELS], reached = 0, stepped = 0;
        ao_view_param(view, "volume.kind", one_fetch_a_step[kind]);
        count(view, "volume", NOOK_AO_COUNTS_FETCHES, fetches);
        count(view, "volume", NOOK_AO_COUNTS_STEPS, steps);
        for (int i = 0; i < PIXELS; i++) {
            uint32_t others = fetches[i] - steps[i];
            assert_true(others == PREPARED || others == PREPARED + DIRECTIONS); /* the second: the box is in reach */
            assert_true(others != PREPARED || steps[i] == 0);
            reached += others != PREPARED;
            stepped += steps[i] > 0;
        }
        assert_in_range(reached, 1, PIXELS - 1);
        assert_in_range(stepped, 1, reached);
    }
}

static uint32_t count_most(nook_fixture_view *view)
{
    uint32_t steps[PIXELS], most = 0;
    count(view, "volume", NOOK_AO_COUNTS_STEPS, steps);
    for (int i = 0; i < PIXELS; i++)
        most = steps[i] > most ? steps[i] : most;
    return most;
}

static void test_no_ray_takes_more_steps_than_it_may(void **state)
{
    nook_fixture_view *view = *state;
    static const char *const walked[] = { "density", "surfel", "distance" };
    ao_view_param(view, "volume.kind", "binary");
    assert_in_range(count_most(view), 1, RAYS * STEPS * UNIT);
    for (size_t kind = 0; kind < NOOK_COUNT(walked); kind++) {
        ao_view_param(view, "volume.kind", walked[kind]);
        assert_in_range(count_most(view), 1, RAYS * VOLUME_TURNS_PER_VOXEL * LINE * UNIT);
    }
    ao_view_param(view, "volume.kind", "binary");
}

static void test_surfels_are_walked_to_in_steps_and_fetched_besides(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t fetches[PIXELS], steps[PIXELS], met = 0;
    ao_view_param(view, "volume.kind", "surfel");
    count(view, "volume", NOOK_AO_COUNTS_FETCHES, fetches);
    count(view, "volume", NOOK_AO_COUNTS_STEPS, steps);
    for (int i = 0; i < PIXELS; i++) {
        assert_true(fetches[i] >= steps[i] + PREPARED);
        met += fetches[i] > steps[i] + PREPARED + DIRECTIONS;
    }
    assert_in_range(met, 1, PIXELS - 1);
    ao_view_param(view, "volume.kind", "binary");
}

static void test_drawn_boxes_take_the_steps_of_computed_tiles(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t computed[PIXELS], drawn[PIXELS];
    ao_view_param(view, "volume.kind", "binary");
    count(view, "volume", NOOK_AO_COUNTS_STEPS, computed);
    ao_view_param(view, "volume.path", "raster");
    count(view, "volume", NOOK_AO_COUNTS_STEPS, drawn);
    ao_view_param(view, "volume.path", "compute");
    assert_memory_equal(computed, drawn, sizeof computed);
}

static void test_coarser_traces_share_their_steps_out_and_filters_take_none(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t steps[PIXELS];
    ao_view_param(view, "volume.kind", "binary");
    ao_view_param(view, "ao.scale", "quarter");
    ao_view_param(view, "ao.filter", "tile");
    count(view, "volume", NOOK_AO_COUNTS_STEPS, steps);
    ao_view_param(view, "ao.scale", "full");
    ao_view_param(view, "ao.filter", "none");
    for (int i = 0; i < PIXELS; i++) { /* all sixteen pixels of a trace pixel alike */
        int x = i % WIDTH, y = i / WIDTH, first = (y - y % 4) * WIDTH + x - x % 4;
        assert_int_equal(steps[i], steps[first]);
        assert_true(steps[i] <= RAYS * STEPS * UNIT / 16);
    }
}

static void test_techniques_that_follow_no_rays_take_no_steps(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t steps[PIXELS];
    count(view, "gtao", NOOK_AO_COUNTS_STEPS, steps);
    for (int i = 0; i < PIXELS; i++)
        assert_int_equal(steps[i], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_step_is_a_fetch_of_a_volume_and_nothing_else_is_a_step),
        cmocka_unit_test(test_no_ray_takes_more_steps_than_it_may),
        cmocka_unit_test(test_surfels_are_walked_to_in_steps_and_fetched_besides),
        cmocka_unit_test(test_drawn_boxes_take_the_steps_of_computed_tiles),
        cmocka_unit_test(test_coarser_traces_share_their_steps_out_and_filters_take_none),
        cmocka_unit_test(test_techniques_that_follow_no_rays_take_no_steps),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
