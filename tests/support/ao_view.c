#include "tests/support/ao_view.h"
#include "modules/ao/technique.h"
#include "modules/ao_gtao/gtao.h"
#include "modules/ao_hao/hao.h"
#include "modules/ao_hbao/hbao.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"
#include "modules/measure/errors.h"
#include "tests/support/test_gpu.h"
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/** What a test's view brings along; it is the view's user. */
typedef struct test_view {
    test_gpu gpu;
    ao_probe probe;
} test_view;

/* The probe is found where the host's progress call would find its user: techniques have no state of their own. */
static nook_result probe_record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params;
    ao_probe *probe = &((test_view *)pass->progress_user)->probe;
    size_t pixels = (size_t)pass->width * pass->height;
    float *painted = malloc(pixels * sizeof *painted);
    probe->depth = realloc(probe->depth, pixels * sizeof *probe->depth);
    probe->normals = realloc(probe->normals, pixels * sizeof *probe->normals);
    assert_true(painted && probe->depth && probe->normals);
    probe->width = pass->width, probe->height = pass->height;
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, probe->depth, pixels * sizeof(float));
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_FLOAT, probe->normals, pixels * sizeof *probe->normals);
    for (size_t i = 0; i < pixels; i++) {
        uint32_t x = (uint32_t)(i % pass->width), y = (uint32_t)(i / pass->width);
        painted[i] = probe->paint ? probe->paint(probe, x, y) : 1.0f;
    }
    nook_texture_write(pass->gpu, pass->visibility, GL_RED, GL_FLOAT, painted, pixels * sizeof *painted);
    free(painted);
    return NOOK_OK;
}

static const nook_ao_technique probe_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "probe",
    .summary = "Keeps its inputs and writes what the test paints",
    .state_version = 1,
    .record = probe_record,
};

nook_fixture_view *ao_view_create(uint32_t width, uint32_t height)
{
    static const nook_ao_technique *const techniques[] = { &nook_ao_volume_technique,    &nook_ao_ssao_technique,
                                                           &nook_ao_hsao_technique,      &nook_ao_hbao_technique,
                                                           &nook_ao_gtao_technique,      &nook_ao_hao_technique,
                                                           &nook_ao_reference_technique, &probe_technique };
    test_view *test = calloc(1, sizeof *test);
    assert_non_null(test);
    assert_int_equal(test_gpu_create(NULL, &test->gpu), NOOK_OK);
    nook_fixture_view_desc desc = { .gpu = test->gpu.gpu,
                                    .width = width,
                                    .height = height,
                                    .techniques = techniques,
                                    .technique_count = NOOK_COUNT(techniques),
                                    .progress_user = test };
    nook_fixture_view *view;
    assert_int_equal(nook_fixture_view_create(&desc, &view), NOOK_OK);
    test->probe.view = view;
    return view;
}

void ao_view_destroy(nook_fixture_view *view)
{
    test_view *test = view->user;
    nook_fixture_view_destroy(view);
    assert_false(nook_gpu_check(test->gpu.gpu, "the test"));
    test_gpu_destroy(&test->gpu);
    free(test->probe.depth);
    free(test->probe.normals);
    free(test);
}

ao_probe *ao_view_probe(const nook_fixture_view *view)
{
    return &((test_view *)view->user)->probe;
}

void ao_view_resize(nook_fixture_view *view, uint32_t width, uint32_t height)
{
    assert_int_equal(nook_fixture_view_resize(view, width, height), NOOK_OK);
}

void ao_view_param(nook_fixture_view *view, const char *name, const char *value)
{
    assert_int_equal(nook_ao_parse_param(view->ao, name, value), NOOK_OK);
}

void ao_view_draw(nook_fixture_view *view, const nook_fixture_mesh *mesh)
{
    assert_int_equal(nook_fixture_view_draw(view, mesh), NOOK_OK);
}

double ao_view_add(nook_fixture_view *view, const nook_fixture_mesh *mesh, uint32_t resolution)
{
    double voxel_size;
    assert_int_equal(nook_fixture_view_add(view, mesh, resolution, NULL, &voxel_size), NOOK_OK);
    return voxel_size;
}

void ao_view_record(nook_fixture_view *view, const char *technique)
{
    assert_int_equal(nook_fixture_view_record(view, technique), NOOK_OK);
    assert_int_equal(view->outside, 0); /* never NaN, never out of range */
}

void ao_view_add_yard(nook_fixture_view *view, double reach, uint32_t resolution)
{
    const double eye[3] = { 2.5, -3, 2.5 }, target[3] = { 0, 0, 0.2 }, up[3] = { 0, 0, 1 };
    const double across[3] = { 2 * reach, 0, 0 };
    nook_fixture_mesh mesh = { 0 };
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    nook_fixture_add_quad(&mesh, (double[]){ -reach, -reach, 0 }, across, (double[]){ 0, 2 * reach, 0 });
    nook_fixture_add_quad(&mesh, (double[]){ -reach, 1, 0 }, across, (double[]){ 0, 0, reach });
    nook_fixture_add_box(&mesh, (double[]){ -0.4, -0.5, 0 }, (double[]){ 0.6, 0.5, 1 }, 63);
    ao_view_draw(view, &mesh);
    ao_view_add(view, &mesh, resolution);
    nook_fixture_mesh_free(&mesh);
}

int ao_view_teardown(void **state)
{
    ao_view_destroy(*state);
    return 0;
}

double ao_view_rmse(const float *picture, const float *truth, size_t pixels)
{
    nook_errors errors;
    assert_int_equal(nook_errors_measure(picture, truth, NULL, pixels, &errors), NOOK_OK);
    assert_true(errors.valid);
    return errors.rmse;
}
