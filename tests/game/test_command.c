#include "game/commands/commands.h"
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

/** What the stand-in commands saw last. */
static struct {
    const nook_app *app;
    int argc;
    const char *words[4];
} seen;

static int note(const nook_app *app, int argc, char **argv, int code)
{
    seen.app = app;
    seen.argc = argc;
    for (int i = 0; i < 4; i++)
        seen.words[i] = i < argc ? argv[i] : NULL;
    return code;
}

static int run_compare(const nook_app *app, int argc, char **argv)
{
    return note(app, argc, argv, 10);
}

static int run_bake(const nook_app *app, int argc, char **argv)
{
    return note(app, argc, argv, 20);
}

static int run_version(const nook_app *app, int argc, char **argv)
{
    return note(app, argc, argv, 30);
}

static const nook_command commands[] = { { "compare", "compares", run_compare },
                                         { "bake", "bakes", run_bake },
                                         { "version", "says which", run_version } };
static const nook_app app = { .root = "/somewhere" };

static int dispatch(int argc, char **argv)
{
    memset(&seen, 0, sizeof seen);
    return nook_command_dispatch(&app, commands, sizeof commands / sizeof *commands, argc, argv);
}

#define DISPATCH(...) \
    dispatch((int)(sizeof((char *[]){ "nook", __VA_ARGS__ }) / sizeof(char *)), (char *[]){ "nook", __VA_ARGS__, NULL })

static void test_a_command_gets_its_own_words_and_the_app(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("bake", "scene.glb", "--resolution"), 20);
    assert_ptr_equal(seen.app, &app);
    assert_int_equal(seen.argc, 3);
    assert_string_equal(seen.words[0], "bake");
    assert_string_equal(seen.words[2], "--resolution");
}

static void test_no_command_means_compare(void **state)
{
    (void)state;
    assert_int_equal(dispatch(1, (char *[]){ "nook", NULL }), 10);
    assert_int_equal(seen.argc, 1);
}

static void test_an_option_in_place_of_a_command_goes_to_compare(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("--size", "4x4"), 10);
    assert_int_equal(seen.argc, 3);
    assert_string_equal(seen.words[1], "--size");
    assert_string_equal(seen.words[2], "4x4");
}

static void test_the_option_version_is_the_command(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("--version"), 30);
    assert_int_equal(seen.argc, 1);
    assert_int_equal(DISPATCH("version"), 30);
}

static void test_help_with_a_name_asks_that_command_for_help(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("help", "bake"), 20);
    assert_int_equal(seen.argc, 2);
    assert_string_equal(seen.words[1], "--help");
}

static void test_help_alone_runs_no_command(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("--help"), NOOK_EXIT_OK);
    assert_null(seen.app);
}

static void test_an_unknown_command_is_a_usage_error(void **state)
{
    (void)state;
    assert_int_equal(DISPATCH("bak"), NOOK_EXIT_USAGE);
    assert_int_equal(DISPATCH("help", "nothing"), NOOK_EXIT_USAGE);
    assert_null(seen.app);
}

static void test_the_table_has_well_formed_rows(void **state)
{
    (void)state;
    size_t count = 0;
    const nook_command *table = nook_command_table(&count);
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        assert_non_null(table[i].run);
        assert_true(strlen(table[i].summary) > 0 && strlen(table[i].summary) < 90);
        assert_ptr_equal(nook_command_find(table, count, table[i].name), &table[i]);
        for (const char *letter = table[i].name; *letter; letter++)
            assert_true(islower((unsigned char)*letter));
    }
    assert_null(nook_command_find(table, count, "nothing"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_command_gets_its_own_words_and_the_app),
        cmocka_unit_test(test_no_command_means_compare),
        cmocka_unit_test(test_an_option_in_place_of_a_command_goes_to_compare),
        cmocka_unit_test(test_the_option_version_is_the_command),
        cmocka_unit_test(test_help_with_a_name_asks_that_command_for_help),
        cmocka_unit_test(test_help_alone_runs_no_command),
        cmocka_unit_test(test_an_unknown_command_is_a_usage_error),
        cmocka_unit_test(test_the_table_has_well_formed_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
