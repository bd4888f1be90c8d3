#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

const char *test_gpu_root(void)
{
    const char *root = getenv("NOOK_ROOT");
    return root && *root ? root : ".";
}

nook_result test_gpu_create(const char *source_root, test_gpu *out_test_gpu)
{
    test_gpu test = { 0 };
    nook_result result = nook_context_create(&(nook_context_desc){ .backend = NOOK_BACKEND_OSMESA }, &test.context);
    if (result != NOOK_OK)
        return result;
    const nook_gpu_desc desc = { .get_proc = nook_context_get_proc(test.context),
                                 .source_root = source_root ? source_root : test_gpu_root(),
                                 .log_debug_output = true };
    result = nook_gpu_create(&desc, &test.gpu);
    if (result != NOOK_OK) {
        nook_context_destroy(test.context);
        return result;
    }
    *out_test_gpu = test;
    return NOOK_OK;
}

void test_gpu_destroy(test_gpu *test)
{
    nook_gpu_destroy(test->gpu);
    nook_context_destroy(test->context);
    *test = (test_gpu){ 0 };
}

int test_gpu_setup(void **state)
{
    test_gpu *test = calloc(1, sizeof *test);
    if (!test || test_gpu_create(NULL, test) != NOOK_OK) {
        free(test);
        return -1;
    }
    *state = test;
    return 0;
}

int test_gpu_teardown(void **state)
{
    test_gpu *test = *state;
    bool failed = nook_gpu_check(test->gpu, "the test");
    test_gpu_destroy(test);
    free(test);
    return failed ? -1 : 0;
}

nook_gpu *test_gpu_of(void **state)
{
    return ((test_gpu *)*state)->gpu;
}

void test_gpu_map(nook_gpu *gpu, const char *shader, const void *in, size_t in_element, void *out, size_t out_element,
                  size_t count)
{
    nook_program program;
    nook_buffer buffers[2];
    assert_int_equal(nook_program_compute(gpu, shader, "", &program), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, in, count * in_element, &buffers[0]), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, NULL, count * out_element, &buffers[1]), NOOK_OK);
    for (uint32_t i = 0; i < 2; i++)
        nook_bind_storage(gpu, i, buffers[i]);
    nook_dispatch(gpu, program, nook_groups((uint32_t)count, 64), 1, 1);
    nook_buffer_read(gpu, buffers[1], 0, out, count * out_element);
    for (int i = 0; i < 2; i++)
        nook_buffer_destroy(gpu, &buffers[i]);
}
