/* A command line, for the record, as a shell takes it. */
#include "game/command_line.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void test_plain_arguments_stand_as_they_are(void **state)
{
    (void)state;
    char *argv[] = { "measure", "a_b/c-1.glb", "--size=3x4", "0.5m" }, out[256];
    assert_string_equal(nook_command_line_join(4, argv, out, sizeof out), "./nook measure a_b/c-1.glb --size=3x4 0.5m");
}

static void test_what_a_shell_would_read_is_quoted(void **state)
{
    (void)state;
    char *argv[] = { "x y", "", "$HOME", "it's", "''", "a\\b" }, out[256];
    assert_string_equal(nook_command_line_join(6, argv, out, sizeof out),
                        "./nook 'x y' '' '$HOME' 'it'\\''s' ''\\'''\\''' 'a\\b'");
}

/* A shell is asked what it makes of it. */
static void test_a_shell_reads_back_what_was_given(void **state)
{
    (void)state;
    char *argv[] = { "a'b c\"d`e$f\\g*h?i[j]k{l,m}n~o#p!q;r&s|t<u>v(w)x\ty\nz" }, out[256], line[512],
         read_back[256] = "";
    nook_command_line_join(1, argv, out, sizeof out);
    snprintf(line, sizeof line, "printf %%s %s", out + strlen("./nook "));
    FILE *shell = popen(line, "r");
    assert_non_null(shell);
    size_t size = fread(read_back, 1, sizeof read_back - 1, shell);
    assert_int_equal(pclose(shell), 0);
    assert_int_equal(size, strlen(argv[0]));
    assert_string_equal(read_back, argv[0]);
}

static void test_a_long_line_is_cut_and_ended(void **state)
{
    (void)state;
    char *argv[] = { "measure", "it's" }, out[32];
    for (size_t capacity = 1; capacity < sizeof out; capacity++) {
        memset(out, 'x', sizeof out);
        nook_command_line_join(2, argv, out, capacity);
        assert_true(strlen(out) < capacity);
        assert_int_equal(strncmp(out, "./nook measure 'it'\\''s'", strlen(out)), 0);
        assert_true(out[capacity] == 'x');
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain_arguments_stand_as_they_are),
        cmocka_unit_test(test_what_a_shell_would_read_is_quoted),
        cmocka_unit_test(test_a_shell_reads_back_what_was_given),
        cmocka_unit_test(test_a_long_line_is_cut_and_ended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
