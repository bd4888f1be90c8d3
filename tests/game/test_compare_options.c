#include "game/compare/options.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const nook_app app = { .root = "/somewhere" };

/* What `compare` makes of these words. */
static bool read_words(nook_compare_options *options, const char *const *words, int count)
{
    char *argv[16] = { (char *)"compare" };
    int exit_code = -1;
    assert_true(count < 15);
    for (int i = 0; i < count; i++)
        argv[i + 1] = (char *)words[i];
    bool understood = nook_compare_options_read(&app, count + 1, argv, options, &exit_code);
    assert_int_equal(exit_code, understood ? -1 : NOOK_EXIT_USAGE);
    return understood;
}

#define READ(options, ...)                                    \
    read_words(options, (const char *const[]){ __VA_ARGS__ }, \
               (int)(sizeof((const char *const[]){ __VA_ARGS__ }) / sizeof(char *)))

static void test_nothing_given_means_the_demo_level_and_every_technique(void **state)
{
    (void)state;
    nook_compare_options options;
    assert_true(read_words(&options, NULL, 0));
    assert_string_equal(options.scene, "/somewhere/content/hall/hall.glb");
    assert_string_equal(options.cache, "/somewhere/cache");
    assert_string_equal(options.out, "out");
    assert_null(options.camera);
    assert_null(options.techniques);
    assert_null(options.falloff);
    assert_null(options.ao_scale);
    assert_true(options.r_max == 0.0);
    assert_int_equal(options.backend, NOOK_BACKEND_AUTO);
    assert_int_equal(options.reference_rays, 0);
    assert_false(options.no_window || options.json || options.no_instability);
}

static void test_every_option_reaches_its_field(void **state)
{
    (void)state;
    nook_compare_options options;
    assert_true(READ(&options, "a.glb", "--size=600x500", "--r-max", "0.25", "--techniques", "a,b", "--param", "a.b=1",
                     "--param", "c.d=2", "--no-window", "--backend", "osmesa"));
    assert_string_equal(options.scene, "a.glb");
    assert_int_equal(options.size.width, 600);
    assert_int_equal(options.size.height, 500);
    assert_true(options.r_max == 0.25);
    assert_string_equal(options.techniques, "a,b");
    assert_int_equal(options.params.count, 2);
    assert_string_equal(options.params.items[1], "c.d=2");
    assert_true(options.no_window);
    assert_int_equal(options.backend, NOOK_BACKEND_OSMESA);
    assert_true(READ(&options, "--camera", "-1,2,3,0,0,0,60", "--falloff", "linear", "--reference-rays", "64",
                     "--frames", "3", "--out", "there", "--cache", "here", "--no-instability", "--json"));
    assert_string_equal(options.camera, "-1,2,3,0,0,0,60");
    assert_string_equal(options.falloff, "linear");
    assert_int_equal(options.reference_rays, 64);
    assert_int_equal(options.frames, 3);
    assert_string_equal(options.out, "there");
    assert_string_equal(options.cache, "here");
    assert_true(options.json && options.no_instability);
}

static void test_scale_is_understood_in_all_its_spellings(void **state)
{
    (void)state;
    static const char *const spellings[][2] = { { "full", "full" },       { "1", "full" },    { "half", "half" },
                                                { "2", "half" },          { "1/2", "half" },  { "0.5", "half" },
                                                { "quarter", "quarter" }, { "4", "quarter" }, { "1/4", "quarter" } };
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
        nook_compare_options options;
        assert_true(READ(&options, "--ao-scale", spellings[i][0]));
        assert_string_equal(options.ao_scale, spellings[i][1]);
    }
}

static void test_absurd_values_are_refused_before_anything_is_done(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        { "--size", "0x100" },   { "--size", "100x-1" },    { "--size", "16385x16" },  { "--size", "1e9x1e9" },
        { "--size", "600" },     { "--r-max", "0" },        { "--r-max", "-1" },       { "--r-max", "nan" },
        { "--r-max", "inf" },    { "--r-max", "1e999" },    { "--ao-scale", "3" },     { "--frames", "0" },
        { "--frames", "1.5" },   { "--out", "" },           { "--backend", "vulkan" }, { "--reference-rays", "0" },
        { "--resolution", "0" }, { "--resolution", "513" }, { "--nonsense", "1" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        nook_compare_options options;
        if (READ(&options, wrong[i][0], wrong[i][1]))
            fail_msg("%s %s was taken", wrong[i][0], wrong[i][1]);
    }
}

static void test_two_scenes_are_one_too_many(void **state)
{
    (void)state;
    nook_compare_options options;
    assert_false(READ(&options, "a.glb", "b.glb"));
}

static void test_views_are_a_list_of_known_names(void **state)
{
    (void)state;
    nook_compare_options options;
    assert_true(READ(&options, "--view", "light,shadow_map,occlusion_map,light"));
    assert_int_equal(options.views.count, 3); /* one file each */
    assert_int_equal(options.views.items[0], NOOK_VIEW_LIGHT);
    assert_int_equal(options.views.items[1], NOOK_VIEW_SHADOW_MAP);
    assert_int_equal(options.views.items[2], NOOK_VIEW_OCCLUSION_MAP);
    for (int i = 0; i < NOOK_VIEW_COUNT; i++) {
        assert_true(READ(&options, "--view", nook_view_name((nook_view)i)));
        assert_int_equal(options.views.items[0], i);
    }
    assert_false(READ(&options, "--view", "lights"));
    assert_false(READ(&options, "--view", "light,"));
    assert_false(READ(&options, "--view", ","));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_given_means_the_demo_level_and_every_technique),
        cmocka_unit_test(test_every_option_reaches_its_field),
        cmocka_unit_test(test_scale_is_understood_in_all_its_spellings),
        cmocka_unit_test(test_absurd_values_are_refused_before_anything_is_done),
        cmocka_unit_test(test_two_scenes_are_one_too_many),
        cmocka_unit_test(test_views_are_a_list_of_known_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
