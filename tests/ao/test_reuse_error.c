/* ao.reuse_error: what moves changes no value that is taken over by more than was said, and near it nothing lags. */
#include "tests/support/ao_screen.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 32, HEIGHT = 24, PIXELS = WIDTH * HEIGHT, BODIES = 3, FRAMES = 9 };

/* Of 256 rays in sets that are even, those within an outline are off its weight by less than so much. */
static const double RAYS_OFF = 0.01;

/** Where the bodies are in a frame. */
typedef void (*motion)(nook_fixture_view *view, int frame);

static double visibilities[2][FRAMES][PIXELS]; /* with and without */

static int setup(void **state)
{
    static const double sizes[BODIES][3] = { { 0.5, 0.4, 0.3 }, { 0.15, 0.5, 0.15 }, { 0.6, 0.6, 0.08 } };
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    ao_screen_look(view, (double[]){ 2.5, -3, 2.5 }, (double[]){ 0, 0, 0.2 }, 1.0, 3.0);
    ao_view_add_yard(view, 2.0, 48);
    for (int i = 0; i < BODIES; i++) { /* they occlude and are not seen: the pixels stay those of the yard */
        nook_fixture_mesh mesh = { 0 };
        double high[3], low[3];
        for (int axis = 0; axis < 3; axis++)
            high[axis] = 0.5 * sizes[i][axis], low[axis] = -high[axis];
        nook_fixture_add_box(&mesh, low, high, 63);
        ao_view_add(view, &mesh, 24);
        nook_fixture_mesh_free(&mesh);
    }
    ao_view_param(view, "ao.filter", "none");
    ao_view_param(view, "volume.rays", "256");
    *state = view;
    return 0;
}

static void place(nook_fixture_view *view, int body, double x, double y, double z, double half_turn)
{
    const double at[3] = { x, y, z }, one[3] = { 1, 1, 1 }, none[4] = { 0, 0, 0, 1 };
    const double rotation[4] = { 0.6 * sin(half_turn), 0, 0.8 * sin(half_turn), cos(half_turn) };
    nook_matrix m = nook_matrix_compose(at, half_turn == 0.0 ? none : rotation, one);
    memcpy(view->occluders[1 + body].world_from_mesh, m.m, sizeof m.m);
}

/* One walks and turns, the others stand. */
static void one_walks(nook_fixture_view *view, int frame)
{
    place(view, 0, 1.2 - 0.08 * frame, -1.0, 0.8, 0.07 * frame);
    place(view, 1, -1.0, -0.5, 0.6, 0.3);
    place(view, 2, 0.2, -1.3, 1.7, 0.0);
}

static void all_walk(nook_fixture_view *view, int frame)
{
    place(view, 0, 1.2 - 0.08 * frame, -1.0, 0.8, 0.07 * frame);
    place(view, 1, -1.0, -0.5 - 0.1 * frame, 0.6, 0.3);
    place(view, 2, 0.2, -1.3, 1.7, 0.2 * frame);
}

static void all_creep(nook_fixture_view *view, int frame)
{
    place(view, 0, 1.2 - 0.004 * frame, -1.0, 0.8, 0.003 * frame);
    place(view, 1, -1.0, -0.5 - 0.005 * frame, 0.6, 0.3);
    place(view, 2, 0.2, -1.3, 1.7, 0.01 * frame);
}

/* Over the floor, whose points lie in its box. */
static void one_slides(nook_fixture_view *view, int frame)
{
    one_walks(view, 0);
    place(view, 0, 1.2 - 0.15 * frame, -1.0, 0.16, 0.0);
}

/* Far apart in each frame: what matters is where it was and is. */
static void one_jumps(nook_fixture_view *view, int frame)
{
    one_walks(view, 0);
    place(view, 0, frame % 3 - 1.0, -1.0 - 0.5 * (frame % 2), 0.8, 0.0);
}

/* From where doubles reach and floats do not, and back. */
static void one_comes_from_beyond(nook_fixture_view *view, int frame)
{
    one_walks(view, frame);
    if (frame % 4 < 2)
        place(view, 0, 1e308, 0.0, 0.0, 0.0);
}

/* Its place in the list stays another's or nobody's. */
static void some_come_and_go(nook_fixture_view *view, int frame)
{
    one_walks(view, 0);
    view->occluder_count = frame % 4 < 2 ? 1 + BODIES : 2;
}

static void keep(const nook_fixture_view *view, int with, int frame)
{
    for (size_t i = 0; i < PIXELS; i++)
        visibilities[with][frame][i] = (double)view->visibility[i];
}

/** @return pixels that were traced in all frames but the first */
static uint32_t play(nook_fixture_view *view, motion move, int reuse, double error, int with)
{
    uint32_t sum = 0;
    assert_int_equal(nook_ao_set_param(view->ao, "ao.reuse", reuse), NOOK_OK);
    assert_int_equal(nook_ao_set_param(view->ao, "ao.reuse_error", error), NOOK_OK);
    for (int frame = 0; frame < FRAMES; frame++) {
        nook_ao_statistics statistics;
        move(view, frame);
        ao_view_record(view, "volume");
        keep(view, with, frame);
        nook_ao_get_statistics(view->ao, &statistics);
        sum += frame > 0 ? statistics.traced : 0;
    }
    view->occluder_count = 1 + BODIES;
    return sum;
}

/** Of all frames. @return largest difference between with and without */
static double compare(uint32_t *out_changed)
{
    double largest = 0.0;
    *out_changed = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        for (size_t i = 0; i < PIXELS; i++) {
            double off = fabs(visibilities[1][frame][i] - visibilities[0][frame][i]);
            largest = fmax(largest, off);
            *out_changed += off > 0.0;
        }
    }
    return largest;
}

static void expect_bounded(nook_fixture_view *view, const char *name, motion move, int reuse)
{
    static const double errors[] = { 0.02, 0.1 };
    (void)play(view, move, 1, 0.0, 0);
    uint32_t all = play(view, move, reuse, 0.0, 1), changed;
    if (compare(&changed) > 0.0)
        fail_msg("%s: %u values differ with an error of 0", name, changed);
    for (size_t i = 0; i < NOOK_COUNT(errors); i++) {
        uint32_t traced = play(view, move, reuse, errors[i], 1);
        double largest = compare(&changed);
        print_message("%-16s error %.2f: largest change %.4f, %5u values of %u changed, traced %.3f of those of 0\n",
                      name, errors[i], largest, changed, FRAMES * PIXELS, (double)traced / all);
        if (!(largest <= errors[i] + RAYS_OFF))
            fail_msg("%s: %.4f with an error of %.2f", name, largest, errors[i]);
        if (traced >= all || changed == 0)
            fail_msg("%s: an error of %.2f saves nothing", name, errors[i]);
    }
}

static void test_no_value_is_off_by_more_than_was_said(void **state)
{
    nook_fixture_view *view = *state;
    expect_bounded(view, "one walks", one_walks, 4);
    expect_bounded(view, "all walk", all_walk, 4);
    expect_bounded(view, "one jumps", one_jumps, 3);
    expect_bounded(view, "come and go", some_come_and_go, 4);
}

static void test_many_small_motions_do_not_add_up(void **state)
{
    expect_bounded(*state, "all creep", all_creep, 8);
}

static void test_whatever_is_marched_is_bounded(void **state)
{
    static const char *const kinds[] = { "surfel", "distance" };
    nook_fixture_view *view = *state;
    ao_view_param(view, "volume.guard", "seen");
    expect_bounded(view, "guard = seen", all_walk, 4);
    ao_view_param(view, "volume.guard", "lifted");
    ao_view_param(view, "volume.combine", "multiply");
    ao_view_param(view, "ao.falloff", "linear");
    for (size_t i = 0; i < NOOK_COUNT(kinds); i++) {
        ao_view_param(view, "volume.kind", kinds[i]);
        expect_bounded(view, kinds[i], all_walk, 4);
    }
    ao_view_param(view, "volume.kind", "binary");
    ao_view_param(view, "volume.combine", "union");
    ao_view_param(view, "ao.falloff", "hard");
}

/* Contacts: where a body takes more than the error, the value is that of a frame without reuse, bit for bit. */
static void expect_no_lag(nook_fixture_view *view, motion move)
{
    const double error = 0.05;
    double alone[PIXELS];
    uint32_t dark = 0;
    one_walks(view, 0);
    place(view, 0, 100.0, 0.0, 0.0, 0.0);
    assert_int_equal(nook_ao_set_param(view->ao, "ao.reuse", 1), NOOK_OK);
    ao_view_record(view, "volume");
    for (size_t i = 0; i < PIXELS; i++)
        alone[i] = (double)view->visibility[i];
    (void)play(view, move, 1, 0.0, 0);
    (void)play(view, move, 4, error, 1);
    for (int frame = 1; frame < FRAMES; frame++) {
        for (size_t i = 0; i < PIXELS; i++) {
            if (alone[i] - visibilities[0][frame][i] <= error + RAYS_OFF)
                continue;
            dark++;
            if (visibilities[0][frame][i] != visibilities[1][frame][i])
                fail_msg("frame %d, pixel %zu: %.4f instead of %.4f", frame, i, visibilities[1][frame][i],
                         visibilities[0][frame][i]);
        }
    }
    assert_true(dark > 100);
}

static void test_what_a_body_that_moves_darkens_has_no_lag(void **state)
{
    expect_no_lag(*state, one_walks);
}

static void test_what_a_body_darkens_that_floats_could_not_hold_has_no_lag(void **state)
{
    expect_no_lag(*state, one_comes_from_beyond);
}

static void test_where_a_point_lies_in_the_box_of_what_moves_no_value_is_off_by_more(void **state)
{
    expect_bounded(*state, "one slides", one_slides, 4);
}

static void test_an_error_that_is_none_is_refused(void **state)
{
    static const double wrong[] = { -0.01, 1.01, NAN };
    nook_fixture_view *view = *state;
    assert_int_equal(nook_ao_set_param(view->ao, "ao.reuse_error", 0.25), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_log_capture log;
        double value;
        nook_log_capture_begin(&log);
        nook_result result = nook_ao_set_param(view->ao, "ao.reuse_error", wrong[i]);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_RANGE);
        assert_int_equal(log.count, 1);
        assert_int_equal(nook_ao_get_param(view->ao, "ao.reuse_error", &value), NOOK_OK);
        assert_true(value == 0.25);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_value_is_off_by_more_than_was_said),
        cmocka_unit_test(test_many_small_motions_do_not_add_up),
        cmocka_unit_test(test_whatever_is_marched_is_bounded),
        cmocka_unit_test(test_what_a_body_that_moves_darkens_has_no_lag),
        cmocka_unit_test(test_what_a_body_darkens_that_floats_could_not_hold_has_no_lag),
        cmocka_unit_test(test_where_a_point_lies_in_the_box_of_what_moves_no_value_is_off_by_more),
        cmocka_unit_test(test_an_error_that_is_none_is_refused),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
