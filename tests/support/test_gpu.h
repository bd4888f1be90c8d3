/**
 * test_gpu.h - a GPU for tests: OSMesa, so that every machine runs them. Shaders are found under the repository root.
 *
 *   cmocka_unit_test_setup_teardown(test_something, test_gpu_setup, test_gpu_teardown)
 *   static void test_something(void **state) { nook_gpu *gpu = test_gpu_of(state); ... }
 */
#pragma once
#include "engine/gpu/gpu.h"
#include "engine/platform/context.h"

/** NOOK_ROOT, else the current directory. */
const char *test_gpu_root(void);

typedef struct test_gpu {
    nook_context *context;
    nook_gpu *gpu;
} test_gpu;

/** @param source_root NULL: test_gpu_root() */
nook_result test_gpu_create(const char *source_root, test_gpu *out_test_gpu);
/** Zeroed is allowed; becomes zero. */
void test_gpu_destroy(test_gpu *test);

/** For cmocka, per test or per group. The tear-down fails the test when GL raised an error that nobody asked about. */
int test_gpu_setup(void **state);
int test_gpu_teardown(void **state);
nook_gpu *test_gpu_of(void **state);
