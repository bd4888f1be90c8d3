/* Exchanging code under a running module: what lasts, what is put back, and what becomes of the state. */
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

static const char *const folders[] = { "tests/module/", NULL };
static const char source[] = "tests/module/counter_library.c";

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
    f->arguments = (counter_arguments){ .start = 100, .alive = &f->alive };
    const nook_module_host_desc desc = { .folder = f->folder,
                                         .main = { &counter_module, folders, NULL },
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
    int left = module_count_files(f->folder, "counter.");
    free(f);
    return left > 1 ? -1 : 0; /* counter.so itself, where it was built, and no copies */
}

static void frame(fixture *f)
{
    bool running;
    assert_int_equal(nook_module_host_frame(f->host, &running), NOOK_OK);
    assert_true(running);
}

static counter_state *counter(const fixture *f)
{
    return nook_module_host_look(f->host).state;
}

static void build(fixture *f, const char *options)
{
    module_build(f->folder, "counter", source, options);
    module_publish(f->folder, "ok");
}

static void expect_refusal(fixture *f, const char *words)
{
    nook_module_host_view view = nook_module_host_look(f->host);
    if (!strstr(view.message, words))
        fail_msg("expected to find: %s\nin: %s", words, view.message);
    assert_non_null(strstr(view.message, "counter")); /* by name */
    assert_int_equal(view.refusals, 1);
    assert_true(f->log.errors >= 1);
}

/* What was built is refused; the code before goes on with the state as it was. */
static void expect_the_old_code_goes_on(fixture *f, const char *options, const char *words)
{
    frame(f);
    frame(f);
    assert_int_equal(counter(f)->value, 102);
    build(f, options);
    frame(f);
    expect_refusal(f, words);
    int32_t value = counter(f)->value;
    frame(f);
    frame(f);
    assert_int_equal(counter(f)->value, value + 2);
    assert_true(value == 102 || value == 103);
    assert_int_equal(f->alive, 1);
    assert_int_equal(nook_module_host_look(f->host).swaps, 0);
    assert_string_equal(nook_module_host_look(f->host).main_path, "");
}

/* ---- what lasts ---- */

static void test_new_code_takes_the_place_of_what_is_linked_in_and_the_state_survives(void **state)
{
    fixture *f = *state;
    frame(f);
    counter_heap *heap = counter(f)->heap;
    build(f, "-DCOUNTER_STEP=10");
    frame(f);
    assert_int_equal(counter(f)->value, 111);
    assert_ptr_equal(counter(f)->heap, heap);
    assert_int_equal(heap->frames, 2);
    assert_int_equal(counter(f)->suspended, 1);
    assert_int_equal(counter(f)->resumed, 1);
    nook_module_host_view view = nook_module_host_look(f->host);
    assert_int_equal(view.swaps, 1);
    assert_int_equal(view.kept, 1);
    assert_true(view.swap_ms > 0.0);
    assert_string_equal(view.message, "");
    assert_int_equal(f->log.errors, 0);
    assert_int_equal(module_count_files(f->folder, "counter."), 2); /* the library and the copy that runs */
}

static void test_the_copy_before_is_removed_when_the_next_one_runs(void **state)
{
    fixture *f = *state;
    build(f, "-DCOUNTER_STEP=10");
    frame(f);
    build(f, "-DCOUNTER_STEP=20");
    frame(f);
    frame(f);
    assert_int_equal(counter(f)->value, 150);
    assert_int_equal(module_count_files(f->folder, "counter."), 2);
}

static void test_copies_of_programs_that_run_no_more_are_removed(void **state)
{
    fixture *f = *state;
    char path[8192];
    snprintf(path, sizeof path, "%s/counter.99999999.7.so", f->folder);
    assert_int_equal(nook_file_write(path, "", 0), NOOK_OK);
    const nook_module_host_desc desc = { .folder = f->folder,
                                         .main = { &counter_module, folders, NULL },
                                         .arguments = { .user = &f->arguments } };
    nook_module_host *other;
    assert_int_equal(nook_module_host_create(&desc, &other), NOOK_OK);
    assert_false(nook_file_exists(path));
    nook_module_host_destroy(other);
}

static void test_a_library_that_was_there_before_the_program_is_not_loaded(void **state)
{
    fixture *f = *state;
    module_build(f->folder, "counter", source, "-DCOUNTER_STEP=10");
    const nook_module_host_desc desc = { .folder = f->folder,
                                         .main = { &counter_module, folders, NULL },
                                         .arguments = { .user = &f->arguments } };
    nook_module_host *other;
    bool running;
    assert_int_equal(nook_module_host_create(&desc, &other), NOOK_OK);
    module_publish(f->folder, "ok"); /* of something else */
    assert_int_equal(nook_module_host_frame(other, &running), NOOK_OK);
    assert_int_equal(((counter_state *)nook_module_host_look(other).state)->value, 101);
    nook_module_host_destroy(other);
}

static void test_a_failed_build_is_told_and_the_code_stays(void **state)
{
    fixture *f = *state;
    module_publish(f->folder, "failed\ngame/stage.c:7: error: nothing fits");
    frame(f);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "game/stage.c:7: error: nothing fits"));
    assert_int_equal(counter(f)->value, 101);
    module_publish(f->folder, "ok");
    frame(f);
    assert_string_equal(nook_module_host_look(f->host).message, "");
}

/* ---- the state of other code ---- */

static void test_a_state_of_another_version_is_migrated(void **state)
{
    fixture *f = *state;
    frame(f);
    counter_heap *heap = counter(f)->heap;
    build(f, "-DCOUNTER_GROWN -DCOUNTER_VERSION=2 -DCOUNTER_MIGRATES -DCOUNTER_STEP=10");
    frame(f);
    const struct {
        double more;
        int32_t value;
        uint32_t suspended, resumed;
        counter_heap *heap;
    } *grown = nook_module_host_look(f->host).state;
    assert_int_equal(grown->value, 111);
    assert_true(grown->more == 0.0);
    assert_ptr_equal(grown->heap, heap);
    assert_int_equal(grown->resumed, 1);
    assert_int_equal(f->alive, 1);
    assert_int_equal(nook_module_host_look(f->host).kept, 1);
}

static void test_a_state_that_nobody_migrates_is_made_anew(void **state)
{
    fixture *f = *state;
    frame(f);
    build(f, "-DCOUNTER_VERSION=2 -DCOUNTER_STEP=10");
    frame(f);
    assert_int_equal(counter(f)->value, 110);
    assert_int_equal(f->alive, 2);
    assert_int_equal(nook_module_host_look(f->host).made, 1);
}

static void test_a_migration_that_fails_or_crashes_gives_a_state_made_anew(void **state)
{
    fixture *f = *state;
    frame(f);
    build(f, "-DCOUNTER_VERSION=2 -DCOUNTER_MIGRATES -DCOUNTER_STEP=10 '-DCOUNTER_IN_MIGRATE=return NOOK_E_RANGE'");
    frame(f);
    assert_int_equal(counter(f)->value, 110);
    assert_int_equal(f->alive, 2);
    build(f, "-DCOUNTER_VERSION=3 -DCOUNTER_MIGRATES -DCOUNTER_STEP=20 '-DCOUNTER_IN_MIGRATE=abort()'");
    frame(f);
    assert_int_equal(counter(f)->value, 120);
    assert_int_equal(f->alive, 3);
}

static void test_a_state_that_is_laid_out_otherwise_is_made_anew_though_its_size_and_version_are_the_same(void **state)
{
    fixture *f = *state;
    frame(f);
    build(f, "-DCOUNTER_INNER_GROWN -DCOUNTER_STEP=10"); /* what the state points to */
    frame(f);
    assert_int_equal(counter(f)->value, 110);
    assert_int_equal(f->alive, 2);
    assert_int_equal(nook_module_host_look(f->host).made, 1);
}

/* ---- what is refused before it runs ---- */

static void test_a_library_that_lacks_a_symbol_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-DCOUNTER_LACKS", "nook_function_that_nobody_has");
}

static void test_a_library_without_an_entry_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-DCOUNTER_NO_ENTRY", "exports no nook_module_entry");
}

static void test_a_library_built_for_other_types_of_the_engine_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-DCOUNTER_OTHER_TYPE", "nook_file differs");
}

static void test_a_library_built_for_other_functions_of_the_engine_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-DCOUNTER_OTHER_FUNCTION", "nook_clock_ms differs");
}

static void test_a_library_without_debug_information_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-g0", "what it was built against cannot be told");
}

static void test_a_module_of_another_version_is_refused(void **state)
{
    expect_the_old_code_goes_on(*state, "-DCOUNTER_MODULE_VERSION=2", "a module of version 2");
}

static void test_a_file_that_is_no_library_is_refused(void **state)
{
    fixture *f = *state;
    char path[8192];
    frame(f);
    snprintf(path, sizeof path, "%s/counter.so", f->folder);
    assert_int_equal(nook_file_write(path, "nothing", 7), NOOK_OK);
    module_publish(f->folder, "ok");
    frame(f);
    expect_refusal(f, "counter");
    assert_int_equal(counter(f)->value, 102);
}

/* ---- what is put back after it ran ---- */

static void test_code_that_crashes_in_its_first_frame_is_put_back(void **state)
{
    static const char *const crashes[][2] = {
        { "*(volatile int*)NULL=1", "SIGSEGV" },
        { "abort()", "SIGABRT" },
        { "__builtin_trap()", "SIGILL" },
    };
    fixture *f = *state;
    for (uint32_t i = 0; i < NOOK_COUNT(crashes); i++) {
        char options[256], words[64];
        snprintf(options, sizeof options, "'-DCOUNTER_IN_FRAME=%s' -fno-sanitize=undefined", crashes[i][0]);
        snprintf(words, sizeof words, "counter: crashed in its first frame (%s)", crashes[i][1]);
        int32_t value = counter(f)->value;
        build(f, options);
        frame(f);
        if (!strstr(nook_module_host_look(f->host).message, words))
            fail_msg("expected to find: %s\nin: %s", words, nook_module_host_look(f->host).message);
        frame(f);
        frame(f);
        assert_int_equal(counter(f)->value, value + 2);
        assert_int_equal(nook_module_host_look(f->host).refusals, i + 1);
    }
    assert_int_equal(f->alive, 1);
    build(f, "-DCOUNTER_STEP=10"); /* mended */
    frame(f);
    assert_string_equal(nook_module_host_look(f->host).message, "");
    assert_int_equal(nook_module_host_look(f->host).swaps, 1);
}

static void test_code_that_runs_out_of_stack_in_its_first_frame_is_put_back(void **state)
{
    expect_the_old_code_goes_on(
        *state,
        "-O0 '-DCOUNTER_IN_FRAME=volatile char a[4096]; a[0]=1; counter_frame((char*)state+(a[0]-1),news,out_running)'",
        "crashed in its first frame (SIG");
}

static void test_code_that_crashes_in_a_job_of_its_first_frame_is_put_back(void **state)
{
    expect_the_old_code_goes_on(*state, "-include tests/module/crashing_job.h '-DCOUNTER_IN_FRAME=crash_in_job()'",
                                "crashed in its first frame (SIGABRT)");
}

static void test_code_whose_first_frame_fails_is_put_back(void **state)
{
    expect_the_old_code_goes_on(*state, "'-DCOUNTER_IN_FRAME=return NOOK_E_DEVICE'", "its first frame failed");
}

static void test_code_whose_resume_fails_or_crashes_is_put_back(void **state)
{
    fixture *f = *state;
    expect_the_old_code_goes_on(f, "'-DCOUNTER_IN_RESUME=return NOOK_E_DEVICE'", "its resume failed");
    build(f, "'-DCOUNTER_IN_RESUME=abort()'");
    frame(f);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "counter: crashed in its resume (SIGABRT)"));
    assert_int_equal(f->alive, 1);
}

static void test_code_that_migrated_and_then_crashes_gives_the_state_back(void **state)
{
    expect_the_old_code_goes_on(*state,
                                "-DCOUNTER_GROWN -DCOUNTER_VERSION=2 -DCOUNTER_MIGRATES '-DCOUNTER_IN_FRAME=abort()'",
                                "crashed in its first frame");
}

static void test_code_whose_create_fails_is_put_back_with_a_state_made_anew(void **state)
{
    static const char *const ends[] = { "return NOOK_E_DEVICE", "abort()" };
    fixture *f = *state;
    for (uint32_t i = 0; i < NOOK_COUNT(ends); i++) {
        char options[256];
        snprintf(options, sizeof options, "-DCOUNTER_VERSION=2 '-DCOUNTER_IN_CREATE=%s'", ends[i]);
        frame(f);
        build(f, options);
        frame(f);
        assert_non_null(
            strstr(nook_module_host_look(f->host).message, i ? "crashed in its create" : "its create failed"));
        assert_int_equal(counter(f)->value, 101);
        assert_int_equal(f->alive, i + 2);
    }
    assert_int_equal(nook_module_host_look(f->host).swaps, 0);
}

static void test_a_state_that_new_code_broke_before_it_crashed_is_made_anew(void **state)
{
    fixture *f = *state;
    frame(f);
    build(f, "'-DCOUNTER_IN_FRAME=s->heap = NULL; abort()'"); /* its heap is lost: that is what a crash may do */
    counter_heap *lost = counter(f)->heap;
    frame(f);
    frame(f); /* the old code crashes too */
    assert_non_null(strstr(nook_module_host_look(f->host).message, "counter: crashed in its first frame (SIGABRT)"));
    assert_int_equal(nook_module_host_look(f->host).refusals, 2);
    frame(f);
    assert_int_equal(counter(f)->value, 101);
    assert_int_equal(f->alive, 2);
    free(lost);
}

static void test_what_was_refused_is_not_tried_again_until_it_is_built_again(void **state)
{
    fixture *f = *state;
    build(f, "'-DCOUNTER_IN_FRAME=abort()'");
    frame(f);
    frame(f);
    module_publish(f->folder, "ok");
    frame(f);
    frame(f);
    assert_int_equal(nook_module_host_look(f->host).refusals, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
        TEST(test_new_code_takes_the_place_of_what_is_linked_in_and_the_state_survives),
        TEST(test_the_copy_before_is_removed_when_the_next_one_runs),
        TEST(test_copies_of_programs_that_run_no_more_are_removed),
        TEST(test_a_library_that_was_there_before_the_program_is_not_loaded),
        TEST(test_a_failed_build_is_told_and_the_code_stays),
        TEST(test_a_state_of_another_version_is_migrated),
        TEST(test_a_state_that_nobody_migrates_is_made_anew),
        TEST(test_a_migration_that_fails_or_crashes_gives_a_state_made_anew),
        TEST(test_a_state_that_is_laid_out_otherwise_is_made_anew_though_its_size_and_version_are_the_same),
        TEST(test_a_library_that_lacks_a_symbol_is_refused),
        TEST(test_a_library_without_an_entry_is_refused),
        TEST(test_a_library_built_for_other_types_of_the_engine_is_refused),
        TEST(test_a_library_built_for_other_functions_of_the_engine_is_refused),
        TEST(test_a_library_without_debug_information_is_refused),
        TEST(test_a_module_of_another_version_is_refused),
        TEST(test_a_file_that_is_no_library_is_refused),
        TEST(test_code_that_crashes_in_its_first_frame_is_put_back),
        TEST(test_code_that_runs_out_of_stack_in_its_first_frame_is_put_back),
        TEST(test_code_that_crashes_in_a_job_of_its_first_frame_is_put_back),
        TEST(test_code_whose_first_frame_fails_is_put_back),
        TEST(test_code_whose_resume_fails_or_crashes_is_put_back),
        TEST(test_code_that_migrated_and_then_crashes_gives_the_state_back),
        TEST(test_code_whose_create_fails_is_put_back_with_a_state_made_anew),
        TEST(test_a_state_that_new_code_broke_before_it_crashed_is_made_anew),
        TEST(test_what_was_refused_is_not_tried_again_until_it_is_built_again),
#undef TEST
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
