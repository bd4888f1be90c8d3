/* What becomes of samples: how much light they take. */
#include "engine/asset/scalar_medium.h"
#include "engine/asset/scene_internal.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const nook_scalar_transfer window = { .low = 10.0, .high = 20.0, .length = 0.5 };

static nook_scalar_volume volume_of(float *samples, uint32_t count)
{
    nook_scalar_volume v = { .dimension = 3,
                             .components = 1,
                             .size = { count, 1, 1 },
                             .spacing = { 0.25, 0.5, 1.0 },
                             .type = NOOK_SAMPLE_F32,
                             .samples = samples,
                             .sample_count = count };
    for (uint32_t i = 0; i < count; i++)
        v.not_finite += isfinite(samples[i]) ? 0 : 1;
    return v;
}

static void test_a_sample_in_the_window_is_as_opaque_along_the_length_as_it_lies_high(void **state)
{
    (void)state;
    for (int percent = 0; percent < 100; percent += 3) {
        double extinction = nook_scalar_extinction(&window, 10.0 + 0.1 * percent);
        assert_true(fabs(1.0 - exp(-extinction * 0.5) - 0.01 * percent) < 1e-12);
        assert_true(fabs(exp(-extinction * 0.25) - sqrt(1.0 - 0.01 * percent)) < 1e-12); /* half of the way */
    }
}

static void test_samples_outside_of_the_window_are_nothing_or_all_but_opaque(void **state)
{
    (void)state;
    assert_true(nook_scalar_extinction(&window, 9.99) == 0.0);
    assert_true(nook_scalar_extinction(&window, -1e300) == 0.0);
    assert_true(fabs(exp(-nook_scalar_extinction(&window, 20.0) * 0.5) - 1.0 / 1024.0) < 1e-12);
    assert_true(nook_scalar_extinction(&window, 1e300) == nook_scalar_extinction(&window, 20.0));
    const nook_scalar_transfer widest = { -1.7e308, 1.7e308, 1.0 };
    assert_true(fabs(exp(-nook_scalar_extinction(&widest, 0.0)) - 0.5) < 1e-12);
}

static void test_a_medium_has_the_cells_of_the_samples(void **state)
{
    (void)state;
    float samples[] = { 0.0f, 15.0f, 20.0f };
    nook_scalar_volume v = volume_of(samples, 3);
    nook_medium medium;
    assert_int_equal(nook_scalar_medium("test", &v, &window, NULL, &medium), NOOK_OK);
    assert_int_equal(medium.size[0], 3);
    assert_int_equal(medium.size[2], 1);
    assert_true(medium.spacing[0] == 0.25 && medium.spacing[2] == 1.0);
    for (int i = 0; i < 3; i++)
        assert_true(medium.extinction[i] == (float)nook_scalar_extinction(&window, (double)samples[i]));
    free((void *)(uintptr_t)medium.extinction);
}

/* The medium that a volume becomes with one warning. */
static nook_medium expect_warning(const nook_scalar_volume *v, const char *words)
{
    nook_medium medium;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_scalar_medium("test", v, &window, NULL, &medium);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_OK);
    assert_int_equal(log.count, 1);
    assert_int_equal(log.errors, 0);
    assert_non_null(strstr(log.text, words));
    return medium;
}

static void test_samples_that_are_not_finite_take_nothing_and_are_said(void **state)
{
    (void)state;
    float samples[] = { NAN, 15.0f, INFINITY, -INFINITY };
    nook_scalar_volume v = volume_of(samples, 4);
    nook_medium medium = expect_warning(&v, "3 samples are not finite");
    assert_true(medium.extinction[0] == 0.0f && medium.extinction[2] == 0.0f && medium.extinction[3] == 0.0f);
    assert_true(medium.extinction[1] > 0.0f);
    free((void *)(uintptr_t)medium.extinction);
}

static void test_a_window_that_no_sample_reaches_is_said(void **state)
{
    (void)state;
    float samples[] = { 1.0f, 10.0f };
    nook_scalar_volume v = volume_of(samples, 2);
    nook_medium medium = expect_warning(&v, "window of 10 to 20");
    free((void *)(uintptr_t)medium.extinction);
}

static void assert_refused(const nook_scalar_volume *v, const nook_scalar_transfer *transfer, nook_result code,
                           const char *word)
{
    nook_medium medium = { .size = { 7, 7, 7 } }, before = medium;
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_scalar_medium("test", v, transfer, NULL, &medium);
    nook_log_capture_end();
    if (result != code || log.count != 1 || !strstr(log.text, word))
        fail_msg("%d, %d lines: %s", result, log.count, log.text);
    assert_memory_equal(&medium, &before, sizeof medium);
}

static void test_windows_upside_down_flat_or_endless_are_refused(void **state)
{
    (void)state;
    static const double windows[][2] = { { 20, 10 },  { 10, 10 },       { NAN, 10 },
                                         { 10, NAN }, { -INFINITY, 1 }, { 1, INFINITY } };
    float samples[] = { 1.0f };
    nook_scalar_volume v = volume_of(samples, 1);
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
        const nook_scalar_transfer transfer = { windows[i][0], windows[i][1], 1.0 };
        assert_refused(&v, &transfer, NOOK_E_RANGE, "window");
    }
}

static void test_lengths_that_are_none_are_refused(void **state)
{
    (void)state;
    static const double lengths[] = { 0.0, -1.0, 9e-7, 1.1e6, NAN, INFINITY };
    float samples[] = { 1.0f };
    nook_scalar_volume v = volume_of(samples, 1);
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        const nook_scalar_transfer transfer = { 0.0, 1.0, lengths[i] };
        assert_refused(&v, &transfer, NOOK_E_RANGE, "length");
    }
}

static void test_vectors_and_sides_without_measure_are_refused(void **state)
{
    (void)state;
    float samples[] = { 1.0f, 2.0f, 3.0f };
    nook_scalar_volume v = volume_of(samples, 1);
    v.components = 3;
    assert_refused(&v, &window, NOOK_E_FORMAT, "3 numbers a sample");
    v = volume_of(samples, 3);
    v.spacing[1] = 1e-12;
    assert_refused(&v, &window, NOOK_E_FORMAT, "1e-12 apart");
    v.spacing[1] = 1e12;
    assert_refused(&v, &window, NOOK_E_FORMAT, "1e+12 apart");
}

static void test_more_samples_than_memory_should_go_for_are_refused(void **state)
{
    (void)state;
    float sample = 1.0f;
    nook_scalar_volume v = volume_of(&sample, 1);
    v.sample_count = (size_t)NOOK_MEDIUM_CELLS_MAX + 1;
    assert_refused(&v, &window, NOOK_E_FORMAT, "make it coarser");
    v = volume_of(&sample, 1);
    v.size[1] = NOOK_MEDIUM_SIDE_MAX + 1;
    assert_refused(&v, &window, NOOK_E_FORMAT, "along an axis");
}

/* So many fields of so many samples along each axis fit into a scene, and the next one is refused in one line. */
static void expect_full(uint32_t count, uint32_t side, const char *words)
{
    char path[] = "many.gltf";
    nook_scene scene = { .path = path };
    const nook_medium medium = { { side, side, side }, { 1, 1, 1 }, NULL };
    const nook_matrix at = nook_matrix_identity();
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(nook_scene_add_density(&scene, "a", &medium, &at), NOOK_OK);
    assert_int_equal(capture.count, 0);
    assert_int_equal(nook_scene_add_density(&scene, "b", &medium, &at), NOOK_E_FORMAT);
    nook_log_capture_end();
    assert_int_equal(capture.count, 1);
    assert_non_null(strstr(capture.text, words));
    assert_int_equal(scene.density_count, count);
    for (uint32_t i = 0; i < scene.density_count; i++)
        free(scene.densities[i].name);
    free(scene.densities);
}

static void test_a_scene_has_no_more_samples_than_one_field_may_have(void **state)
{
    (void)state;
    expect_full(2, 512, "make them coarser");
}

static void test_a_scene_has_no_more_fields_than_it_has_room_for(void **state)
{
    (void)state;
    expect_full(NOOK_SCENE_DENSITIES_MAX, 1, "more than 64 densities");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sample_in_the_window_is_as_opaque_along_the_length_as_it_lies_high),
        cmocka_unit_test(test_samples_outside_of_the_window_are_nothing_or_all_but_opaque),
        cmocka_unit_test(test_a_medium_has_the_cells_of_the_samples),
        cmocka_unit_test(test_samples_that_are_not_finite_take_nothing_and_are_said),
        cmocka_unit_test(test_a_window_that_no_sample_reaches_is_said),
        cmocka_unit_test(test_windows_upside_down_flat_or_endless_are_refused),
        cmocka_unit_test(test_lengths_that_are_none_are_refused),
        cmocka_unit_test(test_vectors_and_sides_without_measure_are_refused),
        cmocka_unit_test(test_more_samples_than_memory_should_go_for_are_refused),
        cmocka_unit_test(test_a_scene_has_no_more_samples_than_one_field_may_have),
        cmocka_unit_test(test_a_scene_has_no_more_fields_than_it_has_room_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
