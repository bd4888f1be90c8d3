/* What the context refuses, and what its lines say. */
#include "modules/ao/technique.h"
#include "modules/bake/volume_file.h"
#include "tests/support/ao_view.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIZE = 16 };

static int setup(void **state)
{
    *state = ao_view_create(SIZE, SIZE);
    return 0;
}

static nook_ao *context(void **state)
{
    return ((nook_fixture_view *)*state)->ao;
}

/** Runs a call that must fail with `code`, log one line and say `message` in it. */
#define EXPECT_REFUSED(call, code, message)                         \
    do {                                                            \
        nook_log_capture line;                                      \
        nook_log_capture_begin(&line);                              \
        nook_result refused = (call);                               \
        nook_log_capture_end();                                     \
        assert_int_equal(refused, code);                            \
        assert_int_equal(line.count, 1);                            \
        if (!strstr(line.text, message))                            \
            fail_msg("expected '%s' in: %s", (message), line.text); \
    } while (0)

static double value_of(nook_ao *ao, const char *name)
{
    double value = NAN;
    assert_int_equal(nook_ao_get_param(ao, name, &value), NOOK_OK);
    return value;
}

static void test_settings_list_the_techniques_when_a_name_is_unknown(void **state)
{
    nook_ao *ao = context(state);
    EXPECT_REFUSED(nook_ao_set_technique(ao, "alchemy"), NOOK_E_NOT_FOUND,
                   "volume, ssao, hsao, hbao, gtao, hao, reference");
    EXPECT_REFUSED(nook_ao_set_param(ao, "alchemy.rays", 1), NOOK_E_NOT_FOUND, "ao, volume, ssao, hsao, hbao");
    EXPECT_REFUSED(nook_ao_set_param(ao, "rays", 1), NOOK_E_NOT_FOUND, "technique.parameter");
    EXPECT_REFUSED(nook_ao_set_param(ao, "", 1), NOOK_E_NOT_FOUND, "technique.parameter");
    EXPECT_REFUSED(nook_ao_set_param(ao, "vol.rays", 1), NOOK_E_NOT_FOUND, "vol.rays");
}

static void test_settings_list_the_parameters_when_a_name_is_unknown(void **state)
{
    nook_ao *ao = context(state);
    double value = 4711.0;
    EXPECT_REFUSED(nook_ao_set_param(ao, "volume.ray", 1), NOOK_E_NOT_FOUND, "rays, steps, stepping, threshold");
    EXPECT_REFUSED(nook_ao_parse_param(ao, "ao.radius", "1"), NOOK_E_NOT_FOUND, "r_max, falloff, falloff_tau, scale");
    EXPECT_REFUSED(nook_ao_get_param(ao, "ssao.", &value), NOOK_E_NOT_FOUND, "samples, kernel, bias");
    assert_true(value == 4711.0);
}

/** Sets a parameter to a bound, and then to what it says it is. */
static void check_bound(nook_ao *ao, const char *owner, const nook_param *param, double bound)
{
    char name[64];
    snprintf(name, sizeof name, "%s.%s", owner, param->name);
    double before = value_of(ao, name);
    assert_int_equal(nook_ao_set_param(ao, name, bound), NOOK_OK);
    double stored = value_of(ao, name);
    if (nook_ao_set_param(ao, name, stored) != NOOK_OK || fabs(stored - bound) > 1e-6 * fabs(bound))
        fail_msg("%s: %.9g became %.9g", name, bound, stored);
    assert_int_equal(nook_ao_set_param(ao, name, before), NOOK_OK);
}

static void test_settings_take_back_every_bound_of_every_table(void **state)
{
    nook_ao *ao = context(state);
    const nook_ao_technique *technique;
    size_t count;
    const nook_param *shared = nook_ao_shared_params(&count);
    for (size_t i = 0; i < count; i++) {
        check_bound(ao, "ao", &shared[i], shared[i].lowest);
        check_bound(ao, "ao", &shared[i], shared[i].highest);
    }
    for (uint32_t index = 0; (technique = nook_ao_technique_at(ao, index)) != NULL; index++) {
        for (uint32_t i = 0; i < technique->param_count; i++) {
            check_bound(ao, technique->name, &technique->params[i], technique->params[i].lowest);
            check_bound(ao, technique->name, &technique->params[i], technique->params[i].highest);
        }
    }
}

static void test_settings_keep_the_old_value_when_the_new_one_is_out_of_range(void **state)
{
    static const struct {
        const char *name;
        double bad;
    } cases[] = { { "ao.r_max", 0.0 },       { "ao.r_max", -1.0 },        { "ao.r_max", 1e10 },
                  { "ao.r_max", NAN },       { "ao.r_max", INFINITY },    { "volume.rays", 0.0 },
                  { "volume.rays", 4097.0 }, { "volume.rays", 7.5 },      { "ao.falloff", 5.0 },
                  { "ao.falloff", -1.0 },    { "ao.falloff", 0.5 },       { "ao.scale", 3.0 },
                  { "reference.rays", 0.0 }, { "volume.threshold", 1.0 }, { "ao.count", 2.0 } };
    nook_ao *ao = context(state);
    for (size_t i = 0; i < NOOK_COUNT(cases); i++) {
        double before = value_of(ao, cases[i].name);
        EXPECT_REFUSED(nook_ao_set_param(ao, cases[i].name, cases[i].bad), NOOK_E_RANGE, cases[i].name);
        assert_true(value_of(ao, cases[i].name) == before);
    }
}

static void test_settings_take_choices_by_name_and_number(void **state)
{
    nook_ao *ao = context(state);
    assert_int_equal(nook_ao_parse_param(ao, "ao.falloff", "wendland"), NOOK_OK);
    assert_true(value_of(ao, "ao.falloff") == 3.0);
    assert_int_equal(nook_ao_parse_param(ao, "volume.combine", "multiply"), NOOK_OK);
    assert_true(value_of(ao, "volume.combine") == 0.0);
    assert_int_equal(nook_ao_set_param(ao, "ao.falloff", 1.0), NOOK_OK);
    assert_true(value_of(ao, "ao.falloff") == 1.0);
    EXPECT_REFUSED(nook_ao_parse_param(ao, "ao.falloff", "cubic"), NOOK_E_ARG, "hard|linear|quadratic");
    EXPECT_REFUSED(nook_ao_parse_param(ao, "ao.r_max", "wide"), NOOK_E_ARG, "not a number");
    EXPECT_REFUSED(nook_ao_parse_param(ao, "ao.r_max", ""), NOOK_E_ARG, "not a number");
    EXPECT_REFUSED(nook_ao_parse_param(ao, "ao.r_max", "1m"), NOOK_E_ARG, "not a number");
    assert_true(value_of(ao, "ao.falloff") == 1.0);
}

static void test_settings_of_a_technique_outlive_a_change_of_technique(void **state)
{
    nook_ao *ao = context(state);
    assert_int_equal(nook_ao_set_technique(ao, "volume"), NOOK_OK);
    assert_int_equal(nook_ao_set_param(ao, "volume.rays", 32.0), NOOK_OK);
    assert_int_equal(nook_ao_set_param(ao, "reference.rays", 64.0), NOOK_OK);
    assert_int_equal(nook_ao_set_technique(ao, "ssao"), NOOK_OK);
    assert_true(value_of(ao, "volume.rays") == 32.0);
    assert_true(value_of(ao, "reference.rays") == 64.0);
}

static void test_settings_all_go_back_to_their_initial_values(void **state)
{
    nook_ao *ao = context(state);
    assert_int_equal(nook_ao_set_param(ao, "ssao.samples", 77.0), NOOK_OK);
    assert_int_equal(nook_ao_set_param(ao, "ao.filter_radius", 7.0), NOOK_OK);
    nook_ao_reset_params(ao);
    for (uint32_t i = 0; nook_ao_technique_at(ao, i); i++) {
        const nook_ao_technique *technique = nook_ao_technique_at(ao, i);
        for (uint32_t k = 0; k < technique->param_count; k++) {
            char name[128];
            double initial = technique->params[k].initial;
            snprintf(name, sizeof name, "%s.%s", technique->name, technique->params[k].name);
            assert_true(fabs(value_of(ao, name) - initial) <= 1e-6 * fabs(initial));
        }
    }
    assert_true(value_of(ao, "ao.filter_radius") == 4.0);
}

static void test_settings_tables_list_every_parameter_with_its_initial_value(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = view->gpu, .width = 4, .height = 4 };
    nook_ao *fresh;
    assert_int_equal(nook_ao_create(&desc, &fresh), NOOK_OK);
    size_t count;
    const nook_param *shared = nook_ao_shared_params(&count);
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        char name[64] = "ao.";
        strcat(name, shared[i].name);
        assert_true(fabs(value_of(fresh, name) - shared[i].initial) <= 1e-6 * fabs(shared[i].initial));
    }
    assert_null(nook_ao_technique_at(fresh, 0));
    nook_ao_destroy(fresh);
    assert_string_equal(nook_ao_technique_at(view->ao, 1)->name, "ssao");
    assert_null(nook_ao_technique_at(view->ao, 8));
}

static void test_context_refuses_another_version_no_device_no_pixels_and_too_many_occluders(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao *ao = view->ao;
    nook_ao_desc good = { .version = NOOK_AO_VERSION, .gpu = view->gpu, .width = 4, .height = 4 }, desc = good;
    desc.version = NOOK_AO_VERSION + 1;
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_VERSION, "version");
    assert_null(ao);
    desc = good, desc.gpu = NULL;
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_ARG, "gpu");
    desc = good, desc.width = 0;
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_ARG, "0x4");
    desc = good, desc.height = 1u << 30;
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_ARG, "1073741824");
    desc = good, desc.max_occluders = view->gpu->max_texture_buffer_size / 9 + 1; /* texels of an occluder */
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_ARG, "max_occluders");
    desc.max_occluders = UINT32_MAX;
    EXPECT_REFUSED(nook_ao_create(&desc, &ao), NOOK_E_ARG, "max_occluders");
    EXPECT_REFUSED(nook_ao_set_size(view->ao, 0, 4), NOOK_E_ARG, "0x4");
    EXPECT_REFUSED(nook_ao_set_size(view->ao, 4, 0), NOOK_E_ARG, "4x0");
    nook_ao_destroy(NULL);
}

static nook_result never_called(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params, (void)pass;
    fail_msg("a refused technique must not record");
    return NOOK_OK;
}

static nook_result fail_to_create(void *state, nook_gpu *gpu)
{
    (void)state, (void)gpu;
    return NOOK_E_DEVICE;
}

static void test_context_refuses_techniques_of_another_version_or_name(void **state)
{
    nook_ao *ao = context(state);
    nook_ao_technique good = { .version = NOOK_AO_TECHNIQUE_VERSION, .name = "late", .record = never_called };
    nook_ao_technique technique = good;
    technique.version = NOOK_AO_TECHNIQUE_VERSION + 1;
    EXPECT_REFUSED(nook_ao_add_technique(ao, &technique), NOOK_E_VERSION, "late");
    static const char *const names[] = { "ao", "volume", "", "Late", "a.b" };
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        technique = good, technique.name = names[i];
        EXPECT_REFUSED(nook_ao_add_technique(ao, &technique), NOOK_E_ARG, "the name is taken");
    }
    technique = good, technique.create = fail_to_create;
    assert_int_equal(nook_ao_add_technique(ao, &technique), NOOK_E_DEVICE);
    EXPECT_REFUSED(nook_ao_set_technique(ao, "late"), NOOK_E_NOT_FOUND, "late");
}

static void test_context_refuses_too_many_occluders_and_keeps_the_list(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao *ao;
    nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = view->gpu, .width = 4, .height = 4, .max_occluders = 2 };
    nook_ao_occluder occluders[3] = { { .volume = { 0 } } };
    assert_int_equal(nook_ao_create(&desc, &ao), NOOK_OK);
    assert_int_equal(nook_ao_submit_occluders(ao, occluders, 2), NOOK_OK);
    EXPECT_REFUSED(nook_ao_submit_occluders(ao, occluders, 3), NOOK_E_ARG, "max_occluders");
    assert_int_equal(nook_ao_submit_occluders(ao, NULL, 0), NOOK_OK);
    nook_ao_destroy(ao);
}

static void add_box(nook_fixture_view *view)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -1, -1, -1 }, (double[]){ 1, 1, 1 }, 63);
    ao_view_add(view, &mesh, 4);
    nook_fixture_mesh_free(&mesh);
}

static void test_context_refuses_ids_that_were_removed(void **state)
{
    nook_fixture_view *view = *state;
    add_box(view);
    nook_ao_occluder stale = view->occluders[0], other = stale;
    assert_int_equal(nook_ao_submit_occluders(view->ao, &stale, 1), NOOK_OK);
    nook_fixture_view_drop_occluders(view);
    nook_fixture_view_drop_occluders(view); /* removing twice does no harm */
    stale.mesh.id = 0;
    EXPECT_REFUSED(nook_ao_submit_occluders(view->ao, &stale, 1), NOOK_E_ARG, "removed");
    other.volume.id = 0;
    EXPECT_REFUSED(nook_ao_submit_occluders(view->ao, &other, 1), NOOK_E_ARG, "removed");
    add_box(view); /* ids never come back */
    assert_true(view->occluders[0].volume.id != stale.volume.id && view->occluders[0].mesh.id != other.mesh.id);
    EXPECT_REFUSED(nook_ao_submit_occluders(view->ao, &stale, 1), NOOK_E_ARG, "removed");
    nook_fixture_view_drop_occluders(view);
}

static void test_context_refuses_matrices_that_are_the_wrong_way_round(void **state)
{
    nook_fixture_view *view = *state;
    add_box(view);
    nook_ao_occluder occluder = view->occluders[0];
    for (int axis = 0; axis < 3; axis++) {
        occluder = view->occluders[0];
        occluder.world_from_mesh[4 * axis + 3] = 0.5; /* where its translation is in a matrix of rows */
        EXPECT_REFUSED(nook_ao_submit_occluders(view->ao, &occluder, 1), NOOK_E_ARG, "column-major");
    }
    nook_fixture_view_drop_occluders(view);
}

static void test_record_leaves_out_what_was_removed_after_submitting(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_statistics statistics;
    add_box(view);
    ao_view_record(view, "volume");
    nook_ao_get_statistics(view->ao, &statistics);
    assert_int_equal(statistics.occluders, 1);
    assert_true(statistics.volume_bytes >= 6 * 6 * 6);
    nook_fixture_view_drop_occluders(view);
    ao_view_record(view, "volume");
    nook_ao_get_statistics(view->ao, &statistics);
    assert_int_equal(statistics.occluders, 0);
}

static nook_ao_frame good_frame(const nook_fixture_view *view)
{
    nook_ao_frame frame = { .depth = { view->depth.id, SIZE, SIZE }, .normal = { view->normal.id, SIZE, SIZE } };
    memcpy(frame.view_from_world, view->view_from_world.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, view->clip_from_view.m, sizeof frame.clip_from_view);
    return frame;
}

static void test_record_refuses_textures_of_another_size(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_frame frame = good_frame(view);
    frame.depth.width = SIZE - 1;
    EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "depth is 15x16");
    frame = good_frame(view), frame.depth.native = 0;
    EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "depth");
    frame = good_frame(view), frame.normal.height = SIZE + 1;
    EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "normals are 16x17");
}

static void test_record_refuses_matrices_that_are_no_camera(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_frame frame = good_frame(view);
    static const struct {
        int element;
        double value;
    } bad[] = {
        { 0, 0.0 },
        { 5, NAN },
        { 10, INFINITY },
        { 11, 0.0 },
        { 14, 0.0 },
        { 15, 1.0 },
        /* a near plane that leans, a picture that is turned or sheared, one that is moved by as much at any distance */
        { 2, 0.1 },
        { 6, -0.1 },
        { 1, 0.1 },
        { 4, 0.1 },
        { 3, 0.1 },
        { 7, 0.1 },
        { 12, 0.1 },
        { 13, 0.1 }
    };
    for (size_t i = 0; i < NOOK_COUNT(bad); i++) {
        frame = good_frame(view), frame.clip_from_view[bad[i].element] = bad[i].value;
        EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "clip_from_view");
    }
    frame = good_frame(view), frame.view_from_world[12] = NAN;
    EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "view_from_world");
    static const int elements[] = { 0, 1, 3, 9, 10, 15 };
    for (size_t i = 0; i < NOOK_COUNT(elements); i++) {
        frame = good_frame(view), frame.view_from_world[elements[i]] += 1e-4;
        EXPECT_REFUSED(nook_ao_record(view->ao, &frame), NOOK_E_ARG, "not rigid");
    }
    frame = good_frame(view), frame.view_from_world[0] = -1.0 + 1e-7; /* mirrored, from a matrix of floats */
    assert_int_equal(nook_ao_record(view->ao, &frame), NOOK_OK);
}

static void test_record_tells_an_error_of_gl_and_only_its_own(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_frame frame = good_frame(view);
    nook_log_capture lines;
    frame.depth.native = 0x7fffffff; /* no texture */
    nook_log_capture_begin(&lines);
    nook_result result = nook_ao_record(view->ao, &frame);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_DEVICE);
    assert_true(lines.count >= 1);
    frame = good_frame(view);
    nook_log_capture_begin(&lines);
    view->gpu->gl->Enable(0xffff); /* the host's error */
    result = nook_ao_record(view->ao, &frame);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_OK);
    assert_int_equal(view->gpu->gl->GetError(), GL_NO_ERROR);
}

static void test_visibility_keeps_its_name_when_only_settings_change(void **state)
{
    static const char *const settings[][3] = { { "ao.scale", "quarter", "volume" },
                                               { "ao.scale", "half", "hsao" },
                                               { "ao.filter", "none", "ssao" },
                                               { "ao.scale", "full", "reference" } };
    nook_fixture_view *view = *state;
    ao_view_record(view, "volume");
    uint32_t name = nook_ao_visibility(view->ao).native;
    assert_int_not_equal(name, 0);
    for (size_t i = 0; i < NOOK_COUNT(settings); i++) {
        ao_view_param(view, settings[i][0], settings[i][1]);
        ao_view_record(view, settings[i][2]);
        assert_int_equal(nook_ao_visibility(view->ao).native, name);
    }
    ao_view_param(view, "ao.filter", "tile");
}

static void test_record_refuses_a_context_without_techniques(void **state)
{
    nook_fixture_view *view = *state;
    nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = view->gpu, .width = SIZE, .height = SIZE };
    nook_ao *bare;
    nook_ao_frame frame = good_frame(view);
    assert_int_equal(nook_ao_create(&desc, &bare), NOOK_OK);
    EXPECT_REFUSED(nook_ao_record(bare, &frame), NOOK_E_ARG, "add a technique");
    EXPECT_REFUSED(nook_ao_set_technique(bare, "volume"), NOOK_E_NOT_FOUND, "volume");
    nook_ao_destroy(bare);
}

static void test_context_refuses_damaged_volumes(void **state)
{
    nook_fixture_view *view = *state;
    nook_volume volume = { .info = { .width = 4, .height = 3, .depth = 2, .voxel_size = 0.5 } };
    volume.voxels = calloc(24, 1);
    assert_non_null(volume.voxels);
    uint8_t *bytes;
    size_t size;
    assert_int_equal(nook_volume_encode(&volume, (void **)&bytes, &size), NOOK_OK);
    nook_volume_free(&volume);
    nook_ao_volume id = { 4711 };
    EXPECT_REFUSED(nook_ao_add_volume(view->ao, "a.nkv", bytes, size - 1, &id), NOOK_E_FORMAT, "a.nkv");
    EXPECT_REFUSED(nook_ao_add_volume(view->ao, "a.nkv", bytes, 0, &id), NOOK_E_FORMAT, "a.nkv");
    for (size_t i = 0; i < size; i++) {
        nook_log_capture line;
        nook_log_capture_begin(&line);
        bytes[i] ^= 0x40;
        nook_result result = nook_ao_add_volume(view->ao, "a.nkv", bytes, size, &id);
        bytes[i] ^= 0x40;
        nook_log_capture_end();
        assert_true(result == NOOK_E_FORMAT || result == NOOK_E_VERSION);
        assert_int_equal(line.count, 1);
    }
    assert_int_equal(id.id, 4711);
    assert_int_equal(nook_ao_add_volume(view->ao, "a.nkv", bytes, size, &id), NOOK_OK);
    nook_ao_remove_volume(view->ao, id);
    free(bytes);
}

static void test_context_refuses_meshes_that_are_none(void **state)
{
    nook_ao *ao = context(state);
    const float good[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, bad[9] = { 0, 0, 0, 1, NAN, 0, 0, 1, 0 };
    const uint32_t indices[4] = { 0, 1, 2, 0 }, beyond[3] = { 0, 1, 3 };
    nook_ao_mesh mesh = { 4711 };
    EXPECT_REFUSED(nook_ao_add_mesh(ao, good, 3, indices, 4, &mesh), NOOK_E_ARG, "whole triangles");
    EXPECT_REFUSED(nook_ao_add_mesh(ao, good, 3, beyond, 3, &mesh), NOOK_E_ARG, "index 3 of 3");
    EXPECT_REFUSED(nook_ao_add_mesh(ao, bad, 3, indices, 3, &mesh), NOOK_E_ARG, "vertex 1");
    assert_int_equal(mesh.id, 4711);
    assert_int_equal(nook_ao_add_mesh(ao, good, 3, indices, 3, &mesh), NOOK_OK);
    nook_ao_remove_mesh(ao, mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_settings_list_the_techniques_when_a_name_is_unknown),
        cmocka_unit_test(test_settings_list_the_parameters_when_a_name_is_unknown),
        cmocka_unit_test(test_settings_take_back_every_bound_of_every_table),
        cmocka_unit_test(test_settings_keep_the_old_value_when_the_new_one_is_out_of_range),
        cmocka_unit_test(test_settings_take_choices_by_name_and_number),
        cmocka_unit_test(test_settings_of_a_technique_outlive_a_change_of_technique),
        cmocka_unit_test(test_settings_all_go_back_to_their_initial_values),
        cmocka_unit_test(test_settings_tables_list_every_parameter_with_its_initial_value),
        cmocka_unit_test(test_context_refuses_another_version_no_device_no_pixels_and_too_many_occluders),
        cmocka_unit_test(test_context_refuses_techniques_of_another_version_or_name),
        cmocka_unit_test(test_context_refuses_too_many_occluders_and_keeps_the_list),
        cmocka_unit_test(test_context_refuses_ids_that_were_removed),
        cmocka_unit_test(test_context_refuses_matrices_that_are_the_wrong_way_round),
        cmocka_unit_test(test_record_leaves_out_what_was_removed_after_submitting),
        cmocka_unit_test(test_record_refuses_textures_of_another_size),
        cmocka_unit_test(test_record_refuses_matrices_that_are_no_camera),
        cmocka_unit_test(test_record_tells_an_error_of_gl_and_only_its_own),
        cmocka_unit_test(test_visibility_keeps_its_name_when_only_settings_change),
        cmocka_unit_test(test_record_refuses_a_context_without_techniques),
        cmocka_unit_test(test_context_refuses_damaged_volumes),
        cmocka_unit_test(test_context_refuses_meshes_that_are_none),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
