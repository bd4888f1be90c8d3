/* The text files that say what is measured. */
#include "engine/core/file.h"
#include "game/measure/sweep.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static nook_sweep must_parse(const char *text)
{
    nook_sweep sweep;
    assert_int_equal(nook_sweep_parse("s.txt", text, strlen(text), &sweep), NOOK_OK);
    return sweep;
}

static void must_refuse(const char *text, const char *where, const char *reason)
{
    nook_sweep sweep = { .width = 12345 };
    nook_log_capture log;
    nook_log_capture_begin(&log);
    nook_result result = nook_sweep_parse("s.txt", text, strlen(text), &sweep);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_FORMAT);
    assert_int_equal(log.errors, 1);
    assert_int_equal(sweep.width, 12345);
    if (strncmp(log.text, where, strlen(where)) != 0 || !strstr(log.text, reason))
        fail_msg("\"%s\" does not begin with \"%s\" and hold \"%s\"", log.text, where, reason);
}

static void assert_settings(const nook_sweep *sweep, const char *const *texts, size_t count)
{
    char text[NOOK_SETTING_TEXT_MAX];
    for (size_t i = 0; i < sweep->setting_count && i < count; i++)
        assert_string_equal(nook_setting_print(&sweep->settings[i], text), texts[i]);
    assert_int_equal(sweep->setting_count, count);
}

static void test_a_block_is_the_initial_setting_and_every_combination(void **state)
{
    (void)state;
    static const char *const expected[] = { "ssao", "ssao samples=4 ao.scale=half", "ssao samples=4",
                                            "ssao samples=9 ao.scale=half", "ssao samples=9" };
    nook_sweep sweep = must_parse("[ssao]\nsamples = 4 9\nao.scale = half full\n");
    assert_settings(&sweep, expected, NOOK_COUNT(expected));
    nook_sweep_free(&sweep);
}

static void test_blocks_of_one_technique_join_and_the_same_setting_counts_once(void **state)
{
    (void)state;
    static const char *const expected[] = { "volume", "volume rays=4", "volume resolution=64", "ssao" };
    nook_sweep sweep = must_parse("[volume]\nrays = 4\n[volume]\nresolution = 64 256\n[volume]\nrays=4\n[ssao]");
    assert_settings(&sweep, expected, NOOK_COUNT(expected));
    nook_sweep_free(&sweep);
}

static void test_the_reference_is_taken_only_as_its_block_says(void **state)
{
    (void)state;
    static const char *const expected[] = { "reference sees=screen" };
    nook_sweep sweep = must_parse("[reference]\nsees = screen\n");
    assert_settings(&sweep, expected, NOOK_COUNT(expected));
    nook_sweep_free(&sweep);
}

static void test_what_is_measured_stands_before_the_blocks(void **state)
{
    (void)state;
    nook_sweep sweep =
        must_parse("# a comment\nsize = 64x36 # another\r\nr_max = 0.03\t0.5m 1e-1\nfalloff = hard linear\n"
                   "cameras = sampled 3\nnoise = 0.01\nrays_max = 4096\npictures = all\n\n[ssao]\n");
    assert_int_equal(sweep.width, 64);
    assert_int_equal(sweep.height, 36);
    assert_int_equal(sweep.r_max_count, 3);
    assert_true(sweep.r_max[0].value == 0.03 && !sweep.r_max[0].metres);
    assert_true(sweep.r_max[1].value == 0.5 && sweep.r_max[1].metres);
    assert_true(sweep.r_max[2].value == 0.1 && !sweep.r_max[2].metres);
    assert_int_equal(sweep.falloff_count, 2);
    assert_int_equal(sweep.falloffs[0], 0);
    assert_int_equal(sweep.falloffs[1], 1);
    assert_int_equal(sweep.camera_count, 3);
    assert_true(sweep.cameras_sampled);
    assert_true(sweep.noise == 0.01);
    assert_int_equal(sweep.rays_max, 4096);
    assert_true(sweep.all_pictures);
    nook_sweep_free(&sweep);
    sweep = must_parse("cameras = scene 2\n[ssao]");
    assert_int_equal(sweep.camera_count, 2);
    assert_false(sweep.cameras_sampled);
    assert_true(sweep.r_max_count == 1 && sweep.falloff_count == 1 && sweep.width > 0 && sweep.noise > 0.0);
    nook_sweep_free(&sweep);
}

static void test_what_is_wrong_is_said_with_file_and_line(void **state)
{
    (void)state;
    must_refuse("\n# nothing\n", "s.txt:", "no setting");
    must_refuse("[ssao]\n\nsampels = 4\n", "s.txt:3:", "samples");
    must_refuse("[ssao]\nsamples = 4 0\n", "s.txt:2:", "1 to 1024");
    must_refuse("[ssao]\nsamples = 4 many\n", "s.txt:2:", "many");
    must_refuse("[ssao]\nsamples =\n", "s.txt:2:", "name = values");
    must_refuse("[ssao]\nsamples 4\n", "s.txt:2:", "name = values");
    must_refuse("[ssao]\nsamples = 4\nsamples = 8\n", "s.txt:3:", "line 2");
    must_refuse("[ssao]\nresolution = 64\n", "s.txt:2:", "no volumes");
    must_refuse("[ssao]\nao.r_max = 1\n", "s.txt:2:", "r_max");
    must_refuse("[saao]\n", "s.txt:1:", "ssao");
    must_refuse("[ssao\n", "s.txt:1:", "[technique]");
    must_refuse("size = 64\n[ssao]", "s.txt:1:", "WxH");
    must_refuse("size = 64x36x2\n[ssao]", "s.txt:1:", "WxH");
    must_refuse("size = 0x36\n[ssao]", "s.txt:1:", "WxH");
    must_refuse("r_max = 0\n[ssao]", "s.txt:1:", "diagonal");
    must_refuse("r_max = m\n[ssao]", "s.txt:1:", "diagonal");
    must_refuse("falloff = cubic\n[ssao]", "s.txt:1", "quadratic");
    must_refuse("cameras = two\n[ssao]", "s.txt:1:", "scene N");
    must_refuse("cameras = scene 0\n[ssao]", "s.txt:1:", "scene N");
    must_refuse("noise = -1\n[ssao]", "s.txt:1:", "above 0");
    must_refuse("rays_max = 1\n[ssao]", "s.txt:1:", "2 to");
    must_refuse("pictures = some\n[ssao]", "s.txt:1:", "front");
    must_refuse("noise = 0.1\nnoise = 0.2\n[ssao]", "s.txt:2:", "twice");
    must_refuse("samples = 4\n[ssao]", "s.txt:1:", "rays_max");
}

static void test_more_combinations_than_anyone_measures_are_refused(void **state)
{
    (void)state;
    char text[8192];
    static const char *const names[] = { "directions", "steps", "ray_steps" };
    size_t used = (size_t)snprintf(text, sizeof text, "[hsao]\n");
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        used += (size_t)snprintf(text + used, sizeof text - used, "%s =", names[i]);
        for (int value = 1; value <= 32; value++)
            used += (size_t)snprintf(text + used, sizeof text - used, " %d", value);
        used += (size_t)snprintf(text + used, sizeof text - used, "\n");
    }
    must_refuse(text, "s.txt:2:", "combinations");
}

static void test_a_parameter_of_the_command_line_is_in_every_setting_of_its_technique(void **state)
{
    (void)state;
    static const char *const surfels[] = { "volume kind=surfel", "volume rays=4 kind=surfel", "ssao" };
    static const char *const fewer[] = { "volume rays=4 kind=surfel", "ssao" };
    static const char *const half[] = { "volume rays=4 kind=surfel ao.scale=half", "ssao ao.scale=half" };
    nook_sweep sweep = must_parse("[volume]\nrays = 4\n[ssao]\n");
    sweep.width = 12345;
    assert_int_equal(nook_sweep_param(&sweep, "volume.kind=surfel"), NOOK_OK);
    assert_settings(&sweep, surfels, NOOK_COUNT(surfels));
    assert_int_equal(nook_sweep_param(&sweep, "volume.rays=4"), NOOK_OK); /* two are the same now */
    assert_settings(&sweep, fewer, NOOK_COUNT(fewer));
    assert_int_equal(nook_sweep_param(&sweep, "ao.scale=half"), NOOK_OK);
    assert_settings(&sweep, half, NOOK_COUNT(half));
    assert_int_equal(sweep.width, 12345);
    nook_sweep_free(&sweep);
}

static void test_a_wrong_parameter_of_the_command_line_is_refused_in_one_line_and_changes_nothing(void **state)
{
    (void)state;
    static const char *const settings[] = { "volume", "volume rays=4" };
    static const struct {
        const char *text, *reason;
    } cases[] = {
        { "", "give TECHNIQUE.NAME=VALUE" },
        { "volume.kind", "give TECHNIQUE.NAME=VALUE" },
        { "kind=surfel", "give TECHNIQUE.NAME=VALUE" },
        { "kind=a.b", "give TECHNIQUE.NAME=VALUE" },
        { "volum.kind=surfel", "volum" },
        { "volume.kinds=surfel", "kinds" },
        { "volume.kind=surfels", "surfels" },
        { "volume.rays=0", "rays" },
        { "ssao.samples=4", "no setting of ssao" },
        { "ao.r_max=1", "what is measured" },
    };
    nook_sweep sweep = must_parse("[volume]\nrays = 4\n");
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        nook_log_capture log;
        nook_log_capture_begin(&log);
        nook_result result = nook_sweep_param(&sweep, cases[i].text);
        nook_log_capture_end();
        assert_int_not_equal(result, NOOK_OK);
        assert_int_equal(log.errors, 1);
        if (!strstr(log.text, cases[i].reason))
            fail_msg("%s: \"%s\" does not hold \"%s\"", cases[i].text, log.text, cases[i].reason);
        assert_settings(&sweep, settings, NOOK_COUNT(settings));
    }
    nook_sweep_free(&sweep);
}

static void test_shipped_suites_are_read(void **state)
{
    (void)state;
    static const char *const suites[] = { "quick", "full", "front", "falloff", "demo_large" };
    const char *root = getenv("NOOK_ROOT");
    for (size_t i = 0; i < NOOK_COUNT(suites); i++) {
        char path[4096];
        nook_sweep sweep;
        snprintf(path, sizeof path, "%s/content/suites/%s.txt", root ? root : ".", suites[i]);
        assert_int_equal(nook_sweep_read(path, &sweep), NOOK_OK);
        assert_in_range(sweep.setting_count, i < 4 ? 20 : 6, 80); /* the last is for one question */
        nook_sweep_free(&sweep);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_block_is_the_initial_setting_and_every_combination),
        cmocka_unit_test(test_blocks_of_one_technique_join_and_the_same_setting_counts_once),
        cmocka_unit_test(test_the_reference_is_taken_only_as_its_block_says),
        cmocka_unit_test(test_what_is_measured_stands_before_the_blocks),
        cmocka_unit_test(test_what_is_wrong_is_said_with_file_and_line),
        cmocka_unit_test(test_more_combinations_than_anyone_measures_are_refused),
        cmocka_unit_test(test_a_parameter_of_the_command_line_is_in_every_setting_of_its_technique),
        cmocka_unit_test(test_a_wrong_parameter_of_the_command_line_is_refused_in_one_line_and_changes_nothing),
        cmocka_unit_test(test_shipped_suites_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
