#include "tests/support/test_extremes.h"
#include "game/extremes/extreme_run.h"
#include "game/scratch_folder.h"
#include "tests/support/test_gpu.h"
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* What one test is given: a case of a group, and a device for itself alone. */
typedef struct extreme_test {
    const nook_extreme_group *group;
    const nook_extreme *extreme;
    const nook_scratch_folder *scratch; /* of the whole program: volumes are baked once */
    test_gpu gpu;
} extreme_test;

static int setup(void **state)
{
    extreme_test *test = *state;
    return test_gpu_create(NULL, &test->gpu) == NOOK_OK ? 0 : -1;
}

static int teardown(void **state)
{
    extreme_test *test = *state;
    test_gpu_destroy(&test->gpu);
    return 0;
}

static void run_case(void **state)
{
    extreme_test *test = *state;
    const nook_extremes extremes = { .gpu = test->gpu.gpu, .scratch = test->scratch->path, .quick = true };
    nook_extreme_row row;
    nook_extreme_run(&extremes, test->group, test->extreme, &row);
    assert_int_equal(row.result, NOOK_OK);
    if (!nook_extreme_row_holds(&row))
        fail_msg("measured %g %s, bound %g, %llu visibilities outside [0, 1]: %s", row.found.measured,
                 test->extreme->unit, row.found.bound, (unsigned long long)row.found.outside, row.found.where);
    assert_true(row.found.where[0] != '\0'); /* a case that looked at nothing holds nothing */
}

int test_extremes_main(const nook_extreme_group *group)
{
    struct CMUnitTest *tests = calloc(group->count, sizeof *tests);
    extreme_test *states = calloc(group->count, sizeof *states);
    nook_scratch_folder scratch;
    int failed = -1;
    if (tests && states && nook_scratch_folder_make(&scratch) == NOOK_OK) {
        for (size_t i = 0; i < group->count; i++) {
            states[i] = (extreme_test){ .group = group, .extreme = &group->cases[i], .scratch = &scratch };
            tests[i] = (struct CMUnitTest){ group->cases[i].name, run_case, setup, teardown, &states[i] };
        }
        failed = _cmocka_run_group_tests(group->name, tests, group->count, NULL, NULL);
        nook_scratch_folder_remove(&scratch);
    }
    free(tests);
    free(states);
    return failed;
}
