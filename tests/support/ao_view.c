#include "tests/support/ao_view.h"
#include "modules/ao/technique.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"
#include "modules/bake/voxelize.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* The probe finds its view where the host's progress call would find its user: techniques have no state of their own. */
static nook_result probe_record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params;
    ao_view *view = pass->progress_user;
    size_t pixels = (size_t)pass->width * pass->height;
    float *painted = malloc(pixels * sizeof *painted);
    assert_non_null(painted);
    view->trace_width = pass->width, view->trace_height = pass->height;
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, view->trace_depth, pixels * sizeof(float));
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_UNSIGNED_SHORT, view->trace_normals,
                      pixels * sizeof *view->trace_normals);
    for (size_t i = 0; i < pixels; i++) {
        uint32_t x = (uint32_t)(i % pass->width), y = (uint32_t)(i / pass->width);
        painted[i] = view->paint ? view->paint(view, x, y) : 1.0f;
    }
    nook_texture_write(pass->gpu, pass->visibility, GL_RED, GL_FLOAT, painted, pixels * sizeof *painted);
    free(painted);
    return NOOK_OK;
}

static const nook_ao_technique probe = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "probe",
    .summary = "Keeps its inputs and writes what the test paints",
    .state_version = 1,
    .record = probe_record,
};

static void no_progress(void *user, double fraction)
{
    (void)user, (void)fraction;
}

static void create_buffers(ao_view *view, uint32_t width, uint32_t height)
{
    nook_gpu *gpu = view->gpu.gpu;
    size_t pixels = (size_t)width * height;
    view->width = width, view->height = height;
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &view->depth), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RG16, width, height, GL_NEAREST, &view->normal), NOOK_OK);
    view->device_depth = calloc(pixels, sizeof *view->device_depth);
    view->normals = calloc(pixels, sizeof *view->normals);
    view->visibility = calloc(pixels, sizeof *view->visibility);
    view->trace_depth = calloc(pixels, sizeof *view->trace_depth);
    view->trace_normals = calloc(pixels, sizeof *view->trace_normals);
    assert_non_null(view->trace_normals);
    ao_view_clear(view);
}

static void release_buffers(ao_view *view)
{
    nook_texture_destroy(view->gpu.gpu, &view->depth);
    nook_texture_destroy(view->gpu.gpu, &view->normal);
    free(view->device_depth);
    free(view->normals);
    free(view->visibility);
    free(view->trace_depth);
    free(view->trace_normals);
}

ao_view *ao_view_create(uint32_t width, uint32_t height)
{
    static const nook_ao_technique *const techniques[] = { &nook_ao_volume_technique, &nook_ao_ssao_technique,
                                                           &nook_ao_hsao_technique, &nook_ao_reference_technique,
                                                           &probe };
    ao_view *view = calloc(1, sizeof *view);
    assert_non_null(view);
    assert_int_equal(test_gpu_create(NULL, &view->gpu), NOOK_OK);
    nook_ao_desc desc = { .version = NOOK_AO_VERSION,
                          .gpu = view->gpu.gpu,
                          .width = width,
                          .height = height,
                          .progress = no_progress,
                          .progress_user = view };
    assert_int_equal(nook_ao_create(&desc, &view->ao), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++)
        assert_int_equal(nook_ao_add_technique(view->ao, techniques[i]), NOOK_OK);
    view->view_from_world = nook_matrix_identity();
    view->clip_from_view = nook_matrix_perspective_reversed(1.0, (double)width / height, 0.1);
    create_buffers(view, width, height);
    return view;
}

void ao_view_destroy(ao_view *view)
{
    nook_ao_destroy(view->ao);
    release_buffers(view);
    assert_false(nook_gpu_check(view->gpu.gpu, "the test"));
    test_gpu_destroy(&view->gpu);
    free(view);
}

void ao_view_resize(ao_view *view, uint32_t width, uint32_t height)
{
    release_buffers(view);
    create_buffers(view, width, height);
    assert_int_equal(nook_ao_set_size(view->ao, width, height), NOOK_OK);
}

void ao_view_param(ao_view *view, const char *name, const char *value)
{
    assert_int_equal(nook_ao_parse_param(view->ao, name, value), NOOK_OK);
}

void ao_view_clear(ao_view *view)
{
    float background = view->clip_from_view.m[14] > 0.0 ? 0.0f : 1.0f;
    for (size_t i = 0; i < (size_t)view->width * view->height; i++)
        view->device_depth[i] = background;
}

void ao_view_position(const ao_view *view, double x, double y, double distance, double out[3])
{
    const double *p = view->clip_from_view.m;
    out[0] = (2.0 * (x + 0.5) / view->width - 1.0 + p[8]) / p[0] * distance;
    out[1] = (2.0 * (y + 0.5) / view->height - 1.0 + p[9]) / p[5] * distance;
    out[2] = -distance;
}

float ao_view_device_depth(const ao_view *view, double distance)
{
    const double *p = view->clip_from_view.m;
    return (float)((p[10] * -distance + p[14]) / distance); /* clip z over clip w = distance */
}

void ao_view_set_pixel(ao_view *view, uint32_t x, uint32_t y, double distance, const double normal[3])
{
    size_t i = (size_t)y * view->width + x;
    view->device_depth[i] = ao_view_device_depth(view, distance);
    ao_encode_normal(normal, view->normals[i]);
}

static double add_volume(ao_view *view, const fixture_mesh *mesh, uint32_t resolution, nook_ao_volume *out)
{
    nook_triangles triangles = { .positions = mesh->positions,
                                 .vertex_count = mesh->vertex_count,
                                 .indices = mesh->indices,
                                 .index_count = mesh->index_count };
    nook_voxelize_desc desc = { .resolution = resolution, .threads = 1 };
    nook_volume volume;
    void *bytes;
    size_t size;
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    double voxel_size = volume.info.voxel_size;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_ao_add_volume(view->ao, "fixture", bytes, size, out), NOOK_OK);
    free(bytes);
    nook_volume_free(&volume);
    return voxel_size;
}

double ao_view_add(ao_view *view, const fixture_mesh *mesh, uint32_t resolution)
{
    assert_true(view->occluder_count < AO_VIEW_OCCLUDERS);
    nook_ao_occluder *occluder = &view->occluders[view->occluder_count++];
    *occluder = (nook_ao_occluder){ 0 };
    for (int i = 0; i < 16; i += 5)
        occluder->world_from_mesh[i] = 1.0;
    assert_int_equal(nook_ao_add_mesh(view->ao, mesh->positions, mesh->vertex_count, mesh->indices, mesh->index_count,
                                      &occluder->mesh),
                     NOOK_OK);
    return resolution ? add_volume(view, mesh, resolution, &occluder->volume) : 0.0;
}

void ao_view_drop_occluders(ao_view *view)
{
    for (uint32_t i = 0; i < view->occluder_count; i++) {
        nook_ao_remove_volume(view->ao, view->occluders[i].volume);
        nook_ao_remove_mesh(view->ao, view->occluders[i].mesh);
    }
    view->occluder_count = 0;
}

static void read_visibility(ao_view *view)
{
    size_t pixels = (size_t)view->width * view->height;
    nook_ao_texture out = nook_ao_visibility(view->ao);
    assert_int_equal(out.width, view->width);
    assert_int_equal(out.height, view->height);
    nook_texture texture = { .id = out.native,
                             .target = GL_TEXTURE_2D,
                             .width = out.width,
                             .height = out.height,
                             .depth = 1,
                             .format = GL_R32F };
    nook_texture_read(view->gpu.gpu, texture, GL_RED, GL_FLOAT, view->visibility, pixels * sizeof(float));
    for (size_t i = 0; i < pixels; i++)
        assert_true(view->visibility[i] >= 0.0f && view->visibility[i] <= 1.0f); /* never NaN, never out of range */
}

void ao_view_record(ao_view *view, const char *technique)
{
    size_t pixels = (size_t)view->width * view->height;
    nook_gpu *gpu = view->gpu.gpu;
    nook_texture_write(gpu, view->depth, GL_RED, GL_FLOAT, view->device_depth, pixels * sizeof(float));
    nook_texture_write(gpu, view->normal, GL_RG, GL_UNSIGNED_SHORT, view->normals, pixels * sizeof *view->normals);
    nook_ao_frame frame = { .depth = { view->depth.id, view->width, view->height }, .index = view->index };
    if (!view->without_normals)
        frame.normal = (nook_ao_texture){ view->normal.id, view->width, view->height };
    memcpy(frame.view_from_world, view->view_from_world.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, view->clip_from_view.m, sizeof frame.clip_from_view);
    assert_int_equal(nook_ao_set_technique(view->ao, technique), NOOK_OK);
    assert_int_equal(nook_ao_submit_occluders(view->ao, view->occluders, view->occluder_count), NOOK_OK);
    assert_int_equal(nook_ao_record(view->ao, &frame), NOOK_OK);
    read_visibility(view);
}

static uint16_t octahedral_code(double v)
{
    return (uint16_t)lround(v * 32767.0 + 32768.0);
}

void ao_encode_normal(const double n[3], uint16_t out[2])
{
    double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), x = n[0] / sum, y = n[1] / sum;
    if (n[2] < 0.0) {
        double folded = (1.0 - fabs(y)) * (x >= 0.0 ? 1.0 : -1.0);
        y = (1.0 - fabs(x)) * (y >= 0.0 ? 1.0 : -1.0);
        x = folded;
    }
    out[0] = octahedral_code(x), out[1] = octahedral_code(y);
}

void ao_decode_normal(const uint16_t code[2], double out[3])
{
    double x = (code[0] - 32768.0) / 32767.0, y = (code[1] - 32768.0) / 32767.0, z = 1.0 - fabs(x) - fabs(y);
    if (z < 0.0) {
        double folded = (1.0 - fabs(y)) * (x >= 0.0 ? 1.0 : -1.0);
        y = (1.0 - fabs(x)) * (y >= 0.0 ? 1.0 : -1.0);
        x = folded;
    }
    double length = sqrt(x * x + y * y + z * z);
    out[0] = x / length, out[1] = y / length, out[2] = z / length;
}
