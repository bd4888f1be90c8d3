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

/**
 * Runs a compute shader of 64 invocations a group over a list: `in` is storage block 0, `out` block 1. Fails the test when it cannot.
 * @param count  of elements of both
 */
void test_gpu_map(nook_gpu *gpu, const char *shader, const void *in, size_t in_element, void *out, size_t out_element,
                  size_t count);
