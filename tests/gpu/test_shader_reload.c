#include "engine/core/file.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

#define COMPUTE "layout(local_size_x = 8) in;\n"
#define OUTPUT "layout(std430, binding = 0) buffer Output { uint values[]; };\n"
#define MAIN COMPUTE OUTPUT "#include \"nook/value.glsl\"\nvoid main() { values[0] = value(); }\n"

/* A folder of shaders of its own: main.comp.glsl includes shaders/nook/value.glsl and writes what that says. */
typedef struct fixture {
    file_tree tree;
    test_gpu test;
    nook_gpu *gpu;
    nook_program program;
    nook_log_capture log;
    nook_shader_report report;
} fixture;

static void put_value(fixture *self, const char *expression)
{
    char text[256];
    snprintf(text, sizeof text, "// comment\nuint value()\n{\n    return %s;\n}\n", expression);
    file_tree_replace(&self->tree, "shaders/nook/value.glsl", text);
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    file_tree_begin(&self->tree, "reloaded");
    file_tree_write(&self->tree, "shaders/nook/value.glsl", "");
    file_tree_write(&self->tree, "main.comp.glsl", MAIN);
    put_value(self, "1u");
    if (test_gpu_create(self->tree.root, &self->test) != NOOK_OK)
        return -1;
    self->gpu = self->test.gpu;
    nook_log_capture_begin(&self->log);
    return nook_program_compute(self->gpu, "main.comp.glsl", "", &self->program) == NOOK_OK ? 0 : -1;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_log_capture_end();
    bool failed = nook_gpu_check(self->gpu, "the test");
    test_gpu_destroy(&self->test);
    free(self);
    return failed ? -1 : 0;
}

/* What the program writes now. */
static uint32_t run(fixture *self)
{
    const uint32_t zero = 0;
    uint32_t value = 0;
    nook_buffer buffer;
    assert_int_equal(nook_buffer_create(self->gpu, &zero, sizeof zero, &buffer), NOOK_OK);
    nook_bind_storage(self->gpu, 0, buffer);
    nook_dispatch(self->gpu, self->program, 1, 1, 1);
    nook_buffer_read(self->gpu, buffer, 0, &value, sizeof value);
    nook_buffer_destroy(self->gpu, &buffer);
    return value;
}

static void reload(fixture *self, const char *changed)
{
    nook_gpu_reload_shaders(self->gpu, &changed, 1, &self->report);
}

static void assert_reported(const fixture *self, uint32_t reloaded, uint32_t failed)
{
    if (self->report.reloaded != reloaded || self->report.failed != failed)
        fail_msg("%u reloaded, %u failed:\n%s", self->report.reloaded, self->report.failed, self->report.text);
    assert_true((self->report.text[0] != '\0') == (failed > 0));
}

static void assert_says(const fixture *self, const char *text)
{
    if (!strstr(self->report.text, text))
        fail_msg("expected '%s' in the report:\n%s", text, self->report.text);
}

/* A change that must be refused: the old program stays and works. */
static void assert_refused(fixture *self, const char *changed, const char *why)
{
    uint32_t before = run(self), name = nook_program_native(self->gpu, self->program);
    int errors = self->log.errors;
    reload(self, changed);
    assert_reported(self, 0, 1);
    assert_says(self, why);
    assert_int_equal(nook_program_native(self->gpu, self->program), name);
    assert_int_equal(run(self), before);
    assert_true(self->log.errors > errors);
}

static void test_changed_shader_takes_the_place_of_the_old_one(void **state)
{
    fixture *self = *state;
    uint32_t name = nook_program_native(self->gpu, self->program);
    assert_int_equal(run(self), 1);
    file_tree_write(&self->tree, "main.comp.glsl", COMPUTE OUTPUT "void main() { values[0] = 7u; }\n");
    assert_int_equal(run(self), 1);
    reload(self, "main.comp.glsl");
    assert_reported(self, 1, 0);
    assert_true(self->report.ms > 0.0);
    assert_int_equal(run(self), 7);
    assert_false(self->gpu->gl->IsProgram(name) && nook_program_native(self->gpu, self->program) != name);
}

static void test_changed_include_reloads_what_is_made_of_it_and_nothing_else(void **state)
{
    fixture *self = *state;
    nook_program other = { 0 };
    file_tree_write(&self->tree, "other.comp.glsl", COMPUTE "void main() { }\n");
    assert_int_equal(nook_program_compute(self->gpu, "other.comp.glsl", "", &other), NOOK_OK);
    uint32_t name = nook_program_native(self->gpu, other);
    put_value(self, "2u");
    reload(self, "shaders/nook/value.glsl");
    assert_reported(self, 1, 0);
    assert_int_equal(run(self), 2);
    assert_int_equal(nook_program_native(self->gpu, other), name);
    put_value(self, "3u");
    reload(self, "shaders/nook/other.glsl");
    assert_reported(self, 0, 0);
    assert_int_equal(run(self), 2);
    nook_gpu_reload_shaders(self->gpu, NULL, 0, &self->report);
    assert_reported(self, 2, 0);
    assert_int_equal(run(self), 3);
}

static void test_broken_include_keeps_the_old_program_and_names_file_and_line(void **state)
{
    fixture *self = *state;
    put_value(self, "no_such_name");
    assert_refused(self, "shaders/nook/value.glsl", "shaders/nook/value.glsl:4: error: ");
    assert_says(self, "no_such_name");
}

static void test_errors_are_told_before_warnings(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/nook/value.glsl",
                    "uint value()\n{\n    uint unset;\n    uint v = unset;\n    return v + no_such_name;\n}\n");
    assert_refused(self, "shaders/nook/value.glsl", "value.glsl:5: error: ");
    assert_says(self, "warning");
    assert_non_null(strstr(strstr(self->report.text, "value.glsl:5: error: "), "warning"));
}

static void test_mended_file_recovers(void **state)
{
    fixture *self = *state;
    put_value(self, "1u +");
    assert_refused(self, "shaders/nook/value.glsl", "shaders/nook/value.glsl:");
    put_value(self, "5u");
    reload(self, "shaders/nook/value.glsl");
    assert_reported(self, 1, 0);
    assert_int_equal(run(self), 5);
}

static void test_same_error_is_logged_once_and_stays_in_the_report(void **state)
{
    fixture *self = *state;
    put_value(self, "no_such_name");
    assert_refused(self, "shaders/nook/value.glsl", "no_such_name");
    int lines = self->log.count;
    reload(self, "elsewhere.glsl");
    assert_reported(self, 0, 1);
    assert_says(self, "no_such_name");
    assert_int_equal(self->log.count, lines);
    nook_gpu_shader_report(self->gpu, &self->report);
    assert_reported(self, 0, 1);
    put_value(self, "other_name");
    assert_refused(self, "shaders/nook/value.glsl", "other_name");
}

static void test_error_shared_by_programs_is_told_once(void **state)
{
    fixture *self = *state;
    nook_program other;
    assert_int_equal(nook_program_compute(self->gpu, "main.comp.glsl", "#define OTHER\n", &other), NOOK_OK);
    put_value(self, "no_such_name");
    reload(self, "shaders/nook/value.glsl");
    assert_reported(self, 0, 2);
    const char *first = strstr(self->report.text, "no_such_name");
    assert_non_null(first);
    assert_null(strstr(first + 1, "no_such_name"));
}

static void test_deleted_file_keeps_the_old_program_until_it_is_back(void **state)
{
    fixture *self = *state;
    file_tree_remove(&self->tree, "shaders/nook");
    assert_refused(self, "shaders/nook", "main.comp.glsl:3: #include \"nook/value.glsl\": no such file");
    file_tree_write(&self->tree, "shaders/nook/value.glsl", "uint value() { return 6u; }\n");
    reload(self, "shaders/nook/value.glsl");
    assert_reported(self, 1, 0);
    assert_int_equal(run(self), 6);
    file_tree_remove(&self->tree, "main.comp.glsl");
    assert_refused(self, "main.comp.glsl", "main.comp.glsl: no such shader");
    file_tree_write(&self->tree, "main.comp.glsl", MAIN);
    reload(self, "main.comp.glsl");
    assert_reported(self, 1, 0);
}

static void test_include_that_comes_later_is_followed(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "shaders/new.glsl", "uint fresh() { return 8u; }\n");
    file_tree_write(&self->tree, "main.comp.glsl",
                    COMPUTE OUTPUT "#include \"./nook/../new.glsl\"\nvoid main() { values[0] = fresh(); }\n");
    reload(self, "main.comp.glsl");
    assert_reported(self, 1, 0);
    file_tree_write(&self->tree, "shaders/new.glsl", "uint fresh() { return 9u; }\n");
    reload(self, "shaders/new.glsl");
    assert_reported(self, 1, 0);
    assert_int_equal(run(self), 9);
    reload(self, "shaders/nook/value.glsl"); /* not included any more */
    assert_reported(self, 0, 0);
}

static void test_program_that_never_was_built_is_built_when_its_file_is_mended(void **state)
{
    fixture *self = *state;
    nook_program late = { .handle = 4711 };
    assert_int_equal(nook_program_compute(self->gpu, "late.comp.glsl", "", &late), NOOK_E_NOT_FOUND);
    nook_gpu_shader_report(self->gpu, &self->report);
    assert_reported(self, 0, 1);
    assert_says(self, "late.comp.glsl: no such shader");
    file_tree_write(&self->tree, "late.comp.glsl", MAIN);
    reload(self, "late.comp.glsl");
    assert_reported(self, 1, 0);
    assert_int_equal(nook_program_compute(self->gpu, "late.comp.glsl", "", &late), NOOK_OK);
    assert_int_not_equal(late.handle, self->program.handle);
}

static void test_programs_that_draw_are_reloaded_by_either_stage(void **state)
{
    fixture *self = *state;
    nook_program draw;
    file_tree_write(&self->tree, "draw.vert.glsl",
                    "out vec2 uv;\nvoid main() { uv = vec2(0); gl_Position = vec4(0); }\n");
    file_tree_write(&self->tree, "draw.frag.glsl",
                    "in vec2 uv;\nout vec4 colour;\nvoid main() { colour = vec4(uv, 0, 1); }\n");
    assert_int_equal(nook_program_raster(self->gpu, "draw.vert.glsl", "draw.frag.glsl", "", &draw), NOOK_OK);
    reload(self, "draw.vert.glsl");
    assert_reported(self, 1, 0);
    reload(self, "draw.frag.glsl");
    assert_reported(self, 1, 0);
    file_tree_write(&self->tree, "draw.frag.glsl", "in vec4 uv;\nout vec4 colour;\nvoid main() { colour = uv; }\n");
    reload(self, "draw.frag.glsl");
    assert_reported(self, 0, 1);
    assert_says(self, "draw.frag.glsl: ");
}

/* ---- what code relies on ------------------------------------------------------------------------------------------- */

static void write_shader(fixture *self, const char *path, const char *declarations, const char *expression)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s%s\nvoid main() { values[0] = uint(%s); }\n",
             strstr(declarations, "local_size") ? "" : COMPUTE, OUTPUT, declarations, expression);
    file_tree_write(&self->tree, path, text);
}

static void write_main(fixture *self, const char *declarations, const char *expression)
{
    write_shader(self, "main.comp.glsl", declarations, expression);
}

/* Begins with a shader of these declarations, as if the program had been started with it. */
static void start_with(fixture *self, const char *declarations, const char *expression)
{
    write_main(self, declarations, expression);
    assert_int_equal(nook_program_compute(self->gpu, "main.comp.glsl", "#define AGAIN\n", &self->program), NOOK_OK);
}

static void test_uniforms_are_set_for_every_use_and_survive(void **state)
{
    fixture *self = *state;
    const int32_t part[2] = { 30, 4 };
    start_with(self, "layout(location = 0) uniform ivec2 part;", "part.x + part.y");
    nook_program_use(self->gpu, self->program);
    nook_uniform_int(self->gpu, 0, part, 2);
    assert_int_equal(run(self), 34);
    write_main(self, "layout(location = 0) uniform ivec2 part;", "part.x - part.y");
    reload(self, "main.comp.glsl");
    nook_program_use(self->gpu, self->program);
    nook_uniform_int(self->gpu, 0, part, 2);
    assert_int_equal(run(self), 26);
}

static void test_uniform_that_is_not_needed_any_more_is_no_error(void **state)
{
    fixture *self = *state;
    const int32_t part[2] = { 30, 4 };
    static const char *const without[] = { "layout(location = 0) uniform ivec2 part;", "" };
    start_with(self, "layout(location = 0) uniform ivec2 part;", "part.x");
    for (size_t i = 0; i < NOOK_COUNT(without); i++) {
        write_main(self, without[i], "3");
        reload(self, "main.comp.glsl");
        assert_int_equal(self->report.failed, 0);
        nook_program_use(self->gpu, self->program);
        nook_uniform_int(self->gpu, 0, part, 2);
        assert_int_equal(run(self), 3);
        assert_false(nook_gpu_check(self->gpu, "a uniform that is not there"));
    }
}

static void test_changed_layout_is_refused_until_it_is_as_it_was(void **state)
{
    fixture *self = *state;
    static const struct {
        const char *before, *after, *use, *says;
    } changes[] = {
        { "layout(std140, binding = 1) uniform Block { int a; float b; } block;",
          "layout(std140, binding = 1) uniform Block { int a; int c; float b; } block;", "block.a + block.b",
          "uniform=1 " },
        { "layout(std140, binding = 2) uniform Block { int a; float b; } block;",
          "layout(std140, binding = 2) uniform Block { float b; int a; } block;", "block.a + block.b", "uniform=2 " },
        { "layout(std140, binding = 3) uniform Block { vec4 a; int b; } block;",
          "layout(std140, binding = 3) uniform Block { vec4 a; } block;", "block.a.x",
          "lacks 'uniform=3 b int at 16'" },
        { "layout(std430, binding = 4) buffer Block { vec4 a; int b; } block;",
          "layout(std430, binding = 4) buffer Block { vec3 a; int b; } block;", "block.a.x + block.b", "storage=4 " },
        { "layout(location = 5) uniform int a;", "layout(location = 5) uniform float a;", "a", "location=5 float" },
        { "layout(binding = 6) uniform sampler2D a;", "layout(binding = 6) uniform sampler3D a;",
          "texelFetch(a, T(0), 0).x", "texture=6 sampler3D" },
        { "layout(local_size_x = 8) in;", "layout(local_size_x = 16) in;", "1", "local_size 16 1 1" },
    };
    for (size_t i = 0; i < NOOK_COUNT(changes); i++) {
        char path[32], before[256], after[256];
        snprintf(path, sizeof path, "case%zu.comp.glsl", i);
        snprintf(before, sizeof before, "#define T ivec2\n%s", changes[i].before);
        snprintf(after, sizeof after, "#define T ivec%d\n%s", strstr(changes[i].after, "3D") ? 3 : 2, changes[i].after);
        write_shader(self, path, before, changes[i].use);
        assert_int_equal(nook_program_compute(self->gpu, path, "", &self->program), NOOK_OK);
        uint32_t name = nook_program_native(self->gpu, self->program);
        write_shader(self, path, after, changes[i].use);
        reload(self, path);
        assert_reported(self, 0, 1);
        assert_says(self, changes[i].says);
        assert_says(self, "the running code relies on");
        assert_int_equal(nook_program_native(self->gpu, self->program), name);
        write_shader(self, path, before, changes[i].use);
        reload(self, path);
        assert_reported(self, 1, 0);
    }
}

static void test_layout_is_remembered_while_a_block_is_away(void **state)
{
    fixture *self = *state;
    start_with(self, "layout(std140, binding = 1) uniform Block { int a; } block;", "block.a");
    write_main(self, "", "2");
    reload(self, "main.comp.glsl");
    assert_int_equal(self->report.failed, 0);
    write_main(self, "layout(std140, binding = 1) uniform Block { float a; } block;", "block.a");
    reload(self, "main.comp.glsl");
    assert_says(self, "has 'uniform=1 a float at 0'");
}

static void test_two_kinds_of_sampler_at_one_binding_are_refused(void **state)
{
    fixture *self = *state;
    write_main(self, "layout(binding = 1) uniform sampler2D a;\nlayout(binding = 1) uniform sampler3D b;",
               "texelFetch(a, ivec2(0), 0).x + texelFetch(b, ivec3(0), 0).x");
    assert_refused(self, "main.comp.glsl", "another kind of sampler");
}

/* ---- params.def ---------------------------------------------------------------------------------------------------- */

#define PARAMS "modules/ao_x/params.def"
#define ROWS "INT(rays)\nFLOAT(threshold)\n"
#define MORE_ROWS "INT(rays)\nFLOAT(threshold)\nINT(more)\n"
#define PARAM_BLOCK                                                  \
    "#define INT(name) int name;\n#define FLOAT(name) float name;\n" \
    "layout(std140, binding = 1) uniform Params {\n#include \"" PARAMS "\"\n} params;\n"

typedef struct x_params {
    int32_t rays;
    float threshold;
    int32_t more;
} x_params;

static const nook_param x_table[] = {
    { .name = "rays", .type = NOOK_PARAM_INT, .offset = offsetof(x_params, rays) },
    { .name = "threshold", .type = NOOK_PARAM_FLOAT, .offset = offsetof(x_params, threshold) },
    { .name = "more", .type = NOOK_PARAM_CHOICE, .offset = offsetof(x_params, more) },
};

static void test_params_that_the_code_does_not_have_are_refused(void **state)
{
    fixture *self = *state;
    static const char *const wrong[] = { "FLOAT(rays)\nFLOAT(threshold)\n", "FLOAT(threshold)\nINT(rays)\n",
                                         "INT(rays)\n", "INT(rays)\nFLOAT(limit)\n", MORE_ROWS };
    file_tree_write(&self->tree, PARAMS, ROWS);
    assert_int_equal(nook_gpu_expect_params(self->gpu, PARAMS, x_table, 2), NOOK_OK);
    start_with(self, PARAM_BLOCK, "params.rays");
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        file_tree_write(&self->tree, PARAMS, wrong[i]);
        reload(self, PARAMS);
        assert_int_equal(self->report.reloaded, 0);
        assert_says(self, "main.comp.glsl: " PARAMS ": ");
        assert_says(self, "./nook watch");
    }
    file_tree_write(&self->tree, PARAMS, "// a comment\n" ROWS);
    reload(self, PARAMS);
    assert_int_equal(self->report.reloaded, 1);
    assert_int_equal(self->report.failed, 0);
}

static void test_program_first_built_after_its_params_have_changed_is_refused(void **state)
{
    fixture *self = *state;
    nook_program program = { .handle = 4711 };
    assert_int_equal(nook_gpu_expect_params(self->gpu, PARAMS, x_table, 2), NOOK_OK);
    file_tree_write(&self->tree, PARAMS, MORE_ROWS);
    write_main(self, PARAM_BLOCK, "params.rays");
    assert_int_equal(nook_program_compute(self->gpu, "main.comp.glsl", "#define NEW\n", &program), NOOK_E_VERSION);
    assert_int_equal(program.handle, 4711);
    assert_non_null(strstr(self->log.text, "holds a row that the running code does not know"));
}

static void test_params_of_newly_loaded_code_are_taken(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, PARAMS, ROWS);
    assert_int_equal(nook_gpu_expect_params(self->gpu, PARAMS, x_table, 2), NOOK_OK);
    start_with(self, PARAM_BLOCK, "params.rays");
    file_tree_write(&self->tree, PARAMS, MORE_ROWS);
    assert_int_equal(nook_gpu_expect_params(self->gpu, PARAMS, x_table, 3), NOOK_OK);
    reload(self, PARAMS);
    assert_int_equal(self->report.reloaded, 1);
    assert_int_equal(self->report.failed, 0);
    assert_int_equal(nook_gpu_expect_params(self->gpu, PARAMS, x_table, 2), NOOK_OK);
    reload(self, PARAMS);
    assert_says(self, "holds a row that the running code does not know");
}

/* ---- leaks --------------------------------------------------------------------------------------------------------- */

/* Programs and shaders that GL holds; names are given out from 1 on and used again. */
static int count_objects(const nook_gl *gl)
{
    int count = 0;
    for (GLuint name = 1; name < 10000; name++)
        count += gl->IsProgram(name) || gl->IsShader(name);
    return count;
}

static void test_a_thousand_reloads_leak_neither_objects_nor_memory_nor_files(void **state)
{
    enum { RELOADS = 1000, WARM = 200 };
    fixture *self = *state;
    int objects = count_objects(self->gpu->gl), open_files = file_tree_open_files();
    long resident = 0;
    for (uint32_t i = 0; i < RELOADS; i++) {
        char value[32];
        snprintf(value, sizeof value, i % 4 == 3 ? "broken%u" : "%uu",
                 i % 8); /* eight texts: caches of the driver fill up */
        put_value(self, value);
        reload(self, "shaders/nook/value.glsl");
        if (i % 25 == 0) /* the first run of a program compiles it once more: twenty times as long as the rest */
            assert_int_equal(run(self), i % 4 == 3 ? i % 8 - 1 : i % 8);
        if (i == WARM)
            resident = file_tree_resident_kb();
    }
    run(self); /* GL keeps a deleted program until another one is used */
    assert_int_equal(count_objects(self->gpu->gl), objects);
    assert_int_equal(file_tree_open_files(), open_files);
    long grown = file_tree_resident_kb() - resident;
    if (grown > 4096)
        fail_msg("%ld kB more after %d reloads than after %d", grown, RELOADS, WARM);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_changed_shader_takes_the_place_of_the_old_one),
        TEST(test_changed_include_reloads_what_is_made_of_it_and_nothing_else),
        TEST(test_broken_include_keeps_the_old_program_and_names_file_and_line),
        TEST(test_errors_are_told_before_warnings),
        TEST(test_mended_file_recovers),
        TEST(test_same_error_is_logged_once_and_stays_in_the_report),
        TEST(test_error_shared_by_programs_is_told_once),
        TEST(test_deleted_file_keeps_the_old_program_until_it_is_back),
        TEST(test_include_that_comes_later_is_followed),
        TEST(test_program_that_never_was_built_is_built_when_its_file_is_mended),
        TEST(test_programs_that_draw_are_reloaded_by_either_stage),
        TEST(test_uniforms_are_set_for_every_use_and_survive),
        TEST(test_uniform_that_is_not_needed_any_more_is_no_error),
        TEST(test_changed_layout_is_refused_until_it_is_as_it_was),
        TEST(test_layout_is_remembered_while_a_block_is_away),
        TEST(test_two_kinds_of_sampler_at_one_binding_are_refused),
        TEST(test_params_that_the_code_does_not_have_are_refused),
        TEST(test_program_first_built_after_its_params_have_changed_is_refused),
        TEST(test_params_of_newly_loaded_code_are_taken),
        TEST(test_a_thousand_reloads_leak_neither_objects_nor_memory_nor_files),
    };
    return cmocka_run_group_tests_name("reloaded shaders", tests, NULL, NULL);
}
