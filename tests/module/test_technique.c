/* A technique's library exchanged while an AO context records with it: the libraries of this build, and one that paints it dark. */
#include "engine/core/file.h"
#include "engine/module/host.h"
#include "modules/ao/technique.h"
#include "modules/ao_ssao/ssao.h"
#include "tests/support/ao_view.h"
#include "tests/support/module_build.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 32, HEIGHT = 24, PIXELS = WIDTH * HEIGHT };

/* ---- a main module that records a view ---- */

typedef struct recorder {
    nook_fixture_view *view;
} recorder;

static nook_result create(void *state, const nook_module_news *news)
{
    ((recorder *)state)->view = news->arguments->user;
    return NOOK_OK;
}

static nook_result destroy(void *state)
{
    (void)state;
    return NOOK_OK;
}

static nook_result frame(void *state, const nook_module_news *news, bool *out_running)
{
    (void)news;
    *out_running = true;
    nook_ao_set_technique(((recorder *)state)->view->ao, "ssao");
    return nook_fixture_view_record(((recorder *)state)->view, "ssao");
}

static nook_result resume(void *state, const nook_module_news *news)
{
    const nook_module_part *part = &news->parts[0];
    return nook_ao_replace_technique(((recorder *)state)->view->ao, part->module->interface, !part->other_layout);
}

static const nook_module recorder_module = { .version = NOOK_MODULE_VERSION,
                                             .name = "recorder",
                                             .state_size = sizeof(recorder),
                                             .create = create,
                                             .destroy = destroy,
                                             .frame = frame,
                                             .resume = resume };

static const nook_module linked = { .version = NOOK_MODULE_VERSION,
                                    .name = "ao_ssao",
                                    .kind = NOOK_AO_TECHNIQUE_KIND,
                                    .interface = &nook_ao_ssao_technique };

/* ---- the tests ---- */

typedef struct fixture {
    char folder[4096];
    nook_fixture_view *view;
    nook_module_host *host;
} fixture;

/** Steps, seen from above: something that occludes. */
static void draw_steps(nook_fixture_view *view)
{
    static const double facing[3] = { 0, 0, 1 };
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++)
            nook_fixture_view_set_pixel(view, x, y, x / 8 % 2 ? 1.0 : 1.3, facing);
    }
}

static int setup(void **state)
{
    static const char *const here[] = { "tests/module/", NULL }, *const ssao[] = { "modules/ao_ssao/", NULL };
    static const nook_module_builtin part = { &linked, ssao, NULL };
    fixture *f = calloc(1, sizeof *f);
    char remove[8192];
    assert_non_null(f);
    nook_scratch_path(f->folder, sizeof f->folder, "live");
    snprintf(remove, sizeof remove, "rm -rf '%s'", f->folder);
    assert_int_equal(system(remove), 0);
    assert_int_equal(nook_directory_make(f->folder), NOOK_OK);
    f->view = ao_view_create(WIDTH, HEIGHT);
    ao_view_param(f->view, "ao.r_max", "1");
    ao_view_param(f->view, "ssao.samples", "7");
    draw_steps(f->view);
    const nook_module_host_desc desc = { .folder = f->folder,
                                         .main = { &recorder_module, here, NULL },
                                         .parts = &part,
                                         .part_count = 1,
                                         .arguments = { .user = f->view } };
    assert_int_equal(nook_module_host_create(&desc, &f->host), NOOK_OK);
    *state = f;
    return 0;
}

/* The view must not outlive the library that its technique is in. */
static int teardown(void **state)
{
    fixture *f = *state;
    assert_int_equal(nook_ao_replace_technique(f->view->ao, &nook_ao_ssao_technique, 1), NOOK_OK);
    nook_module_host_destroy(f->host);
    ao_view_destroy(f->view);
    free(f);
    return 0;
}

static void run_frame(fixture *f, float out[PIXELS])
{
    bool running;
    assert_int_equal(nook_module_host_frame(f->host, &running), NOOK_OK);
    memcpy(out, f->view->visibility, PIXELS * sizeof *out);
}

static float darkest(const float picture[PIXELS])
{
    float least = 1.0f;
    for (int i = 0; i < PIXELS; i++)
        least = fminf(least, picture[i]);
    return least;
}

static double samples(const fixture *f)
{
    double value = 0.0;
    assert_int_equal(nook_ao_get_param(f->view->ao, "ssao.samples", &value), NOOK_OK);
    return value;
}

/** The library that was built with this test, beside the program. */
static void put_built_library(const fixture *f)
{
    const char *program = getenv("NOOK_PROGRAM");
    char path[4096];
    if (!program) {
        print_message("NOOK_PROGRAM is not set: run it by ./nook test\n");
        skip();
    }
    snprintf(path, sizeof path, "%.*sao_ssao.so", (int)(nook_path_name(program) - program), program);
    module_put(f->folder, "ao_ssao", path);
    module_publish(f->folder, "ok");
}

static void test_the_library_of_a_technique_draws_what_the_one_linked_in_does(void **state)
{
    fixture *f = *state;
    float before[PIXELS], after[PIXELS];
    run_frame(f, before);
    put_built_library(f);
    run_frame(f, after);
    assert_string_equal(nook_module_host_look(f->host).message, "");
    assert_int_equal(nook_module_host_look(f->host).swaps, 1);
    assert_memory_equal(before, after, sizeof before);
    assert_true(darkest(before) < 0.9f);
    assert_true(samples(f) == 7.0);
    assert_ptr_not_equal(nook_ao_technique_at(f->view->ao, 1), &nook_ao_ssao_technique);
}

static void test_the_picture_changes_as_the_new_code_says_and_parameters_stay(void **state)
{
    fixture *f = *state;
    float picture[PIXELS], first[PIXELS];
    run_frame(f, first);
    module_build(f->folder, "ao_ssao", "tests/module/dark_ssao_library.c", "-DDARK_VALUE=0.25f");
    module_publish(f->folder, "ok");
    run_frame(f, picture);
    assert_true(fabsf(picture[PIXELS / 2] - 0.25f) < 1e-6f);
    assert_true(samples(f) == 7.0);
    put_built_library(f);
    run_frame(f, picture);
    assert_memory_equal(picture, first, sizeof picture);
}

static void test_a_technique_that_crashes_is_put_back(void **state)
{
    fixture *f = *state;
    float picture[PIXELS], first[PIXELS];
    run_frame(f, first);
    module_build(f->folder, "ao_ssao", "tests/module/dark_ssao_library.c", "-DDARK_VALUE=0.25f -DDARK_CRASHES");
    module_publish(f->folder, "ok");
    run_frame(f, picture);
    run_frame(f, picture);
    assert_memory_equal(picture, first, sizeof picture);
    assert_non_null(strstr(nook_module_host_look(f->host).message, "ao_ssao: crashed in its first frame (SIGILL)"));
    assert_ptr_equal(nook_ao_technique_at(f->view->ao, 1), &nook_ao_ssao_technique);
    assert_true(samples(f) == 7.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
        TEST(test_the_library_of_a_technique_draws_what_the_one_linked_in_does),
        TEST(test_the_picture_changes_as_the_new_code_says_and_parameters_stay),
        TEST(test_a_technique_that_crashes_is_put_back),
#undef TEST
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
