/* hao and what a host does to it: bodies that move, come and go, far worlds, sizes and memory that a device has not. */
#include "modules/ao/technique.h"
#include "modules/ao_hao/hao.h"
#include "tests/support/ao_screen.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

/** A floor with a box on it, and a roof over its left half that the picture does not show. */
static void build(nook_fixture_view *view, double roof_x)
{
    nook_fixture_mesh mesh = { 0 };
    ao_screen_look(view, (double[]){ 0, -2, 1.2 }, (double[]){ 0, 0, 0 }, 0.7, 0.8);
    nook_fixture_add_quad(&mesh, (double[]){ -3, -3, 0 }, (double[]){ 6, 0, 0 }, (double[]){ 0, 6, 0 });
    ao_screen_show(view, &mesh);
    nook_fixture_add_box(&mesh, (double[]){ -0.2, -0.2, 0 }, (double[]){ 0.2, 0.2, 0.3 }, 63);
    ao_screen_show(view, &mesh);
    nook_fixture_add_quad(&mesh, (double[]){ roof_x, -1, 0.6 }, (double[]){ 1, 0, 0 }, (double[]){ 0, 2, 0 });
    ao_view_add(view, &mesh, 0);
    nook_fixture_mesh_free(&mesh);
    nook_ao_reset_params(view->ao);
    ao_view_param(view, "ao.r_max", "0.8");
    ao_view_param(view, "ao.filter", "none");
    ao_view_param(view, "hao.voxels", "96");
    ao_view_param(view, "hao.rays", "16");
    view->index = 0;
}

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

typedef float picture[PIXELS];

static void record(nook_fixture_view *view, picture out)
{
    ao_view_record(view, "hao");
    memcpy(out, view->visibility, sizeof(picture));
}

static bool same(const picture a, const picture b)
{
    return memcmp(a, b, sizeof(picture)) == 0;
}

static double rms(const picture a, const picture b)
{
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++)
        sum += ((double)a[i] - (double)b[i]) * ((double)a[i] - (double)b[i]);
    return sqrt(sum / PIXELS);
}

static const int roof = 2; /* its occluder */

static void shift_roof(nook_fixture_view *view, double x)
{
    view->occluders[roof].world_from_mesh[12] = x;
}

static void test_a_body_that_moves_takes_its_occlusion_along(void **state)
{
    nook_fixture_view *view = *state;
    picture there, moved, back, made_there;
    for (int maps = 0; maps < 2; maps++) {
        build(view, -1.0);
        nook_ao_set_param(view->ao, "hao.slicemaps", maps);
        record(view, back);
        shift_roof(view, 1.0);
        record(view, moved);
        shift_roof(view, 0.0);
        record(view, there);
        assert_true(same(back, there));
        assert_true(rms(moved, back) > 0.05);
        build(view, 0.0);
        nook_ao_set_param(view->ao, "hao.slicemaps", maps);
        record(view, made_there);
        assert_true(same(moved, made_there));
    }
}

static void test_a_body_that_goes_takes_its_occlusion_with_it_and_one_that_comes_brings_it(void **state)
{
    nook_fixture_view *view = *state;
    picture with, without, again;
    build(view, -1.0);
    record(view, with);
    view->occluder_count = 2;
    record(view, without);
    view->occluder_count = 3;
    record(view, again);
    assert_true(same(with, again));
    double darker = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        assert_true(with[i] <= without[i] + 0.3f); /* the grid is another one: it ends at the roof */
        darker += (double)(without[i] - with[i]);
    }
    assert_true(darker / PIXELS > 0.02);
}

static void test_the_same_frame_is_the_same_bits_whatever_was_recorded_between(void **state)
{
    nook_fixture_view *view = *state;
    picture before, other, after;
    build(view, -1.0);
    record(view, before);
    nook_matrix looked = view->view_from_world;
    ao_view_param(view, "hao.slicemaps", "three");
    ao_view_param(view, "hao.voxels", "160");
    view->view_from_world.m[12] += 0.3;
    record(view, other);
    view->view_from_world = looked;
    ao_view_param(view, "hao.slicemaps", "one");
    ao_view_param(view, "hao.voxels", "96");
    record(view, after);
    assert_true(same(before, after));
    assert_true(rms(before, other) > 0.01);
}

static void test_occluders_without_meshes_and_no_occluders_leave_everything_open(void **state)
{
    nook_fixture_view *view = *state;
    picture open;
    build(view, -1.0);
    for (uint32_t i = 0; i < view->occluder_count; i++)
        view->occluders[i].mesh = (nook_ao_mesh){ 0 };
    record(view, open);
    for (int i = 0; i < PIXELS; i++)
        assert_true(open[i] == 1.0f);
    nook_fixture_view_drop_occluders(view);
    record(view, open);
    for (int i = 0; i < PIXELS; i++)
        assert_true(open[i] == 1.0f);
}

static void test_a_mesh_without_triangles_and_a_flat_matrix_occlude_nothing(void **state)
{
    nook_fixture_view *view = *state;
    picture before, after;
    nook_fixture_mesh none = { 0 };
    build(view, -1.0);
    record(view, before);
    nook_matrix flat = nook_matrix_scale(1.0, 1.0, 0.0);
    assert_int_equal(nook_fixture_view_add_instance(view, 1, &flat), NOOK_OK);
    record(view, after);
    assert_true(same(before, after));
    nook_ao_mesh empty;
    assert_int_equal(nook_ao_add_mesh(view->ao, (const float[]){ 0, 0, 0 }, 1, none.indices, 0, &empty), NOOK_OK);
    view->occluders[3].mesh = empty;
    memcpy(view->occluders[3].world_from_mesh, nook_matrix_identity().m, sizeof(nook_matrix));
    record(view, after);
    assert_true(same(before, after));
    nook_ao_remove_mesh(view->ao, empty);
}

static void test_a_world_far_from_its_origin_looks_the_same(void **state)
{
    nook_fixture_view *view = *state;
    const double far = 1048576.0;
    picture near, away;
    build(view, -1.0);
    ao_view_param(view, "hao.slicemaps", "three");
    ao_view_param(view, "hao.rays", "256");
    ao_view_param(view, "hao.tests", "64");
    record(view, near);
    for (uint32_t i = 0; i < view->occluder_count; i++)
        view->occluders[i].world_from_mesh[12] += far;
    nook_matrix back = nook_matrix_translation(-far, 0, 0);
    view->view_from_world = nook_matrix_multiply(&view->view_from_world, &back);
    record(view, away);
    if (rms(near, away) >= 0.05) /* voxels and noise begin elsewhere */
        fail_msg("RMS %.4f", rms(near, away));
    double mean_near = 0.0, mean_away = 0.0;
    for (int i = 0; i < PIXELS; i++)
        mean_near += (double)near[i] / PIXELS, mean_away += (double)away[i] / PIXELS;
    assert_true(fabs(mean_near - mean_away) < 0.005);
}

static void test_a_mirrored_body_and_a_skewed_one_occlude_like_their_triangles(void **state)
{
    nook_fixture_view *view = *state;
    picture mirrored, made;
    build(view, 0.2);
    view->occluders[roof].world_from_mesh[0] = -1.0; /* 0.2 .. 1.2 becomes -1.2 .. -0.2 */
    record(view, mirrored);
    build(view, -1.2);
    record(view, made);
    assert_true(same(mirrored, made));
}

/* ---- what a record makes ---- */

static const nook_gl *real;
static uint32_t made, deleted;
static uint32_t out_of_memory_after;

static void APIENTRY count_textures(GLenum target, GLsizei count, GLuint *names)
{
    made += (uint32_t)count;
    real->CreateTextures(target, count, names);
}

static void APIENTRY count_buffers(GLsizei count, GLuint *names)
{
    made += (uint32_t)count;
    real->CreateBuffers(count, names);
}

static void APIENTRY count_deleted_textures(GLsizei count, const GLuint *names)
{
    deleted += (uint32_t)count;
    real->DeleteTextures(count, names);
}

static void APIENTRY count_deleted_buffers(GLsizei count, const GLuint *names)
{
    deleted += (uint32_t)count;
    real->DeleteBuffers(count, names);
}

static void APIENTRY count_framebuffers(GLsizei count, GLuint *names)
{
    made += (uint32_t)count;
    real->CreateFramebuffers(count, names);
}

static void APIENTRY count_vertex_arrays(GLsizei count, GLuint *names)
{
    made += (uint32_t)count;
    real->CreateVertexArrays(count, names);
}

static GLuint APIENTRY count_programs(GLenum type)
{
    made++;
    return real->CreateShader(type);
}

static void test_nothing_is_made_in_a_steady_state_though_bodies_and_views_move(void **state)
{
    nook_fixture_view *view = *state;
    nook_gl counting = *view->gpu->gl;
    picture out;
    build(view, -1.0);
    real = view->gpu->gl;
    counting.CreateTextures = count_textures;
    counting.CreateBuffers = count_buffers;
    counting.CreateFramebuffers = count_framebuffers;
    counting.CreateVertexArrays = count_vertex_arrays;
    counting.CreateShader = count_programs;
    nook_matrix looked = view->view_from_world;
    for (int frame = 0; frame < 24; frame++) {
        if (frame == 4) {
            view->gpu->gl = &counting;
            made = 0;
        }
        nook_ao_set_param(view->ao, "hao.slicemaps", frame & 1);
        nook_ao_set_param(view->ao, "hao.voxels", frame & 2 ? 64 : 160); /* two views that take turns */
        shift_roof(view, 0.1 * frame);
        view->view_from_world = looked;
        view->view_from_world.m[12] += 0.01 * frame;
        view->occluder_count = frame % 3 == 2 ? 2 : 3;
        record(view, out);
    }
    view->gpu->gl = real;
    assert_int_equal(made, 0);
}

static void test_meshes_that_come_and_go_leave_nothing_behind(void **state)
{
    nook_fixture_view *view = *state;
    nook_gl counting = *view->gpu->gl;
    picture out;
    uint32_t first = 0;
    real = view->gpu->gl;
    counting.CreateTextures = count_textures;
    counting.CreateBuffers = count_buffers;
    counting.DeleteTextures = count_deleted_textures;
    counting.DeleteBuffers = count_deleted_buffers;
    view->gpu->gl = &counting;
    made = deleted = 0;
    for (int round = 0; round < 20; round++) {
        build(view, -1.0 + 0.1 * round);
        record(view, out);
        nook_fixture_view_drop_occluders(view);
        record(view, out);
        first = round == 1 ? made - deleted : first;
    }
    view->gpu->gl = real;
    assert_true(made >= 20 * 6); /* three meshes of two buffers each time */
    assert_int_equal(made - deleted, first);
}

/* ---- code that is replaced ---- */

/** By code that is the same and stands elsewhere, as a shared library that was loaded again does. */
static void replace(nook_fixture_view *view, int keep_state)
{
    static nook_ao_technique copies[2];
    static int next;
    nook_ao_technique *copy = &copies[next++ % 2];
    *copy = nook_ao_hao_technique;
    assert_int_equal(nook_ao_replace_technique(view->ao, copy, keep_state), NOOK_OK);
}

static void test_code_that_is_replaced_makes_the_same_picture_with_the_old_state_or_a_new_one(void **state)
{
    nook_fixture_view *view = *state;
    picture before, after;
    build(view, -1.0);
    record(view, before);
    for (int i = 0; i < 4; i++) {
        replace(view, i & 1);
        record(view, after);
        assert_true(same(before, after));
    }
}

/* ---- what a device has not ---- */

static nook_result record_quietly(nook_fixture_view *view, nook_log_capture *log)
{
    nook_log_capture_begin(log);
    nook_result result = nook_fixture_view_record(view, "hao");
    nook_log_capture_end();
    return result;
}

static void test_a_grid_that_the_device_cannot_hold_is_one_clear_line_and_the_next_record_works(void **state)
{
    nook_fixture_view *view = *state;
    nook_log_capture log;
    picture out;
    build(view, -1.0);
    ao_view_param(view, "hao.voxels", "500");
    uint32_t most = view->gpu->max_texture_3d_size;
    view->gpu->max_texture_3d_size = 256;
    nook_result result = record_quietly(view, &log);
    view->gpu->max_texture_3d_size = most;
    assert_int_equal(result, NOOK_E_RANGE);
    assert_int_equal(log.errors, 1);
    assert_non_null(strstr(log.text, "500 x 500 x 4"));
    record(view, out);
}

static GLenum APIENTRY run_out(void)
{
    GLenum error = real->GetError();
    return made > out_of_memory_after && error == GL_NO_ERROR ? GL_OUT_OF_MEMORY : error;
}

static void test_memory_that_runs_out_anywhere_is_an_error_and_the_next_record_works(void **state)
{
    nook_fixture_view *view = *state;
    nook_gl failing = *view->gpu->gl;
    picture good, after;
    build(view, -1.0);
    record(view, good);
    uint32_t failures = 0;
    for (out_of_memory_after = 0; out_of_memory_after < 8; out_of_memory_after++) {
        nook_log_capture log;
        real = view->gpu->gl;
        failing = *real;
        failing.CreateTextures = count_textures;
        failing.CreateBuffers = count_buffers;
        failing.GetError = run_out;
        replace(view, 0); /* an empty state */
        view->gpu->gl = &failing;
        made = 0;
        nook_result result = record_quietly(view, &log);
        view->gpu->gl = real;
        if (result != NOOK_OK) {
            failures++;
            assert_int_equal(result, NOOK_E_MEMORY);
        }
        record(view, after);
        assert_true(same(good, after));
    }
    assert_true(failures >= 6); /* directions, three meshes of two buffers, the slicemap */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_body_that_moves_takes_its_occlusion_along),
        cmocka_unit_test(test_a_body_that_goes_takes_its_occlusion_with_it_and_one_that_comes_brings_it),
        cmocka_unit_test(test_the_same_frame_is_the_same_bits_whatever_was_recorded_between),
        cmocka_unit_test(test_occluders_without_meshes_and_no_occluders_leave_everything_open),
        cmocka_unit_test(test_a_mesh_without_triangles_and_a_flat_matrix_occlude_nothing),
        cmocka_unit_test(test_a_world_far_from_its_origin_looks_the_same),
        cmocka_unit_test(test_a_mirrored_body_and_a_skewed_one_occlude_like_their_triangles),
        cmocka_unit_test(test_nothing_is_made_in_a_steady_state_though_bodies_and_views_move),
        cmocka_unit_test(test_meshes_that_come_and_go_leave_nothing_behind),
        cmocka_unit_test(test_code_that_is_replaced_makes_the_same_picture_with_the_old_state_or_a_new_one),
        cmocka_unit_test(test_a_grid_that_the_device_cannot_hold_is_one_clear_line_and_the_next_record_works),
        cmocka_unit_test(test_memory_that_runs_out_anywhere_is_an_error_and_the_next_record_works),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
