#include "game/option.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

/** What the options of the command under test write into. */
typedef struct settings {
    bool json;
    const char *out;
    int32_t rays, frames;
    double r_max;
    nook_option_size size;
    int32_t falloff;
    nook_option_list params;
    char letter; /**< By read_letter. */
} settings;

static bool read_letter(void *target, const char *text)
{
    if (strlen(text) != 1)
        return false;
    *(char *)target = text[0];
    return true;
}

/** Parses the given words, after the command's name, ended by NULL. */
static nook_parse parse(settings *to, nook_arguments *arguments, char **words)
{
    const nook_option options[] = {
        { .name = "json", .kind = NOOK_OPTION_FLAG, .target = &to->json, .help = "print JSON" },
        { .name = "out", .kind = NOOK_OPTION_TEXT, .target = &to->out, .placeholder = "DIR", .help = "folder" },
        { .name = "rays", .kind = NOOK_OPTION_INT, .target = &to->rays, .lowest = 1, .highest = 64 },
        { .name = "frames", .kind = NOOK_OPTION_INT, .target = &to->frames, .lowest = 1, .highest = INT32_MAX },
        { .name = "r-max", .kind = NOOK_OPTION_NUMBER, .target = &to->r_max },
        { .name = "size", .kind = NOOK_OPTION_SIZE, .target = &to->size, .lowest = 1, .highest = 16384 },
        { .name = "falloff", .kind = NOOK_OPTION_CHOICE, .target = &to->falloff, .choices = "hard|linear|wendland" },
        { .name = "param", .kind = NOOK_OPTION_LIST, .target = &to->params, .placeholder = "NAME=VALUE" },
        { .name = "letter",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &to->letter,
          .read = read_letter,
          .expects = "a letter" },
    };
    const nook_usage usage = {
        .command = "compare",
        .summary = "Compares.",
        .positionals = "SCENE [OTHER]",
        .positional_min = 1,
        .positional_max = 2,
        .options = options,
        .option_count = sizeof options / sizeof options[0],
    };
    char *argv[80] = { "compare" };
    int argc = 1;
    for (; words[argc - 1]; argc++)
        argv[argc] = words[argc - 1];
    return nook_options_parse(&usage, argc, argv, arguments);
}

#define PARSE(...) parse(&to, &arguments, (char *[]){ __VA_ARGS__, NULL })

static void check_wrong(const char *expected_message, char **words)
{
    settings to = { .rays = 7, .r_max = 0.5, .falloff = 2, .size = { 3, 4 } };
    nook_arguments arguments;
    assert_int_equal(parse(&to, &arguments, words), NOOK_PARSE_WRONG);
    assert_string_equal(arguments.message, expected_message);
    assert_int_equal(to.rays, 7);
    assert_int_equal(to.size.width, 3);
    assert_int_equal(to.size.height, 4);
    assert_int_equal(to.falloff, 2);
    assert_true(to.r_max == 0.5);
}

#define CHECK_WRONG(message, ...) check_wrong(message, (char *[]){ __VA_ARGS__, NULL })

static void test_options_read_every_kind_of_value(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    assert_int_equal(PARSE("--json", "--out", "here", "a.glb", "--rays", "64", "--r-max=-1.5e-2", "--size", "640x360",
                           "--falloff=wendland", "--letter", "q"),
                     NOOK_PARSE_RUN);
    assert_true(to.json);
    assert_string_equal(to.out, "here");
    assert_int_equal(to.rays, 64);
    assert_true(to.r_max == -0.015);
    assert_int_equal(to.size.width, 640);
    assert_int_equal(to.size.height, 360);
    assert_int_equal(to.falloff, 2);
    assert_int_equal(to.letter, 'q');
    assert_int_equal(arguments.positional_count, 1);
    assert_string_equal(arguments.positionals[0], "a.glb");
    assert_string_equal(arguments.message, "");
}

static void test_options_that_are_not_given_keep_their_targets(void **state)
{
    (void)state;
    settings to = { .rays = 12, .falloff = 1 };
    nook_arguments arguments;
    assert_int_equal(PARSE("a.glb"), NOOK_PARSE_RUN);
    assert_int_equal(to.rays, 12);
    assert_int_equal(to.falloff, 1);
    assert_false(to.json);
    assert_null(to.out);
}

static void test_options_collect_a_repeated_option_in_order(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    assert_int_equal(PARSE("--param", "volume.rays=8", "x", "--param=ssao.radius=1"), NOOK_PARSE_RUN);
    assert_int_equal(to.params.count, 2);
    assert_string_equal(to.params.items[0], "volume.rays=8");
    assert_string_equal(to.params.items[1], "ssao.radius=1"); /* only the first '=' separates */
}

static void test_options_refuse_more_repeats_than_fit(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    char *words[NOOK_OPTION_LIST_MAX + 2] = { NULL };
    for (int i = 0; i <= NOOK_OPTION_LIST_MAX; i++)
        words[i] = "--param=a=1";
    assert_int_equal(parse(&to, &arguments, words), NOOK_PARSE_WRONG);
    assert_string_equal(arguments.message, "nook compare: --param a=1: give NAME=VALUE, at most 64 times");
}

static void test_options_take_a_value_that_starts_with_a_dash(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    assert_int_equal(PARSE("--r-max", "-2", "x"), NOOK_PARSE_RUN);
    assert_true(to.r_max == -2.0);
}

static void test_two_dashes_end_the_options(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    assert_int_equal(PARSE("--", "--json", "-h"), NOOK_PARSE_RUN);
    assert_false(to.json);
    assert_int_equal(arguments.positional_count, 2);
    assert_string_equal(arguments.positionals[0], "--json");
    assert_string_equal(arguments.positionals[1], "-h");
}

static void test_options_refuse_bad_sizes(void **state)
{
    (void)state;
    const char *const bad[] = { "0x600", "600", "x600", "600x", "600x16385", "-1x5", "6 x6", "600x600x1", "1e2x5", "" };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char expected[128];
        snprintf(expected, sizeof expected, "nook compare: --size %s: give WxH, each from 1 to 16384",
                 *bad[i] ? bad[i] : "''");
        CHECK_WRONG(expected, "a.glb", "--size", (char *)bad[i]);
    }
}

static void test_options_refuse_bad_whole_numbers(void **state)
{
    (void)state;
    const char *const bad[] = { "0", "65", "8x", "1.5", "", "99999999999999999999", " 4", "0x10", "ten" };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char expected[128];
        snprintf(expected, sizeof expected, "nook compare: --rays %s: give a whole number from 1 to 64",
                 *bad[i] ? bad[i] : "''");
        CHECK_WRONG(expected, "a.glb", "--rays", (char *)bad[i]);
    }
}

static void test_whole_numbers_are_asked_for_with_all_their_digits(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --frames 0: give a whole number from 1 to 2147483647", "a.glb", "--frames", "0");
}

static void test_options_refuse_numbers_that_are_not_finite(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --r-max inf: give a number", "a.glb", "--r-max", "inf");
    CHECK_WRONG("nook compare: --r-max nan: give a number", "a.glb", "--r-max=nan");
    CHECK_WRONG("nook compare: --r-max 1e999: give a number", "a.glb", "--r-max", "1e999");
    CHECK_WRONG("nook compare: --r-max 1,5: give a number", "a.glb", "--r-max", "1,5");
}

static void test_options_refuse_a_choice_that_does_not_exist(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --falloff lin: give one of hard linear wendland", "a.glb", "--falloff", "lin");
    CHECK_WRONG("nook compare: --falloff '': give one of hard linear wendland", "a.glb", "--falloff=");
}

static void test_options_name_the_misspelt_option_and_the_likely_one(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --sise: no such option; did you mean --size?", "--sise", "2x2");
    CHECK_WRONG("nook compare: --resolution: no such option; --help lists them", "--resolution=2");
    CHECK_WRONG("nook compare: -j: no such option; options start with --", "-j");
}

static void test_options_refuse_a_missing_value_and_a_value_too_many(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --rays: its value is missing; give a whole number from 1 to 64", "a.glb", "--rays");
    CHECK_WRONG("nook compare: --json: takes no value", "a.glb", "--json=yes");
}

static void test_options_refuse_wrong_numbers_of_arguments(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: an argument is missing; usage: nook compare [OPTIONS] SCENE [OTHER]", "--json");
    CHECK_WRONG("nook compare: c: one argument too many; usage: nook compare [OPTIONS] SCENE [OTHER]", "a", "b", "c");
}

static void test_a_custom_option_decides_what_it_takes(void **state)
{
    (void)state;
    CHECK_WRONG("nook compare: --letter qq: give a letter", "a.glb", "--letter", "qq");
}

static void test_help_is_found_even_behind_an_error(void **state)
{
    (void)state;
    settings to = { 0 };
    nook_arguments arguments;
    assert_int_equal(PARSE("--rays", "0", "--help"), NOOK_PARSE_HELP);
    assert_int_equal(PARSE("-h"), NOOK_PARSE_HELP);
}

static void test_printed_help_holds_every_option(void **state)
{
    (void)state;
    int32_t choice = 0;
    bool flag = false;
    const nook_option options[] = {
        { .name = "flag", .kind = NOOK_OPTION_FLAG, .target = &flag, .help = "raises it" },
        { .name = "mode",
          .kind = NOOK_OPTION_CHOICE,
          .target = &choice,
          .placeholder = "M",
          .help = "how",
          .choices = "a|b" },
    };
    const nook_usage usage = { .command = "wave",
                               .summary = "Waves.",
                               .positionals = "[AT]",
                               .positional_max = 1,
                               .options = options,
                               .option_count = 2,
                               .details = "The end.\n" };
    char text[1024] = "";
    FILE *stream = fmemopen(text, sizeof text, "w");
    assert_non_null(stream);
    nook_options_print_help(&usage, stream);
    fclose(stream);
    assert_string_equal(text, "usage: nook wave [OPTIONS] [AT]\n\nWaves.\n\n"
                              "  --flag                     raises it\n"
                              "  --mode M                   how (a|b)\n"
                              "  --help                     print this\n\nThe end.\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options_read_every_kind_of_value),
        cmocka_unit_test(test_options_that_are_not_given_keep_their_targets),
        cmocka_unit_test(test_options_collect_a_repeated_option_in_order),
        cmocka_unit_test(test_options_refuse_more_repeats_than_fit),
        cmocka_unit_test(test_options_take_a_value_that_starts_with_a_dash),
        cmocka_unit_test(test_two_dashes_end_the_options),
        cmocka_unit_test(test_options_refuse_bad_sizes),
        cmocka_unit_test(test_options_refuse_bad_whole_numbers),
        cmocka_unit_test(test_whole_numbers_are_asked_for_with_all_their_digits),
        cmocka_unit_test(test_options_refuse_numbers_that_are_not_finite),
        cmocka_unit_test(test_options_refuse_a_choice_that_does_not_exist),
        cmocka_unit_test(test_options_name_the_misspelt_option_and_the_likely_one),
        cmocka_unit_test(test_options_refuse_a_missing_value_and_a_value_too_many),
        cmocka_unit_test(test_options_refuse_wrong_numbers_of_arguments),
        cmocka_unit_test(test_a_custom_option_decides_what_it_takes),
        cmocka_unit_test(test_help_is_found_even_behind_an_error),
        cmocka_unit_test(test_printed_help_holds_every_option),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
