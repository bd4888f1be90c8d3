#include "engine/gpu/gpu.h"
#include "engine/platform/context.h"
#include "engine/platform/renderer.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h> /* wants those above first */

static nook_context *create(nook_backend backend)
{
    nook_context *context = NULL;
    assert_int_equal(nook_context_create(&(nook_context_desc){ .backend = backend, .debug = true }, &context), NOOK_OK);
    assert_non_null(context);
    return context;
}

/* The context that is current computes what it should. */
static void assert_computes(nook_context *context)
{
    enum { SIDE = 8 };
    float texels[SIDE][SIDE];
    nook_gpu *gpu = NULL;
    nook_texture texture;
    nook_program program;
    const nook_gpu_desc desc = { nook_context_get_proc(context), test_gpu_root(), .log_debug_output = true };
    assert_int_equal(nook_gpu_create(&desc, &gpu), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32F, SIDE, SIDE, GL_NEAREST, &texture), NOOK_OK);
    assert_int_equal(nook_program_compute(gpu, "tests/gpu/shaders/gradient.comp.glsl", "#define SCALE 2.0\n", &program),
                     NOOK_OK);
    nook_bind_image(gpu, 0, texture, GL_WRITE_ONLY);
    nook_dispatch(gpu, program, 1, 1, 1);
    nook_texture_read(gpu, texture, GL_RED, GL_FLOAT, texels, sizeof texels);
    assert_true(texels[3][5] == 2.0f * 3005.0f);
    assert_false(nook_gpu_check(gpu, "the test"));
    nook_texture_destroy(gpu, &texture);
    nook_gpu_destroy(gpu);
}

static void test_osmesa_computes(void **state)
{
    (void)state;
    nook_context *context = create(NOOK_BACKEND_OSMESA);
    assert_int_equal(nook_context_backend(context), NOOK_BACKEND_OSMESA);
    assert_computes(context);
    nook_context_destroy(context);
}

static void test_egl_computes(void **state)
{
    (void)state;
    nook_context *context = create(NOOK_BACKEND_EGL);
    assert_int_equal(nook_context_backend(context), NOOK_BACKEND_EGL);
    assert_computes(context);
    nook_context_destroy(context);
}

static void test_contexts_of_all_kinds_follow_one_another(void **state)
{
    (void)state;
    static const nook_backend order[] = { NOOK_BACKEND_EGL, NOOK_BACKEND_OSMESA, NOOK_BACKEND_OSMESA,
                                          NOOK_BACKEND_EGL, NOOK_BACKEND_AUTO,   NOOK_BACKEND_EGL };
    for (size_t i = 0; i < NOOK_COUNT(order); i++) {
        nook_context *context = create(order[i]);
        assert_computes(context);
        nook_context_destroy(context);
    }
}

static void test_ending_an_older_context_leaves_the_current_one_alive(void **state)
{
    (void)state;
    static const nook_backend kinds[] = { NOOK_BACKEND_EGL, NOOK_BACKEND_OSMESA };
    for (size_t i = 0; i < NOOK_COUNT(kinds); i++) {
        nook_context *first = create(kinds[i]);
        nook_context *second = create(kinds[i]); /* current now */
        assert_computes(second);
        nook_context_destroy(first);
        assert_computes(second);
        nook_context_destroy(second);
    }
}

static void test_automatic_choice_without_a_window_prefers_hardware_then_osmesa(void **state)
{
    (void)state;
    nook_context *context = create(NOOK_BACKEND_AUTO);
    PFNGLGETSTRINGPROC get_string = (PFNGLGETSTRINGPROC)nook_context_get_proc(context)("glGetString");
    bool software = nook_renderer_is_software((const char *)get_string(GL_RENDERER));
    assert_int_equal(nook_context_backend(context), software ? NOOK_BACKEND_OSMESA : NOOK_BACKEND_EGL);
    nook_context_destroy(context);
}

static void test_headless_input_is_zero_but_for_the_scale_of_letters(void **state)
{
    (void)state;
    nook_input input, zero;
    nook_context *context = create(NOOK_BACKEND_OSMESA);
    memset(&input, 255, sizeof input);
    memset(&zero, 0, sizeof zero);
    nook_context_poll(context, &input);
    nook_context_present(context);
    assert_true(input.content_scale == 1.0);
    input.content_scale = 0.0;
    assert_memory_equal(&input, &zero, sizeof zero);
    nook_context_destroy(context);
}

static void test_destroying_nothing_is_allowed(void **state)
{
    (void)state;
    nook_context_destroy(NULL);
}

static void test_backends_have_names(void **state)
{
    (void)state;
    static const nook_backend all[] = { NOOK_BACKEND_AUTO, NOOK_BACKEND_WINDOW, NOOK_BACKEND_OSMESA, NOOK_BACKEND_EGL };
    for (size_t i = 0; i < NOOK_COUNT(all); i++) {
        nook_backend parsed = all[(i + 1) % NOOK_COUNT(all)];
        assert_true(nook_backend_parse(nook_backend_name(all[i]), &parsed));
        assert_int_equal(parsed, all[i]);
    }
}

static void test_unknown_backend_names_are_refused(void **state)
{
    (void)state;
    nook_backend backend = NOOK_BACKEND_EGL;
    assert_false(nook_backend_parse("vulkan", &backend));
    assert_false(nook_backend_parse("OSMesa", &backend));
    assert_false(nook_backend_parse("", &backend));
    assert_int_equal(backend, NOOK_BACKEND_EGL);
}

static void test_software_renderers_are_known(void **state)
{
    (void)state;
    assert_true(nook_renderer_is_software("llvmpipe (LLVM 15.0.6, 256 bits)"));
    assert_true(nook_renderer_is_software("softpipe"));
    assert_false(nook_renderer_is_software("NVIDIA H200/PCIe/SSE2"));
    assert_false(nook_renderer_is_software("AMD Radeon RX 6800 (navi21, LLVM 15.0.6, DRM 3.49)"));
    assert_false(nook_renderer_is_software(NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_osmesa_computes),
        cmocka_unit_test(test_egl_computes),
        cmocka_unit_test(test_contexts_of_all_kinds_follow_one_another),
        cmocka_unit_test(test_ending_an_older_context_leaves_the_current_one_alive),
        cmocka_unit_test(test_automatic_choice_without_a_window_prefers_hardware_then_osmesa),
        cmocka_unit_test(test_headless_input_is_zero_but_for_the_scale_of_letters),
        cmocka_unit_test(test_destroying_nothing_is_allowed),
        cmocka_unit_test(test_backends_have_names),
        cmocka_unit_test(test_unknown_backend_names_are_refused),
        cmocka_unit_test(test_software_renderers_are_known),
    };
    return cmocka_run_group_tests_name("contexts", tests, NULL, NULL);
}
