/* The code of a game exchanged many times while it draws: nothing is left of the libraries. NOOK_EXCHANGES=1000 makes it a thousand. */
#include "engine/core/log.h"
#include "engine/core/process.h"
#include "game/play/soak_code.h"
#include "tests/support/scratch.h"
#include "tests/support/test_gpu.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { EXCHANGES = 60, WARM_UP = 24 };

static int asked_for(void)
{
    const char *text = getenv("NOOK_EXCHANGES");
    return text && atoi(text) > WARM_UP ? atoi(text) : EXCHANGES;
}

static void say_nothing(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)user, (void)file, (void)line;
    if (level == NOOK_LOG_ERROR)
        print_error("%s\n", text);
}

/** The libraries are beside the program, not beside this test. */
static bool find_libraries(nook_soak_code *code)
{
    const char *program = getenv("NOOK_PROGRAM");
    if (!program)
        return false;
    snprintf(code->built, sizeof code->built, "%.*s", (int)(strrchr(program, '/') - program), program);
    return true;
}

static long count_mappings(void)
{
    long lines = 0;
    FILE *file = fopen("/proc/self/maps", "r");
    assert_non_null(file);
    for (int c = fgetc(file); c != EOF; c = fgetc(file))
        lines += c == '\n';
    fclose(file);
    return lines;
}

static void test_a_game_whose_code_is_exchanged_many_times_goes_on_and_grows_by_nothing(void **state)
{
    (void)state;
    char level[4096], cache[4096];
    nook_process warm = { 0 }, end;
    long warm_mappings = 0;
    nook_soak_code code;
    snprintf(level, sizeof level, "%s/tests/play/data/crate.level", test_gpu_root());
    nook_play_window_desc how = { .play = { .root = test_gpu_root(), .level = level },
                                  .backend = NOOK_BACKEND_OSMESA,
                                  .width = 32,
                                  .height = 18,
                                  .cache = nook_scratch_path(cache, sizeof cache, "cache"),
                                  .driven = true,
                                  .frame_seconds = NOOK_PHYSICS_STEP };
    setenv("LP_NUM_THREADS", "0", 1); /* with threads llvmpipe keeps what passes had to draw, more on a busy machine */
    assert_int_equal(nook_soak_code_open(test_gpu_root(), &how, &code), NOOK_OK);
    if (!find_libraries(&code)) {
        print_message("NOOK_PROGRAM is not set: run it by ./nook test\n");
        nook_soak_code_close(&code);
        skip();
    }
    nook_log_set_sink(say_nothing, NULL);
    for (int i = 0; i < asked_for(); i++) {
        assert_int_equal(nook_soak_code_exchange(&code), NOOK_OK);
        for (int frame = 0; frame < 2; frame++)
            assert_int_equal(nook_soak_code_frame(&code), NOOK_OK);
        if (i == WARM_UP) {
            assert_int_equal(nook_process_read(&warm), NOOK_OK);
            warm_mappings = count_mappings();
        }
    }
    assert_int_equal(nook_process_read(&end), NOOK_OK);
    printf("%d exchanges: %.1f and %.1f MiB, %u and %u files, %ld and %ld mappings\n", asked_for(),
           (double)warm.resident / 1048576.0, (double)end.resident / 1048576.0, warm.files, end.files, warm_mappings,
           count_mappings());
    assert_int_equal(end.files, warm.files);
#ifndef __SANITIZE_ADDRESS__ /* its quarantine keeps what was freed */
    assert_in_range(count_mappings(), 0, warm_mappings + 8);
    assert_in_range(end.resident, 0, warm.resident + (2u << 20));
#endif
    assert_int_equal(nook_soak_code_close(&code), NOOK_OK);
    nook_log_set_sink(NULL, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_game_whose_code_is_exchanged_many_times_goes_on_and_grows_by_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
