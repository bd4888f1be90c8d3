/* Techniques whose code is replaced while a context records: pictures as the new code makes them, parameters and state kept. */
#include "modules/ao/technique.h"
#include "tests/support/ao_view.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 16 };

/* ---- a technique that paints one value, in several versions ---- */

typedef struct even_state {
    int32_t records;
    nook_buffer buffer; /* something of GL's */
} even_state;

typedef struct even_params {
    float value;
    int32_t count;
    int32_t kind;
} even_params;

static int32_t alive; /* states */

static nook_result even_create(void *state, nook_gpu *gpu)
{
    even_state *s = state;
    alive++;
    return nook_buffer_create(gpu, NULL, 16, &s->buffer);
}

static void even_destroy(void *state, nook_gpu *gpu)
{
    even_state *s = state;
    alive--;
    nook_buffer_destroy(gpu, &s->buffer);
}

static nook_result paint(const nook_ao_pass *pass, float value)
{
    const float texel[4] = { value, 0.0f, 0.0f, 0.0f };
    pass->gpu->gl->ClearTexImage(pass->visibility.id, 0, GL_RGBA, GL_FLOAT, texel);
    return NOOK_OK;
}

static nook_result record_value(void *state, const void *params, const nook_ao_pass *pass)
{
    const even_params *p = params;
    ((even_state *)state)->records++;
    return paint(pass, p->value);
}

/* New code: half of it; and a hundredth for each record that the state knows of. */
static nook_result record_half(void *state, const void *params, const nook_ao_pass *pass)
{
    const even_params *p = params;
    even_state *s = state;
    s->records++;
    return paint(pass, 0.5f * p->value + 0.01f * (float)s->records);
}

static const nook_param even_table[] = {
    { "value", NOOK_PARAM_FLOAT, NOOK_UNIT_NONE, offsetof(even_params, value), 0.25, 0.0, 1.0, NULL, "" },
    { "count", NOOK_PARAM_INT, NOOK_UNIT_COUNT, offsetof(even_params, count), 4, 1, 64, NULL, "" },
    { "kind", NOOK_PARAM_CHOICE, NOOK_UNIT_NONE, offsetof(even_params, kind), 0, 0, 2, "tile|blur|none", "" },
};

static const nook_ao_technique even = { .version = NOOK_AO_TECHNIQUE_VERSION,
                                        .name = "even",
                                        .summary = "The same everywhere",
                                        .params = even_table,
                                        .param_count = NOOK_COUNT(even_table),
                                        .params_size = sizeof(even_params),
                                        .state_size = sizeof(even_state),
                                        .state_version = 1,
                                        .create = even_create,
                                        .destroy = even_destroy,
                                        .record = record_value };

static nook_ao_technique even_otherwise(void)
{
    nook_ao_technique technique = even;
    technique.record = record_half;
    return technique;
}

static int setup(void **state)
{
    static const double facing[3] = { 0, 0, 1 };
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    alive = 0;
    assert_int_equal(nook_ao_add_technique(view->ao, &even), NOOK_OK);
    ao_view_param(view, "ao.filter", "none");
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++)
            nook_fixture_view_set_pixel(view, x, y, 2.0, facing);
    }
    *state = view;
    return 0;
}

static int teardown(void **state)
{
    ao_view_destroy(*state);
    assert_int_equal(alive, 0);
    return 0;
}

static nook_ao *context(void **state)
{
    return ((nook_fixture_view *)*state)->ao;
}

static double visibility(nook_fixture_view *view, const char *technique)
{
    ao_view_record(view, technique);
    return (double)view->visibility[WIDTH * HEIGHT / 2];
}

static double value_of(nook_ao *ao, const char *name)
{
    double value = -1.0;
    assert_int_equal(nook_ao_get_param(ao, name, &value), NOOK_OK);
    return value;
}

#define ASSERT_NEAR(a, b) assert_true(fabs((a) - (b)) < 1e-6)

static void test_the_next_record_is_by_the_new_code_with_the_old_parameters_and_state(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_technique otherwise = even_otherwise();
    ao_view_param(view, "even.value", "0.5");
    ASSERT_NEAR(visibility(view, "even"), 0.5);
    ASSERT_NEAR(visibility(view, "even"), 0.5);
    assert_int_equal(nook_ao_replace_technique(view->ao, &otherwise, 1), NOOK_OK);
    ASSERT_NEAR(visibility(view, "even"), 0.25 + 0.03); /* its third record */
    assert_int_equal(alive, 1);
    ASSERT_NEAR(value_of(view->ao, "even.value"), 0.5);
    assert_int_equal(nook_ao_replace_technique(view->ao, &even, 1), NOOK_OK);
    ASSERT_NEAR(visibility(view, "even"), 0.5);
}

static void test_a_state_that_is_not_kept_is_made_anew_by_the_new_code(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_technique otherwise = even_otherwise();
    visibility(view, "even");
    assert_int_equal(nook_ao_replace_technique(view->ao, &otherwise, 0), NOOK_OK);
    ASSERT_NEAR(visibility(view, "even"), 0.125 + 0.01);
    nook_ao_technique versions[] = { even_otherwise(), even_otherwise() };
    versions[0].state_version = 2;
    versions[1].state_version = 2;
    versions[1].state_size += 8;
    for (uint32_t i = 0; i < NOOK_COUNT(versions); i++) {
        assert_int_equal(nook_ao_replace_technique(view->ao, &versions[i], 1), NOOK_OK);
        ASSERT_NEAR(visibility(view, "even"), 0.125 + 0.01);
    }
    assert_int_equal(alive, 1);
    assert_int_equal(nook_ao_replace_technique(view->ao, &even, 0), NOOK_OK); /* which the teardown knows */
}

static void test_parameters_are_kept_by_name_in_a_table_of_another_order_and_range(void **state)
{
    typedef struct other_params {
        int32_t kind;
        float fresh;
        int32_t count;
        float value;
    } other_params;
    static const nook_param table[] = {
        { "kind", NOOK_PARAM_CHOICE, NOOK_UNIT_NONE, offsetof(other_params, kind), 0, 0, 2, "none|tile|blur", "" },
        { "fresh", NOOK_PARAM_FLOAT, NOOK_UNIT_NONE, offsetof(other_params, fresh), 7.0, 0.0, 9.0, NULL, "" },
        { "count", NOOK_PARAM_INT, NOOK_UNIT_COUNT, offsetof(other_params, count), 4, 1, 16, NULL, "" },
        { "value", NOOK_PARAM_FLOAT, NOOK_UNIT_NONE, offsetof(other_params, value), 0.25, 0.0, 1.0, NULL, "" },
    };
    nook_fixture_view *view = *state;
    nook_ao_technique otherwise = even;
    otherwise.params = table;
    otherwise.param_count = NOOK_COUNT(table);
    otherwise.params_size = sizeof(other_params);
    ao_view_param(view, "even.value", "0.75");
    ao_view_param(view, "even.count", "60");
    ao_view_param(view, "even.kind", "blur");
    assert_int_equal(nook_ao_replace_technique(view->ao, &otherwise, 1), NOOK_OK);
    ASSERT_NEAR(value_of(view->ao, "even.value"), 0.75);
    ASSERT_NEAR(value_of(view->ao, "even.count"), 16.0);
    ASSERT_NEAR(value_of(view->ao, "even.kind"), 2.0);
    ASSERT_NEAR(value_of(view->ao, "even.fresh"), 7.0);
    assert_int_equal(nook_ao_replace_technique(view->ao, &even, 1), NOOK_OK);
    ASSERT_NEAR(value_of(view->ao, "even.kind"), 1.0);
    ASSERT_NEAR(visibility(view, "even"), 0.75);
}

static nook_result create_nothing(void *state, nook_gpu *gpu)
{
    (void)state, (void)gpu;
    return NOOK_E_DEVICE;
}

static void test_a_technique_that_cannot_replace_leaves_the_old_one_as_it_was(void **state)
{
    nook_fixture_view *view = *state;
    nook_log_capture log;
    nook_ao_technique broken = even_otherwise(), other = even_otherwise(), old = even_otherwise();
    broken.create = create_nothing;
    other.name = "odd";
    old.version = NOOK_AO_TECHNIQUE_VERSION - 1;
    ao_view_param(view, "even.value", "0.5");
    nook_log_capture_begin(&log);
    assert_int_equal(nook_ao_replace_technique(view->ao, &broken, 0), NOOK_E_DEVICE);
    assert_int_equal(nook_ao_replace_technique(view->ao, &other, 1), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_ao_replace_technique(view->ao, &old, 1), NOOK_E_VERSION);
    nook_log_capture_end();
    ASSERT_NEAR(visibility(view, "even"), 0.5);
    assert_int_equal(alive, 1);
}

static void test_the_chosen_technique_and_the_others_stay(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_technique otherwise = even_otherwise();
    double before = visibility(view, "ssao");
    assert_int_equal(nook_ao_replace_technique(context(state), &otherwise, 1), NOOK_OK);
    assert_true(visibility(view, "ssao") == before);
    assert_string_equal(nook_ao_technique_at(view->ao, 1)->name, "ssao");
    assert_int_equal(nook_ao_replace_technique(context(state), &even, 1), NOOK_OK);
}

static int count_buffers(nook_gpu *gpu)
{
    int count = 0;
    for (GLuint name = 1; name < 8000; name++)
        count += gpu->gl->IsBuffer(name);
    return count;
}

static void test_a_thousand_replacements_leave_no_buffer_and_no_state(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_technique otherwise = even_otherwise();
    int before = count_buffers(view->gpu);
    for (int i = 0; i < 1000; i++)
        assert_int_equal(nook_ao_replace_technique(view->ao, i & 1 ? &even : &otherwise, i % 3 == 0), NOOK_OK);
    assert_int_equal(count_buffers(view->gpu), before);
    assert_int_equal(alive, 1);
}

static void told(void *user, double fraction)
{
    *(double *)user = fraction;
}

static void test_progress_is_told_to_the_one_who_was_named_last(void **state)
{
    nook_fixture_view *view = *state;
    double fraction = -1.0;
    ao_view_param(view, "reference.rays", "1");
    nook_ao_set_progress(view->ao, told, &fraction);
    visibility(view, "reference");
    assert_true(fraction == 1.0);
    fraction = -1.0;
    nook_ao_set_progress(view->ao, NULL, NULL);
    visibility(view, "reference");
    assert_true(fraction == -1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
        TEST(test_the_next_record_is_by_the_new_code_with_the_old_parameters_and_state),
        TEST(test_a_state_that_is_not_kept_is_made_anew_by_the_new_code),
        TEST(test_parameters_are_kept_by_name_in_a_table_of_another_order_and_range),
        TEST(test_a_technique_that_cannot_replace_leaves_the_old_one_as_it_was),
        TEST(test_the_chosen_technique_and_the_others_stay),
        TEST(test_a_thousand_replacements_leave_no_buffer_and_no_state),
        TEST(test_progress_is_told_to_the_one_who_was_named_last),
#undef TEST
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
