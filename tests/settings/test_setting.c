#include "game/settings/setting.h"
#include "game/techniques.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static nook_setting must_parse(const char *text)
{
    nook_setting setting;
    assert_int_equal(nook_setting_parse("here", text, &setting), NOOK_OK);
    return setting;
}

static void must_print(const nook_setting *setting, const char *expected)
{
    char text[NOOK_SETTING_TEXT_MAX];
    assert_string_equal(nook_setting_print(setting, text), expected);
}

/* The text is refused with that code and one line that holds `reason`; what was there stays. */
static void must_refuse(const char *text, nook_result code, const char *reason)
{
    nook_log_capture log;
    nook_setting setting, before;
    memset(&setting, 7, sizeof setting);
    before = setting;
    nook_log_capture_begin(&log);
    nook_result result = nook_setting_parse("sweep.txt:12", text, &setting);
    nook_log_capture_end();
    assert_int_equal(result, code);
    assert_int_equal(log.errors, 1);
    assert_int_equal(log.count, 1);
    if (!strstr(log.text, reason) || strncmp(log.text, "sweep.txt:12: ", 14) != 0)
        fail_msg("'%s' says: %s", text, log.text);
    assert_memory_equal(&setting, &before, sizeof setting);
}

static void test_text_is_read_and_printed_in_the_order_of_the_tables(void **state)
{
    (void)state;
    nook_setting setting = must_parse("volume resolution=128  ao.scale=half\tsteps=32 rays=4");
    must_print(&setting, "volume rays=4 steps=32 ao.scale=half resolution=128");
    assert_int_equal(setting.resolution, 128);
    assert_int_equal(setting.param_count, 3);
}

static void test_what_is_at_its_initial_value_is_not_printed(void **state)
{
    (void)state;
    char text[128], value[32];
    const nook_ao_technique *volume = nook_technique_find("volume");
    const nook_param *rays = nook_param_find(volume->params, volume->param_count, "rays");
    snprintf(text, sizeof text, "volume rays=%s", nook_param_print_value(rays, rays->initial, value, sizeof value));
    nook_setting setting = must_parse(text);
    must_print(&setting, "volume");
    setting = must_parse("ssao bias=0.0100000001"); /* the same float as the initial 0.01 */
    must_print(&setting, "ssao");
    setting = must_parse("volume rays=4");
    assert_int_equal(nook_setting_assign("here", &setting, "rays", text + strlen("volume rays=")), NOOK_OK);
    must_print(&setting, "volume");
    assert_int_equal(setting.param_count, 0);
}

static void test_assigning_again_replaces_the_value(void **state)
{
    (void)state;
    nook_setting setting = must_parse("volume rays=4 ao.filter=none");
    assert_int_equal(nook_setting_assign("here", &setting, "rays", "2"), NOOK_OK);
    assert_int_equal(nook_setting_assign("here", &setting, "resolution", "64"), NOOK_OK);
    assert_int_equal(nook_setting_assign("here", &setting, "steps", "48"), NOOK_OK);
    must_print(&setting, "volume rays=2 steps=48 ao.filter=none resolution=64");
}

static void test_floats_are_printed_with_the_digits_they_need(void **state)
{
    (void)state;
    nook_setting setting = must_parse("volume threshold=0.1 ao.filter_depth=1.00000012 ao.filter_normal=100");
    must_print(&setting, "volume threshold=0.1 ao.filter_depth=1.0000001 ao.filter_normal=100");
    char text[NOOK_SETTING_TEXT_MAX];
    nook_setting again = must_parse(nook_setting_print(&setting, text));
    assert_true(again.params[1].value == setting.params[1].value);
}

static bool is_of_settings(const nook_param *param, bool shared)
{
    return !shared || (strcmp(param->name, "r_max") != 0 && strcmp(param->name, "falloff") != 0 &&
                       strcmp(param->name, "falloff_tau") != 0 && strcmp(param->name, "count") != 0);
}

/* Somewhere in the range, never the initial value, different for every k. */
static double value_at(const nook_param *param, int k)
{
    double part = (k + 0.37) / 3.0;
    double value = param->type == NOOK_PARAM_FLOAT
                       ? (double)(float)(param->lowest + part * (param->highest - param->lowest))
                       : floor(param->lowest + part * (param->highest - param->lowest) + 0.5);
    return value == param->initial ? param->lowest + (param->lowest == param->initial) : value;
}

/* Prints value k of a parameter, reads it back, applies it, and asks the AO what it has. */
static void go_round(const nook_ao_technique *technique, const nook_param *param, bool shared, int k)
{
    char name[64], value[NOOK_SETTING_VALUE_MAX], text[NOOK_SETTING_TEXT_MAX], again_text[NOOK_SETTING_TEXT_MAX];
    nook_setting setting = nook_setting_initial(technique);
    const nook_setting_param entry = { param, shared, value_at(param, k) };
    snprintf(name, sizeof name, "%s%s", shared ? "ao." : "", param->name);
    assert_int_equal(nook_setting_assign("here", &setting, name, nook_setting_value(&entry, value)), NOOK_OK);
    assert_int_equal(setting.param_count, 1);
    assert_true(setting.params[0].value == entry.value);
    assert_true(nook_setting_get(&setting, param) == entry.value);
    nook_setting again = must_parse(nook_setting_print(&setting, text));
    assert_string_equal(nook_setting_print(&again, again_text), text);
    assert_true(again.params[0].param == param && again.params[0].value == entry.value);
}

static void test_every_parameter_of_every_technique_goes_round(void **state)
{
    (void)state;
    size_t count, shared_count, tried = 0;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    const nook_param *shared = nook_ao_shared_params(&shared_count);
    for (size_t t = 0; t < count; t++) {
        for (size_t i = 0; i < techniques[t]->param_count + shared_count; i++) {
            bool is_shared = i >= techniques[t]->param_count;
            const nook_param *param = is_shared ? &shared[i - techniques[t]->param_count] : &techniques[t]->params[i];
            if (!is_of_settings(param, is_shared))
                continue;
            for (int k = 0; k < 3; k++, tried++)
                go_round(techniques[t], param, is_shared, k);
        }
    }
    assert_true(tried > 3 * 5 * count);
}

static void test_all_parameters_at_once_fit(void **state)
{
    (void)state;
    size_t count, shared_count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    const nook_param *shared = nook_ao_shared_params(&shared_count);
    for (size_t t = 0; t < count; t++) {
        nook_setting setting = nook_setting_initial(techniques[t]);
        char name[64], value[NOOK_SETTING_VALUE_MAX], text[NOOK_SETTING_TEXT_MAX], again_text[NOOK_SETTING_TEXT_MAX];
        for (size_t i = techniques[t]->param_count + shared_count; i-- > 0;) { /* backwards: the order is the table's */
            bool is_shared = i >= techniques[t]->param_count;
            const nook_param *param = is_shared ? &shared[i - techniques[t]->param_count] : &techniques[t]->params[i];
            if (!is_of_settings(param, is_shared))
                continue;
            const nook_setting_param entry = { param, is_shared, value_at(param, 1) };
            snprintf(name, sizeof name, "%s%s", is_shared ? "ao." : "", param->name);
            assert_int_equal(nook_setting_assign("here", &setting, name, nook_setting_value(&entry, value)), NOOK_OK);
        }
        nook_setting again = must_parse(nook_setting_print(&setting, text));
        assert_string_equal(nook_setting_print(&again, again_text), text);
        assert_int_equal(again.param_count, setting.param_count);
        for (uint32_t i = 0; i < setting.param_count; i++)
            assert_true(again.params[i].param == setting.params[i].param);
    }
}

static void test_misspelt_names_get_a_suggestion(void **state)
{
    (void)state;
    must_refuse("volum rays=4", NOOK_E_NOT_FOUND, "did you mean volume?");
    must_refuse("volume ray=4", NOOK_E_NOT_FOUND, "did you mean rays?");
    must_refuse("volume resoluton=64", NOOK_E_NOT_FOUND, "did you mean resolution?");
    must_refuse("volume ao.scael=half", NOOK_E_NOT_FOUND, "did you mean ao.scale?");
    must_refuse("volume scale=half", NOOK_E_NOT_FOUND, "did you mean ao.scale?");
    must_refuse("volume volume.rays=4", NOOK_E_NOT_FOUND, "did you mean rays?"); /* as --param takes it */
    must_refuse("magic", NOOK_E_NOT_FOUND, "choose from volume");
    must_refuse("ssao wonders=4", NOOK_E_NOT_FOUND, "there are samples");
}

static void test_wrong_values_are_refused(void **state)
{
    (void)state;
    must_refuse("", NOOK_E_ARG, "empty");
    must_refuse("  ", NOOK_E_ARG, "empty");
    must_refuse("volume rays", NOOK_E_ARG, "name=value");
    must_refuse("volume =4", NOOK_E_ARG, "name=value");
    must_refuse("volume rays=", NOOK_E_ARG, "not a number");
    must_refuse("volume rays=four", NOOK_E_ARG, "not a number");
    must_refuse("volume rays=0", NOOK_E_RANGE, "volume.rays");
    must_refuse("volume rays=1.5", NOOK_E_RANGE, "whole");
    must_refuse("volume rays=nan", NOOK_E_RANGE, "volume.rays");
    must_refuse("volume threshold=1e99", NOOK_E_RANGE, "volume.threshold");
    must_refuse("volume ao.scale=third", NOOK_E_ARG, "full|half|quarter");
    must_refuse("volume resolution=0", NOOK_E_RANGE, "resolution");
    must_refuse("volume resolution=100000", NOOK_E_RANGE, "resolution");
    must_refuse("volume rays=4 rays=8", NOOK_E_ARG, "twice");
}

static double choice(const char *name, const char *text)
{
    const nook_ao_technique *volume = nook_technique_find("volume");
    const nook_param *param = nook_param_find(volume->params, volume->param_count, name);
    assert_non_null(param);
    nook_param alone = *param;
    int32_t value = -1;
    alone.offset = 0;
    assert_int_equal(nook_param_parse(&alone, "volume", &value, text), NOOK_OK);
    return nook_param_get(&alone, &value);
}

/* All choices, by the names of the technique's table: one that moves there or comes to it is seen. */
static void test_values_that_multiply_are_those_of_the_technique_s_table(void **state)
{
    (void)state;
    const double multiply = choice("combine", "multiply"), exact = choice("combine", "union");
    const double compute = choice("path", "compute"), raster = choice("path", "raster");
    assert_true(nook_setting_values_multiply(multiply, compute));
    assert_true(nook_setting_values_multiply(multiply, raster));
    assert_true(nook_setting_values_multiply(exact, raster));
    assert_false(nook_setting_values_multiply(exact, compute));
}

static void test_volumes_multiply_by_their_product_and_where_they_are_drawn(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool multiplies;
    } settings[] = { { "volume", false },
                     { "volume combine=multiply", true },
                     { "volume path=raster", true },
                     { "volume combine=union rays=3", false },
                     { "gtao", false } };
    for (size_t i = 0; i < NOOK_COUNT(settings); i++) {
        nook_setting setting = must_parse(settings[i].text);
        assert_true(nook_setting_multiplies(&setting) == settings[i].multiplies);
    }
}

static void test_what_is_computed_is_no_part_of_a_setting(void **state)
{
    (void)state;
    must_refuse("volume ao.r_max=1", NOOK_E_ARG, "ao.r_max");
    must_refuse("volume ao.falloff=hard", NOOK_E_ARG, "ao.falloff");
    must_refuse("volume ao.falloff_tau=1", NOOK_E_ARG, "ao.falloff_tau");
    must_refuse("volume ao.count=1", NOOK_E_ARG, "ao.count");
    must_refuse("ssao resolution=64", NOOK_E_ARG, "reads no volumes");
}

static void test_text_longer_than_a_setting_is_refused(void **state)
{
    (void)state;
    char text[NOOK_SETTING_TEXT_MAX + 100];
    memset(text, ' ', sizeof text);
    memcpy(text, "volume", 6);
    text[sizeof text - 1] = '\0';
    must_refuse(text, NOOK_E_ARG, "at most");
    memset(text, 'x', sizeof text - 1); /* one long word, just within */
    text[NOOK_SETTING_TEXT_MAX - 1] = '\0';
    must_refuse(text, NOOK_E_NOT_FOUND, "technique");
}

/** A setting of code that is being exchanged, whose ssao had other rows. */
static nook_setting of_other_code(void)
{
    static const nook_param rows[] = {
        { "gone", NOOK_PARAM_INT, NOOK_UNIT_COUNT, 0, 1, 1, 9, NULL, "" },
        { "samples", NOOK_PARAM_INT, NOOK_UNIT_COUNT, 4, 16, 1, 4096, NULL, "" },
        { "bias", NOOK_PARAM_FLOAT, NOOK_UNIT_NONE, 8, 0.01, 0.0, 0.5, NULL, "" },
    };
    static const nook_ao_technique technique = {
        .version = NOOK_AO_TECHNIQUE_VERSION, .name = "ssao", .params = rows, .param_count = NOOK_COUNT(rows)
    };
    nook_setting setting = { .technique = &technique, .param_count = 4 };
    setting.params[0] = (nook_setting_param){ &rows[0], false, 5.0 };
    setting.params[1] = (nook_setting_param){ &rows[1], false, 4000.0 };
    setting.params[2] = (nook_setting_param){ &rows[2], false, 0.25 };
    setting.params[3] = (nook_setting_param){ nook_shared_param("scale"), true, 1.0 };
    return setting;
}

static void test_a_setting_of_exchanged_code_points_to_what_has_its_names_now(void **state)
{
    (void)state;
    nook_setting setting = of_other_code();
    nook_setting_renew(&setting);
    assert_ptr_equal(setting.technique, nook_technique_find("ssao"));
    must_print(&setting, "ssao samples=1024 bias=0.25 ao.scale=half");
    nook_setting again = setting;
    nook_setting_renew(&again);
    must_print(&again, "ssao samples=1024 bias=0.25 ao.scale=half");
}

static void test_a_technique_of_loaded_code_is_listed_in_the_place_of_its_name_or_last(void **state)
{
    (void)state;
    static nook_ao_technique other, stranger; /* which stays in the list */
    const nook_ao_technique *linked = nook_technique_find("gtao");
    size_t count, after;
    nook_techniques(&count);
    other = stranger = *linked;
    stranger.name = "alchemy";
    nook_techniques_list(&other);
    assert_ptr_equal(nook_technique_find("gtao"), &other);
    nook_techniques(&after);
    assert_int_equal(after, count);
    nook_techniques_list(linked);
    assert_ptr_equal(nook_technique_find("gtao"), linked);
    nook_techniques_list(&stranger);
    assert_ptr_equal(nook_technique_find("alchemy"), &stranger);
    const nook_ao_technique *const *techniques = nook_techniques(&after);
    assert_int_equal(after, count + 1);
    assert_ptr_equal(techniques[count], &stranger);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_is_read_and_printed_in_the_order_of_the_tables),
        cmocka_unit_test(test_what_is_at_its_initial_value_is_not_printed),
        cmocka_unit_test(test_assigning_again_replaces_the_value),
        cmocka_unit_test(test_floats_are_printed_with_the_digits_they_need),
        cmocka_unit_test(test_every_parameter_of_every_technique_goes_round),
        cmocka_unit_test(test_all_parameters_at_once_fit),
        cmocka_unit_test(test_misspelt_names_get_a_suggestion),
        cmocka_unit_test(test_wrong_values_are_refused),
        cmocka_unit_test(test_values_that_multiply_are_those_of_the_technique_s_table),
        cmocka_unit_test(test_volumes_multiply_by_their_product_and_where_they_are_drawn),
        cmocka_unit_test(test_what_is_computed_is_no_part_of_a_setting),
        cmocka_unit_test(test_text_longer_than_a_setting_is_refused),
        cmocka_unit_test(test_a_setting_of_exchanged_code_points_to_what_has_its_names_now),
        cmocka_unit_test(test_a_technique_of_loaded_code_is_listed_in_the_place_of_its_name_or_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
