#include "engine/core/file.h"
#include "engine/core/log.h"
#include "tests/support/scratch.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

#define COMPUTE "layout(local_size_x = 8) in;\n"
#define OUTPUT "layout(std430, binding = 0) buffer Output { uint values[]; };\n"

/* A folder of shaders of its own, and everything that is logged. */
typedef struct fixture {
    char root[512];
    test_gpu test;
    char log[8192];
    int lines;
} fixture;

static void keep_line(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    fixture *self = user;
    size_t used = strlen(self->log);
    (void)level, (void)file, (void)line;
    snprintf(self->log + used, sizeof self->log - used, "%s\n", text);
    self->lines++;
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    char folder[600];
    if (!self)
        return -1;
    nook_scratch_path(self->root, sizeof self->root, "shader_root");
    nook_path_join(folder, sizeof folder, self->root, "shaders/nook");
    *state = self;
    if (nook_directory_make(folder) != NOOK_OK || test_gpu_create(self->root, &self->test) != NOOK_OK)
        return -1;
    nook_log_set_sink(keep_line, self);
    return 0;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_log_set_sink(NULL, NULL);
    bool failed = nook_gpu_check(self->test.gpu, "the test");
    test_gpu_destroy(&self->test);
    free(self);
    return failed ? -1 : 0;
}

static void put(fixture *self, const char *name, const char *text)
{
    char path[600];
    nook_path_join(path, sizeof path, self->root, name);
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
}

static nook_result compute(fixture *self, const char *path, const char *defines, nook_program *out_program)
{
    return nook_program_compute(self->test.gpu, path, defines, out_program);
}

/* It must fail with this code, leave the output alone and say this. */
static void assert_fails(fixture *self, const char *path, const char *defines, nook_result code, const char *message)
{
    nook_program program = { .handle = 4711 };
    assert_int_equal(compute(self, path, defines, &program), code);
    assert_int_equal(program.handle, 4711);
    if (!strstr(self->log, message))
        fail_msg("expected '%s' in the log:\n%s", message, self->log);
}

/* Runs a program whose first invocation writes values[0] and values[1]. */
static void run(fixture *self, const char *path, const char *defines, uint32_t out_values[2])
{
    nook_program program = { 0 };
    nook_buffer buffer;
    nook_result result = compute(self, path, defines, &program);
    if (result != NOOK_OK)
        fail_msg("%s", self->log);
    assert_int_equal(nook_buffer_create(self->test.gpu, NULL, 8, &buffer), NOOK_OK);
    nook_bind_storage(self->test.gpu, 0, buffer);
    nook_dispatch(self->test.gpu, program, 1, 1, 1);
    nook_buffer_read(self->test.gpu, buffer, 0, out_values, 8);
    nook_buffer_destroy(self->test.gpu, &buffer);
}

static void test_error_in_an_included_file_names_that_file_and_line(void **state)
{
    fixture *self = *state;
    put(self, "shaders/nook/good.glsl", "float good() { return 1.0; }\n\n\n");
    put(self, "shaders/nook/bad.glsl", "float fine() { return 1.0; }\n\nfloat bad() { return no_such_name; }\n");
    put(self, "shaders/main.comp.glsl",
        COMPUTE "#include \"nook/good.glsl\"\n#include \"shaders/nook/bad.glsl\"\nvoid main() { }\n");
    assert_fails(self, "shaders/main.comp.glsl", "", NOOK_E_DEVICE, "shaders/nook/bad.glsl:3: error: ");
    assert_non_null(strstr(self->log, "no_such_name"));
}

static void test_error_behind_an_include_names_the_line_of_its_own_file(void **state)
{
    fixture *self = *state;
    put(self, "shaders/nook/long.glsl", "float a;\nfloat b;\nfloat c;\nfloat d;\nfloat e;\nfloat f;\n");
    put(self, "main.comp.glsl",
        COMPUTE "\n#include \"nook/long.glsl\"\n// comment\nvoid main() { no_such_name = 1; }\n");
    assert_fails(self, "main.comp.glsl", "#define UNUSED 1\n", NOOK_E_DEVICE, "main.comp.glsl:5: error: ");
}

static void test_error_behind_own_version_and_pragma_keeps_its_line(void **state)
{
    fixture *self = *state;
    put(self, "main.comp.glsl", "// first\n#version 430\n#pragma once\n" COMPUTE "void main() { no_such_name = 1; }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_DEVICE, "main.comp.glsl:5: error: ");
}

static void test_error_in_the_defines_says_so(void **state)
{
    fixture *self = *state;
    put(self, "main.comp.glsl", COMPUTE "void main() { }\n");
    assert_fails(self, "main.comp.glsl", "#define GOOD 1\nfloat x = no_such_name;\n", NOOK_E_DEVICE,
                 "(defines):2: error: ");
}

static void test_missing_shader_is_named(void **state)
{
    fixture *self = *state;
    assert_fails(self, "nothing.comp.glsl", "", NOOK_E_NOT_FOUND, "nothing.comp.glsl: no such shader");
    assert_int_equal(self->lines, 1);
}

static void test_missing_include_names_who_asked(void **state)
{
    fixture *self = *state;
    put(self, "shaders/inner.glsl", "\n#include \"nook/nothing.glsl\"\n");
    put(self, "main.comp.glsl", COMPUTE "#include \"inner.glsl\"\nvoid main() { }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_NOT_FOUND,
                 "shaders/inner.glsl:2: #include \"nook/nothing.glsl\": no such file");
    assert_int_equal(self->lines, 1);
}

static void test_include_of_a_directory_is_refused(void **state)
{
    fixture *self = *state;
    put(self, "main.comp.glsl", "#include \"nook\"\n" COMPUTE "void main() { }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_NOT_FOUND, "main.comp.glsl:1: #include \"nook\": no such file");
}

static void test_include_cycle_is_refused(void **state)
{
    fixture *self = *state;
    put(self, "shaders/a.glsl", "#include \"b.glsl\"\n");
    put(self, "shaders/b.glsl", "\n\n#include \"a.glsl\"\n");
    put(self, "main.comp.glsl", COMPUTE "#include \"a.glsl\"\nvoid main() { }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_FORMAT, "shaders/b.glsl:3: #include \"a.glsl\" goes in a circle");
    assert_int_equal(self->lines, 1);
}

static void test_includes_nested_too_deep_are_refused(void **state)
{
    fixture *self = *state;
    for (int i = 0; i < 40; i++) {
        char name[64], text[64];
        snprintf(name, sizeof name, "shaders/deep%d.glsl", i);
        snprintf(text, sizeof text, "#include \"deep%d.glsl\"\n", i + 1);
        put(self, name, text);
    }
    put(self, "main.comp.glsl", COMPUTE "#include \"deep0.glsl\"\nvoid main() { }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_FORMAT, "nested deeper than 32 files");
}

static void test_misspelt_includes_are_refused(void **state)
{
    fixture *self = *state;
    static const char *const wrong[] = { "#include <a.glsl>\n", "#include \"a.glsl\n", "#include \"\"\n",
                                         "#include\n" };
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        char name[32], message[96];
        snprintf(name, sizeof name, "wrong%zu.comp.glsl", i);
        snprintf(message, sizeof message, "%s:1: #include wants a path in double quotes", name);
        put(self, name, wrong[i]);
        assert_fails(self, name, "", NOOK_E_FORMAT, message);
    }
}

static void test_shader_with_zero_bytes_is_refused(void **state)
{
    fixture *self = *state;
    char path[600];
    nook_path_join(path, sizeof path, self->root, "binary.comp.glsl");
    assert_int_equal(nook_file_write(path, "void main() { }\n\0\n", 18), NOOK_OK);
    assert_fails(self, "binary.comp.glsl", "", NOOK_E_FORMAT, "binary.comp.glsl: not a text file");
}

static void test_include_in_a_comment_is_no_include(void **state)
{
    fixture *self = *state;
    uint32_t values[2];
    put(self, "main.comp.glsl",
        "/* how to use:\n#include \"nothing.glsl\"\n*/ // #include \"nothing.glsl\"\n//#include "
        "\"nothing.glsl\"\n" COMPUTE OUTPUT "void main() { values[0] = 1u; }");
    run(self, "main.comp.glsl", "", values);
    assert_int_equal(values[0], 1);
}

static void test_file_is_included_every_time_it_is_asked_for(void **state)
{
    fixture *self = *state;
    uint32_t values[2];
    put(self, "rows.def", "ROW(3)\nROW(4)\n");
    put(self, "main.comp.glsl",
        COMPUTE OUTPUT "void main() {\nuint sum = 0u, product = 1u;\n#define ROW(n) sum += n;\n#include \"rows.def\"\n"
                       "#undef ROW\n#define ROW(n) product *= n;\n#  include   \"rows.def\" // again\n"
                       "values[0] = sum; values[1] = product; }\n");
    run(self, "main.comp.glsl", "", values);
    assert_int_equal(values[0], 7);
    assert_int_equal(values[1], 12);
}

static void test_file_with_pragma_once_is_included_once(void **state)
{
    fixture *self = *state;
    uint32_t values[2];
    put(self, "shaders/once.glsl", "#pragma once\n#include \"other.glsl\"\nuint once() { return 5u; }\n");
    put(self, "shaders/other.glsl", "#pragma once\n#include \"once.glsl\"\nuint other() { return 6u; }\n");
    put(self, "main.comp.glsl",
        COMPUTE OUTPUT "#include \"once.glsl\"\n#include \"shaders/once.glsl\"\n#include \"other.glsl\"\n"
                       "void main() { values[0] = once(); values[1] = other(); }\n");
    run(self, "main.comp.glsl", "", values);
    assert_int_equal(values[0], 5);
    assert_int_equal(values[1], 6);
}

static void test_lines_may_end_as_on_windows_and_the_last_not_at_all(void **state)
{
    fixture *self = *state;
    uint32_t values[2];
    put(self, "shaders/end.glsl", "#pragma once\r\nuint end() { return 9u; }");
    put(self, "main.comp.glsl",
        "#version 450 core\r\n" COMPUTE OUTPUT
        "#include \"end.glsl\"\r\n#include \"end.glsl\"\r\nvoid main() { values[0] = end(); }");
    run(self, "main.comp.glsl", "", values);
    assert_int_equal(values[0], 9);
}

static void test_version_is_450_unless_the_file_says_otherwise(void **state)
{
    fixture *self = *state;
    uint32_t values[2];
    put(self, "plain.comp.glsl", COMPUTE OUTPUT "void main() { values[0] = __VERSION__; }\n");
    put(self, "older.comp.glsl", "\n#version 430 core\n" COMPUTE OUTPUT "void main() { values[0] = __VERSION__; }\n");
    run(self, "plain.comp.glsl", "", values);
    assert_int_equal(values[0], 450);
    run(self, "older.comp.glsl", "", values);
    assert_int_equal(values[0], 430);
}

static void test_program_is_built_once_for_its_paths_and_defines(void **state)
{
    fixture *self = *state;
    nook_program first = { 0 }, again = { 0 }, other = { 0 };
    uint32_t values[2];
    put(self, "main.comp.glsl", COMPUTE OUTPUT "void main() { values[0] = VALUE; }\n");
    assert_int_equal(compute(self, "main.comp.glsl", "#define VALUE 1u\n", &first), NOOK_OK);
    put(self, "main.comp.glsl", "this is not a shader any more");
    assert_int_equal(compute(self, "main.comp.glsl", "#define VALUE 1u\n", &again), NOOK_OK);
    assert_int_equal(first.handle, again.handle);
    put(self, "main.comp.glsl", COMPUTE OUTPUT "void main() { values[0] = VALUE; }\n");
    assert_int_equal(compute(self, "main.comp.glsl", "#define VALUE 2u\n", &other), NOOK_OK);
    assert_int_not_equal(first.handle, other.handle);
    run(self, "main.comp.glsl", "#define VALUE 2u\n", values);
    assert_int_equal(values[0], 2);
}

static void test_program_that_failed_fails_quietly_until_shaders_are_reloaded(void **state)
{
    fixture *self = *state;
    nook_program program = { 0 };
    nook_shader_report report;
    put(self, "main.comp.glsl", COMPUTE "void main() { no_such_name = 1; }\n");
    assert_fails(self, "main.comp.glsl", "", NOOK_E_DEVICE, "main.comp.glsl:2: error: ");
    int lines = self->lines;
    put(self, "main.comp.glsl", COMPUTE "void main() { }\n");
    assert_int_equal(compute(self, "main.comp.glsl", "", &program), NOOK_E_DEVICE);
    assert_int_equal(self->lines, lines);
    nook_gpu_reload_shaders(self->test.gpu, NULL, 0, &report);
    assert_int_equal(report.reloaded, 1);
    assert_int_equal(compute(self, "main.comp.glsl", "", &program), NOOK_OK);
}

static void test_shaders_that_do_not_fit_together_are_named(void **state)
{
    fixture *self = *state;
    nook_program program = { .handle = 4711 };
    put(self, "draw.vert.glsl", "out vec2 uv;\nvoid main() { uv = vec2(0); gl_Position = vec4(0); }\n");
    put(self, "draw.frag.glsl", "in vec4 uv;\nout vec4 colour;\nvoid main() { colour = uv; }\n");
    assert_int_equal(nook_program_raster(self->test.gpu, "draw.vert.glsl", "draw.frag.glsl", "", &program),
                     NOOK_E_DEVICE);
    assert_int_equal(program.handle, 4711);
    assert_non_null(strstr(self->log, "draw.frag.glsl: "));
    assert_non_null(strstr(self->log, "uv"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_error_in_an_included_file_names_that_file_and_line),
        TEST(test_error_behind_an_include_names_the_line_of_its_own_file),
        TEST(test_error_behind_own_version_and_pragma_keeps_its_line),
        TEST(test_error_in_the_defines_says_so),
        TEST(test_missing_shader_is_named),
        TEST(test_missing_include_names_who_asked),
        TEST(test_include_of_a_directory_is_refused),
        TEST(test_include_cycle_is_refused),
        TEST(test_includes_nested_too_deep_are_refused),
        TEST(test_misspelt_includes_are_refused),
        TEST(test_shader_with_zero_bytes_is_refused),
        TEST(test_include_in_a_comment_is_no_include),
        TEST(test_file_is_included_every_time_it_is_asked_for),
        TEST(test_file_with_pragma_once_is_included_once),
        TEST(test_lines_may_end_as_on_windows_and_the_last_not_at_all),
        TEST(test_version_is_450_unless_the_file_says_otherwise),
        TEST(test_program_is_built_once_for_its_paths_and_defines),
        TEST(test_program_that_failed_fails_quietly_until_shaders_are_reloaded),
        TEST(test_shaders_that_do_not_fit_together_are_named),
    };
    return cmocka_run_group_tests_name("programs", tests, NULL, NULL);
}
