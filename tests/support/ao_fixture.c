#include "tests/support/ao_fixture.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"
#include "modules/bake/voxelize.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

int ao_fixture_setup(void **state)
{
    static const nook_ao_technique *const techniques[] = { &nook_ao_volume_technique, &nook_ao_ssao_technique,
                                                           &nook_ao_hsao_technique, &nook_ao_reference_technique };
    ao_fixture *fixture = calloc(1, sizeof *fixture);
    assert_non_null(fixture);
    assert_int_equal(test_gpu_create(NULL, &fixture->gpu), NOOK_OK);
    nook_gpu *gpu = fixture->gpu.gpu;
    nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = gpu, .width = AO_FIXTURE_SIZE, .height = AO_FIXTURE_SIZE };
    assert_int_equal(nook_ao_create(&desc, &fixture->ao), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++)
        assert_int_equal(nook_ao_add_technique(fixture->ao, techniques[i]), NOOK_OK);
    uint32_t size = AO_FIXTURE_SIZE;
    assert_int_equal(nook_texture_create_2d(gpu, GL_R32F, size, size, GL_NEAREST, &fixture->depth), NOOK_OK);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RG16, size, size, GL_NEAREST, &fixture->normal), NOOK_OK);
    fixture->view_angle = 1e-3;
    ao_fixture_param(fixture, "ao.filter", "none");
    *state = fixture;
    return 0;
}

int ao_fixture_teardown(void **state)
{
    ao_fixture *fixture = *state;
    nook_ao_destroy(fixture->ao);
    nook_texture_destroy(fixture->gpu.gpu, &fixture->depth);
    nook_texture_destroy(fixture->gpu.gpu, &fixture->normal);
    test_gpu_destroy(&fixture->gpu);
    free(fixture);
    return 0;
}

void ao_fixture_param(ao_fixture *fixture, const char *name, const char *value)
{
    assert_int_equal(nook_ao_parse_param(fixture->ao, name, value), NOOK_OK);
}

void ao_fixture_clear(ao_fixture *fixture)
{
    for (uint32_t i = 0; i < fixture->occluder_count; i++) {
        nook_ao_remove_volume(fixture->ao, fixture->occluders[i].volume);
        nook_ao_remove_mesh(fixture->ao, fixture->occluders[i].mesh);
    }
    fixture->occluder_count = 0;
}

static double add_volume(ao_fixture *fixture, const fixture_mesh *mesh, uint32_t resolution, nook_ao_volume *out)
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
    assert_int_equal(nook_ao_add_volume(fixture->ao, "fixture", bytes, size, out), NOOK_OK);
    free(bytes);
    nook_volume_free(&volume);
    return voxel_size;
}

double ao_fixture_add(ao_fixture *fixture, const fixture_mesh *mesh, uint32_t resolution)
{
    assert_true(fixture->occluder_count < AO_FIXTURE_OCCLUDERS);
    nook_ao_occluder *occluder = &fixture->occluders[fixture->occluder_count++];
    *occluder = (nook_ao_occluder){ 0 };
    for (int i = 0; i < 16; i += 5)
        occluder->world_from_mesh[i] = 1.0;
    assert_int_equal(nook_ao_add_mesh(fixture->ao, mesh->positions, mesh->vertex_count, mesh->indices,
                                      mesh->index_count, &occluder->mesh),
                     NOOK_OK);
    return resolution ? add_volume(fixture, mesh, resolution, &occluder->volume) : 0.0;
}

static uint16_t octahedral_code(double v)
{
    return (uint16_t)lround(v * 32767.0 + 32768.0);
}

static void encode_normal(const double n[3], uint16_t out[2])
{
    double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), x = n[0] / sum, y = n[1] / sum;
    if (n[2] < 0.0) {
        double folded = (1.0 - fabs(y)) * (x >= 0.0 ? 1.0 : -1.0);
        y = (1.0 - fabs(x)) * (y >= 0.0 ? 1.0 : -1.0);
        x = folded;
    }
    out[0] = octahedral_code(x), out[1] = octahedral_code(y);
}

/** The receiver's plane, seen head-on: the same depth and normal in every pixel. */
static void fill_buffers(ao_fixture *fixture, const double normal[3], double device_depth)
{
    enum { PIXELS = AO_FIXTURE_SIZE * AO_FIXTURE_SIZE };
    float depth[PIXELS];
    uint16_t normals[PIXELS][2];
    for (int i = 0; i < PIXELS; i++) {
        depth[i] = (float)device_depth;
        encode_normal(normal, normals[i]);
    }
    nook_texture_write(fixture->gpu.gpu, fixture->depth, GL_RED, GL_FLOAT, depth, sizeof depth);
    nook_texture_write(fixture->gpu.gpu, fixture->normal, GL_RG, GL_UNSIGNED_SHORT, normals, sizeof normals);
}

static fixture_result summarize(const float *visibility, size_t count)
{
    fixture_result result = { .lowest = 2.0, .highest = -1.0 };
    for (size_t i = 0; i < count; i++) {
        double occlusion = 1.0 - visibility[i];
        assert_true(occlusion >= 0.0 && occlusion <= 1.0); /* never NaN, never out of range */
        result.mean += occlusion / (double)count;
        result.lowest = occlusion < result.lowest ? occlusion : result.lowest;
        result.highest = occlusion > result.highest ? occlusion : result.highest;
    }
    return result;
}

fixture_result ao_fixture_measure(ao_fixture *fixture, const char *technique, const double point[3],
                                  const double normal[3], double distance)
{
    const double z_near = 0.1 * distance;
    double eye[3], up[3] = { 0, 0, 0 };
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = point[axis] + normal[axis] * distance;
    up[fabs(normal[1]) < 0.9 ? 1 : 0] = 1.0;
    nook_matrix view = nook_matrix_look_at(eye, point, up);
    nook_matrix clip = nook_matrix_perspective_reversed(fixture->view_angle, 1.0, z_near);
    fill_buffers(fixture, normal, z_near / distance);

    nook_ao_frame frame = { .depth = { fixture->depth.id, AO_FIXTURE_SIZE, AO_FIXTURE_SIZE },
                            .normal = { fixture->normal.id, AO_FIXTURE_SIZE, AO_FIXTURE_SIZE } };
    memcpy(frame.view_from_world, view.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, clip.m, sizeof frame.clip_from_view);
    assert_int_equal(nook_ao_set_technique(fixture->ao, technique), NOOK_OK);
    assert_int_equal(nook_ao_submit_occluders(fixture->ao, fixture->occluders, fixture->occluder_count), NOOK_OK);
    assert_int_equal(nook_ao_record(fixture->ao, &frame), NOOK_OK);

    float visibility[AO_FIXTURE_SIZE * AO_FIXTURE_SIZE];
    nook_ao_texture out = nook_ao_visibility(fixture->ao);
    nook_texture texture = { .id = out.native,
                             .target = GL_TEXTURE_2D,
                             .width = out.width,
                             .height = out.height,
                             .depth = 1,
                             .format = GL_R32F };
    nook_texture_read(fixture->gpu.gpu, texture, GL_RED, GL_FLOAT, visibility, sizeof visibility);
    return summarize(visibility, NOOK_COUNT(visibility));
}
