/* ao.accumulate: values that are means over frames, and what makes them begin anew. */
#include "modules/ao/technique.h"
#include "tests/support/ao_room.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { PIXELS = AO_ROOM_WIDTH * AO_ROOM_HEIGHT, MANY = 16, STEPS = 10 };

static const char *const kinds[] = { "binary", "surfel" };

static void set_accumulate(const ao_room *r, int frames)
{
    assert_int_equal(nook_ao_set_param(r->view->ao, "ao.accumulate", frames), NOOK_OK);
}

static void set_reuse(const ao_room *r, int frames)
{
    assert_int_equal(nook_ao_set_param(r->view->ao, "ao.reuse", frames), NOOK_OK);
}

static uint32_t traced(const ao_room *r)
{
    nook_ao_statistics statistics;
    nook_ao_get_statistics(r->view->ao, &statistics);
    return statistics.traced;
}

/** Records as often, from nothing. */
static void record(ao_room *r, int frames)
{
    nook_ao_forget(r->view->ao);
    for (int i = 0; i < frames; i++)
        ao_view_record(r->view, "volume");
}

static double rmse(const float *a, const float *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < PIXELS; i++) {
        double error = (double)a[i] - (double)b[i];
        sum += error * error;
    }
    return sqrt(sum / PIXELS);
}

/** What many rays without accumulation make of what is there. */
static void record_truth(ao_room *r, float truth[PIXELS])
{
    set_accumulate(r, 1);
    set_reuse(r, 1);
    ao_view_param(r->view, "volume.rays", "256");
    ao_view_record(r->view, "volume");
    memcpy(truth, r->view->visibility, PIXELS * sizeof *truth);
    ao_view_param(r->view, "volume.rays", "2");
}

static int setup(void **state)
{
    int failed = ao_room_setup(state);
    ao_room *r = *state;
    ao_view_param(r->view, "ao.scale", "full");
    ao_view_param(r->view, "ao.filter", "none");
    return failed;
}

/* ---- A camera that stands ----------------------------------------------------------------------------------------- */

static void test_the_first_record_is_that_without_bit_for_bit(void **state)
{
    static float without[PIXELS];
    ao_room *r = *state;
    for (size_t k = 0; k < NOOK_COUNT(kinds); k++) {
        ao_view_param(r->view, "volume.kind", kinds[k]);
        set_accumulate(r, 1);
        record(r, 1);
        memcpy(without, r->view->visibility, sizeof without);
        set_accumulate(r, MANY);
        record(r, 1);
        assert_memory_equal(without, r->view->visibility, sizeof without);
    }
}

static void test_a_mean_of_n_traces_is_as_near_to_the_truth_as_n_times_the_rays(void **state)
{
    static float truth[PIXELS];
    ao_room *r = *state;
    for (size_t k = 0; k < NOOK_COUNT(kinds); k++) {
        ao_view_param(r->view, "volume.kind", kinds[k]);
        record_truth(r, truth);
        record(r, 1);
        double once = rmse(r->view->visibility, truth);
        ao_view_param(r->view, "volume.rays", "32");
        record(r, 1);
        double rays = rmse(r->view->visibility, truth);
        ao_view_param(r->view, "volume.rays", "2");
        set_accumulate(r, MANY);
        record(r, MANY);
        double traces = rmse(r->view->visibility, truth);
        print_message("%s: RMSE %.4f of 2 rays, %.4f of 32, %.4f of 16 times 2\n", kinds[k], once, rays, traces);
        assert_true(traces < 1.25 * rays && traces < 0.3 * once);
    }
}

static void test_once_its_mean_is_whole_a_picture_that_stands_costs_no_ray_and_does_not_flicker(void **state)
{
    static float before[PIXELS];
    ao_room *r = *state;
    for (int reuse = 1; reuse <= 3; reuse++) {
        set_reuse(r, reuse);
        set_accumulate(r, 4);
        record(r, 3 * reuse);
        assert_true(traced(r) > 0);
        ao_view_record(r->view, "volume");
        record(r, 4 * reuse);
        memcpy(before, r->view->visibility, sizeof before);
        for (int i = 0; i < 3 * reuse; i++) {
            ao_view_record(r->view, "volume");
            assert_int_equal(traced(r), 0);
            assert_memory_equal(before, r->view->visibility, sizeof before);
        }
    }
    set_reuse(r, 1);
}

static void test_in_turns_every_value_gets_all_parts_of_the_rays(void **state)
{
    static float at_once[PIXELS];
    ao_room *r = *state;
    set_accumulate(r, 4);
    set_reuse(r, 1);
    record(r, 4);
    memcpy(at_once, r->view->visibility, sizeof at_once);
    set_reuse(r, 3);
    record(r, 12);
    assert_true(rmse(at_once, r->view->visibility) < 1e-6); /* the order of sums is another */
    set_reuse(r, 1);
}

static void test_a_surface_that_creeps_is_traced_on(void **state)
{
    ao_room *r = *state;
    set_accumulate(r, 2);
    record(r, 4);
    assert_int_equal(traced(r), 0);
    for (int step = 1; step <= 3; step++) { /* far less than a pixel, and no volume tells */
        r->view->occluders[0].world_from_mesh[14] = 1e-5 * step;
        ao_room_draw(r);
        r->view->occluders[0].world_from_mesh[14] = 0.0;
        ao_view_record(r->view, "volume");
        uint32_t creeping = traced(r);
        assert_true(creeping > 20 && creeping < PIXELS / 2);
    }
    ao_room_draw(r);
    record(r, 4);
    assert_int_equal(traced(r), 0);
}

/* ---- What moves --------------------------------------------------------------------------------------------------- */

static double largest_difference(const float *a, const float *b)
{
    double most = 0.0;
    for (size_t i = 0; i < PIXELS; i++)
        most = fmax(most, fabs((double)a[i] - (double)b[i]));
    return most;
}

static void place(ao_room *r, double x)
{
    r->view->occluders[0].world_from_mesh[12] = x;
    ao_room_draw(r);
}

static void test_what_a_body_that_moves_darkens_has_no_lag(void **state)
{
    static float truth[PIXELS];
    ao_room *r = *state;
    double off = 0.0;
    for (int step = 0; step < 4; step++) {
        place(r, 0.05 * (step + 1));
        record_truth(r, truth);
        place(r, 0.05 * step);
        ao_view_param(r->view, "volume.rays", "256"); /* so that their noise is no lag */
        set_accumulate(r, MANY);
        record(r, MANY);
        assert_true(largest_difference(r->view->visibility, truth) > 0.2);
        place(r, 0.05 * (step + 1));
        ao_view_record(r->view, "volume");
        off = fmax(off, largest_difference(r->view->visibility, truth));
        ao_view_param(r->view, "volume.rays", "2");
    }
    print_message("off by %.4f at the most in the frame of the motion\n", off);
    assert_true(off < 0.06);
    place(r, 0.0);
}

static void test_only_what_is_near_a_body_that_moves_begins_anew(void **state)
{
    ao_room *r = *state;
    set_accumulate(r, 4);
    record(r, 1);
    uint32_t all = traced(r);
    record(r, 8);
    assert_int_equal(traced(r), 0);
    r->view->occluders[0].world_from_mesh[12] = 0.01;
    ao_view_record(r->view, "volume");
    uint32_t moved = traced(r);
    assert_true(moved > 0 && moved < all);
    ao_view_record(r->view, "volume");
    assert_int_equal(traced(r), moved); /* until they are means of four again */
    ao_view_record(r->view, "volume");
    ao_view_record(r->view, "volume");
    ao_view_record(r->view, "volume");
    assert_int_equal(traced(r), 0);
    r->view->occluders[0].world_from_mesh[12] = 0.0;
}

/** The body moves a little, without its picture. @return pixels whose mean has begun anew */
static uint32_t creep(ao_room *r)
{
    ao_view_param(r->view, "volume.rays", "256"); /* so that noise is no change */
    set_accumulate(r, 4);
    r->view->occluders[0].world_from_mesh[12] = 0.0;
    record(r, 4);
    r->view->occluders[0].world_from_mesh[12] = 0.01;
    ao_view_record(r->view, "volume");
    ao_view_record(r->view, "volume"); /* the others are whole, and nothing moves */
    return traced(r);
}

static void test_what_moves_by_less_than_was_said_stays_in_the_mean(void **state)
{
    static const double error = 0.3, noise = 0.02;
    static float truth[PIXELS];
    ao_room *r = *state;
    uint32_t all = creep(r);
    record_truth(r, truth);
    assert_int_equal(nook_ao_set_param(r->view->ao, "ao.reuse_error", error), NOOK_OK);
    uint32_t some = creep(r);
    double off = largest_difference(r->view->visibility, truth);
    print_message("%u pixels begin anew, %u with an error of %.1f; off by %.4f at the most\n", all, some, error, off);
    assert_true(some > 0 && some < 3 * all / 4);
    assert_true(off < error + noise);
    assert_int_equal(nook_ao_set_param(r->view->ao, "ao.reuse_error", 0.0), NOOK_OK);
    ao_view_param(r->view, "volume.rays", "2");
    place(r, 0.0);
}

static double walk(ao_room *r, int accumulate, float truths[STEPS][PIXELS])
{
    double sum = 0.0;
    set_accumulate(r, accumulate);
    nook_ao_forget(r->view->ao);
    for (int i = 0; i < STEPS; i++) {
        ao_room_look(r, 0.012 * i, 0.009 * i); /* as 1.4 m/s in a hall five times as large */
        ao_room_draw(r);
        ao_view_record(r->view, "volume");
        double error = rmse(r->view->visibility, truths[i]);
        sum += error * error;
    }
    return sqrt(sum / STEPS);
}

static void test_walking_the_error_is_two_thirds_at_the_most(void **state)
{
    static float truths[STEPS][PIXELS];
    ao_room *r = *state;
    for (int i = 0; i < STEPS; i++) {
        ao_room_look(r, 0.012 * i, 0.009 * i);
        ao_room_draw(r);
        record_truth(r, truths[i]);
    }
    double without = walk(r, 1, truths), with = walk(r, 8, truths);
    print_message("RMSE %.4f without, %.4f with\n", without, with);
    assert_true(with < 0.67 * without);
    ao_room_look(r, 0.0, 0.0);
    ao_room_draw(r);
}

/* ---- What it is not for -------------------------------------------------------------------------------------------- */

static void test_techniques_that_see_the_screen_accumulate_nothing(void **state)
{
    static float once[PIXELS];
    ao_room *r = *state;
    set_accumulate(r, MANY);
    ao_view_record(r->view, "gtao");
    memcpy(once, r->view->visibility, sizeof once);
    ao_view_record(r->view, "gtao");
    assert_memory_equal(once, r->view->visibility, sizeof once);
    assert_int_equal(traced(r), UINT32_MAX);
}

static void test_what_was_forgotten_is_in_no_picture(void **state)
{
    static float first[PIXELS];
    ao_room *r = *state;
    set_accumulate(r, MANY);
    record(r, 1);
    memcpy(first, r->view->visibility, sizeof first);
    ao_view_record(r->view, "volume");
    assert_memory_not_equal(first, r->view->visibility, sizeof first);
    record(r, 1);
    assert_memory_equal(first, r->view->visibility, sizeof first);
}

static void test_the_statistics_count_what_means_are_made_of(void **state)
{
    const ao_room *r = *state;
    enum { KEPT = 20 }; /* depth 4, normal 4, visibility 4, twice ages of 2, what is carried 4 */
    nook_ao_statistics without, with;
    set_accumulate(r, 1);
    ao_view_record(r->view, "volume");
    nook_ao_get_statistics(r->view->ao, &without);
    set_accumulate(r, 2);
    ao_view_record(r->view, "volume");
    nook_ao_get_statistics(r->view->ao, &with);
    assert_int_equal(with.texture_bytes - without.texture_bytes, KEPT * PIXELS);
}

static void test_a_number_of_frames_that_is_none_is_refused(void **state)
{
    static const double wrong[] = { 0.0, -1.0, 65.0, 1.5, NAN };
    const ao_room *r = *state;
    set_accumulate(r, 2);
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_log_capture log;
        double value;
        nook_log_capture_begin(&log);
        nook_result result = nook_ao_set_param(r->view->ao, "ao.accumulate", wrong[i]);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_RANGE);
        assert_non_null(strstr(log.text, "accumulate"));
        assert_int_equal(nook_ao_get_param(r->view->ao, "ao.accumulate", &value), NOOK_OK);
        assert_true(value == 2.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_record_is_that_without_bit_for_bit),
        cmocka_unit_test(test_a_mean_of_n_traces_is_as_near_to_the_truth_as_n_times_the_rays),
        cmocka_unit_test(test_once_its_mean_is_whole_a_picture_that_stands_costs_no_ray_and_does_not_flicker),
        cmocka_unit_test(test_in_turns_every_value_gets_all_parts_of_the_rays),
        cmocka_unit_test(test_a_surface_that_creeps_is_traced_on),
        cmocka_unit_test(test_what_a_body_that_moves_darkens_has_no_lag),
        cmocka_unit_test(test_what_moves_by_less_than_was_said_stays_in_the_mean),
        cmocka_unit_test(test_only_what_is_near_a_body_that_moves_begins_anew),
        cmocka_unit_test(test_walking_the_error_is_two_thirds_at_the_most),
        cmocka_unit_test(test_techniques_that_see_the_screen_accumulate_nothing),
        cmocka_unit_test(test_what_was_forgotten_is_in_no_picture),
        cmocka_unit_test(test_the_statistics_count_what_means_are_made_of),
        cmocka_unit_test(test_a_number_of_frames_that_is_none_is_refused),
    };
    return cmocka_run_group_tests_name("ao.accumulate", tests, setup, ao_room_teardown);
}
