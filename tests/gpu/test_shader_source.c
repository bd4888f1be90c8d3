#include "engine/gpu/shader_source.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

/* A text of three lines: #version of the file, a define, and line 41 of the file. */
static void assert_translates(const char *line, const char *expected)
{
    nook_shader_file files[] = { { .path = (char[]){ "(defines)" } }, { .path = (char[]){ "shaders/a.glsl" } } };
    nook_shader_line lines[] = { { 1, 7 }, { 0, 1 }, { 1, 41 } };
    const nook_shader_source source = { .lines = lines, .line_count = 3, .files = files, .file_count = 2 };
    char text[256];
    nook_shader_source_translate(&source, line, strlen(line), text, sizeof text);
    assert_string_equal(text, expected);
}

static void test_messages_of_mesa_name_files(void **state)
{
    (void)state;
    assert_translates("0:3(12): error: `x' undeclared", "shaders/a.glsl:41: error: `x' undeclared");
    assert_translates("0:2(1): warning: odd", "(defines):1: warning: odd");
}

static void test_messages_of_nvidia_name_files(void **state)
{
    (void)state;
    assert_translates("0(3) : error C1008: undefined variable \"x\"",
                      "shaders/a.glsl:41: error C1008: undefined variable \"x\"");
}

static void test_messages_of_amd_name_files(void **state)
{
    (void)state;
    assert_translates("ERROR: 0:3: 'x' : undeclared identifier",
                      "shaders/a.glsl:41: error: 'x' : undeclared identifier");
}

static void test_other_messages_stay_as_they_are(void **state)
{
    (void)state;
    assert_translates("error: linking failed", "error: linking failed");
    assert_translates("0:4(12): error: behind the end", "0:4(12): error: behind the end");
    assert_translates("0:0(12): error: before the start", "0:0(12): error: before the start");
    assert_translates("1:3(12): error: not our text", "1:3(12): error: not our text");
    assert_translates("0:3", "0:3");
    assert_translates("99999999999999999999:1(1): error: x", "99999999999999999999:1(1): error: x");
}

static void test_translation_is_cut_to_its_capacity(void **state)
{
    (void)state;
    nook_shader_file file = { .path = (char[]){ "a" } };
    nook_shader_line from = { 0, 7 };
    const nook_shader_source source = { .lines = &from, .line_count = 1, .files = &file, .file_count = 1 };
    char text[9] = "--------", line[5000];
    snprintf(line, sizeof line, "0:1(1): %04000d", 0);
    nook_shader_source_translate(&source, line, strlen(line), text, sizeof text);
    assert_string_equal(text, "a:7: 000");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_messages_of_mesa_name_files),
        cmocka_unit_test(test_messages_of_nvidia_name_files),
        cmocka_unit_test(test_messages_of_amd_name_files),
        cmocka_unit_test(test_other_messages_stay_as_they_are),
        cmocka_unit_test(test_translation_is_cut_to_its_capacity),
    };
    return cmocka_run_group_tests_name("shader sources", tests, NULL, NULL);
}
