/* Parts that lend code to a main module: each is exchanged alone, all that fit together are exchanged at once. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/module/host.h"
#include "tests/module/counter.inl"
#include "tests/support/log_capture.h"
#include "tests/support/module_build.h"
#include "tests/support/scratch.h"
#include <stdio.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static int32_t add_nothing(int32_t value)
{
    return value;
}

static const counter_adder adder = { add_nothing };
static const nook_module modules[] = {
    { .version = NOOK_MODULE_VERSION, .name = "adder_a", .kind = "test.adder", .interface = &adder },
    { .version = NOOK_MODULE_VERSION, .name = "adder_b", .kind = "test.adder", .interface = &adder },
};

static const char *const folders[] = { "tests/module/", NULL };
static const nook_module_builtin parts[] = { { &modules[0], folders, NULL }, { &modules[1], folders, NULL } };

typedef struct fixture {
    char folder[4096];
    counter_arguments arguments;
    int32_t alive;
    nook_module_host *host;
    nook_log_capture log;
} fixture;

static int setup(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    char remove[8192];
    assert_non_null(f);
    nook_scratch_path(f->folder, sizeof f->folder, "live");
    snprintf(remove, sizeof remove, "rm -rf '%s'", f->folder);
    assert_int_equal(system(remove), 0);
    assert_int_equal(nook_directory_make(f->folder), NOOK_OK);
    f->arguments = (counter_arguments){ .start = 0, .alive = &f->alive };
    const nook_module_host_desc desc = { .folder = f->folder,
                                         .main = { &counter_module, folders, NULL },
                                         .parts = parts,
                                         .part_count = NOOK_COUNT(parts),
                                         .arguments = { .user = &f->arguments } };
    assert_int_equal(nook_module_host_create(&desc, &f->host), NOOK_OK);
    nook_log_capture_begin(&f->log);
    *state = f;
    return 0;
}

static int teardown(void **state)
{
    fixture *f = *state;
    nook_log_capture_end();
    nook_module_host_destroy(f->host);
    int left = module_count_files(f->folder, ".") - module_count_files(f->folder, ".so");
    free(f);
    return left == 2 ? 0 : -1; /* "." and ".." */
}

static void build_adder(const fixture *f, const char *name, int step, const char *options)
{
    char defines[256];
    snprintf(defines, sizeof defines, "'-DADDER_NAME=\"%s\"' -DADDER_STEP=%d %s", name, step, options);
    module_build(f->folder, name, "tests/module/adder_library.c", defines);
}

/* What one frame adds. */
static int32_t step(const fixture *f)
{
    bool running;
    const counter_state *s = nook_module_host_look(f->host).state;
    int32_t before = s->value;
    assert_int_equal(nook_module_host_frame(f->host, &running), NOOK_OK);
    s = nook_module_host_look(f->host).state;
    return s->value - before;
}

static void test_parts_are_exchanged_one_without_the_other(void **state)
{
    fixture *f = *state;
    assert_int_equal(step(f), 1);
    build_adder(f, "adder_a", 10, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 11);
    build_adder(f, "adder_b", 100, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 111);
    build_adder(f, "adder_a", 20, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 121);
    const counter_state *s = nook_module_host_look(f->host).state;
    assert_int_equal(s->resumed, 3); /* the main module is told of each */
    assert_int_equal(nook_module_host_look(f->host).swaps, 3);
    assert_int_equal(nook_module_host_look(f->host).kept, 0); /* and stayed itself */
    assert_int_equal(f->log.errors, 0);
}

static void test_a_part_that_crashes_is_put_back_and_named_and_the_others_go_on(void **state)
{
    fixture *f = *state;
    build_adder(f, "adder_a", 10, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 11);
    build_adder(f, "adder_b", 100, "-DADDER_CRASHES");
    module_publish(f->folder, "ok");
    step(f);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "adder_b: crashed in its first frame"));
    assert_int_equal(step(f), 11);
    build_adder(f, "adder_a", 20, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 21); /* adder_b was not tried again */
    assert_string_equal(nook_module_host_look(f->host).message, "");
    build_adder(f, "adder_b", 200, "");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 221);
}

static void test_of_several_that_are_new_those_that_do_not_crash_last(void **state)
{
    fixture *f = *state;
    build_adder(f, "adder_a", 10, "");
    build_adder(f, "adder_b", 100, "-DADDER_CRASHES_HERE");
    module_publish(f->folder, "ok");
    step(f); /* both are put back */
    step(f); /* after the frame of the old code the innocent one comes again */
    assert_int_equal(step(f), 11);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "adder_b: crashed in its first frame (SIG"));
    assert_int_equal(nook_module_host_look(f->host).refusals, 1);
}

static void test_the_main_module_and_a_part_are_exchanged_at_once(void **state)
{
    fixture *f = *state;
    build_adder(f, "adder_a", 10, "");
    module_build(f->folder, "counter", "tests/module/counter_library.c", "-DCOUNTER_STEP=5");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 15);
    assert_int_equal(nook_module_host_look(f->host).swaps, 1);
    assert_int_equal(nook_module_host_look(f->host).kept, 1);
}

static void test_a_part_that_is_refused_does_not_keep_the_others_out(void **state)
{
    fixture *f = *state;
    build_adder(f, "adder_a", 10, "");
    build_adder(f, "adder_b", 100, "-g0");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 11);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "adder_b: what it was built against"));
}

static void test_a_library_of_another_name_is_refused(void **state)
{
    fixture *f = *state;
    char path[8192];
    build_adder(f, "adder_b", 100, "");
    snprintf(path, sizeof path, "%s/adder_b.so", f->folder);
    module_put(f->folder, "adder_a", path);
    assert_int_equal(remove(path), 0);
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 1);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "adder_a.so: holds the module adder_b"));
}

static void test_main_module_and_part_of_different_headers_are_refused_until_both_are_new(void **state)
{
    fixture *f = *state;
    build_adder(f, "adder_a", 10, "-DNOOK_SHARED_NOTE=int");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 11); /* the main module knows no such type */
    module_build(f->folder, "counter", "tests/module/counter_library.c", "-DCOUNTER_STEP=5 -DNOOK_SHARED_NOTE=double");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 11);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "nook_shared_note differs"));
    build_adder(f, "adder_a", 20, "-DNOOK_SHARED_NOTE=double");
    module_publish(f->folder, "ok");
    assert_int_equal(step(f), 25); /* and the main module that had waited for it */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
        TEST(test_parts_are_exchanged_one_without_the_other),
        TEST(test_a_part_that_crashes_is_put_back_and_named_and_the_others_go_on),
        TEST(test_of_several_that_are_new_those_that_do_not_crash_last),
        TEST(test_the_main_module_and_a_part_are_exchanged_at_once),
        TEST(test_a_part_that_is_refused_does_not_keep_the_others_out),
        TEST(test_a_library_of_another_name_is_refused),
        TEST(test_main_module_and_part_of_different_headers_are_refused_until_both_are_new),
#undef TEST
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
