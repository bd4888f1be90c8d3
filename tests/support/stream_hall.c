#include "tests/support/stream_hall.h"
#include "engine/core/angle.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "modules/bake/voxelize.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const double spacing = 2.5, half_width = 1.6, eye_height = 1.2;
static const uint32_t resolutions[STREAM_HALL_LEVELS] = { 48, 24, 12 };
static const double errors[STREAM_HALL_LEVELS] = { 0.04, 0.08, 0.16 };

/* Two rows of pillars along -z, no two alike. */
static void make_body(uint32_t number, nook_fixture_mesh *out)
{
    double x = number % 2 ? half_width : -half_width, z = -spacing * (number / 2 + 1.0);
    double half = 0.25 + 0.011 * number, height = 1.1 + 0.037 * number;
    const double low[3] = { x - half, 0.0, z - half }, high[3] = { x + half, height, z + half };
    nook_fixture_add_box(out, low, high, 63);
}

static void bake(stream_hall *hall, uint32_t body, uint32_t level)
{
    const nook_fixture_mesh *mesh = &hall->bodies[body];
    const nook_triangles triangles = { .positions = mesh->positions,
                                       .vertex_count = mesh->vertex_count,
                                       .indices = mesh->indices,
                                       .index_count = mesh->index_count };
    const nook_voxelize_desc desc = { .resolution = resolutions[level], .threads = 1, .kind = hall->kind };
    char name[64];
    nook_volume volume;
    void *bytes;
    size_t size;
    snprintf(name, sizeof name, "pillar_%d_%u_%u.nkv", (int)hall->kind, body, level);
    nook_scratch_path(hall->paths[body][level], sizeof hall->paths[body][level], name);
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    hall->infos[body][level] = volume.info;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_file_write(hall->paths[body][level], bytes, size), NOOK_OK);
    free(bytes);
    nook_volume_free(&volume);
}

static void set_up_view(stream_hall *hall)
{
    hall->view = ao_view_create(STREAM_HALL_WIDTH, STREAM_HALL_HEIGHT);
    ao_view_param(hall->view, "ao.filter", "none");
    ao_view_param(hall->view, "ao.r_max", "2");
    ao_view_param(hall->view, "volume.rays", "8");
    ao_view_param(hall->view, "volume.combine", "union");
    ao_view_param(hall->view, "volume.sampling", "corners");
    ao_view_param(hall->view, "volume.kind", nook_volume_kind_name(hall->kind));
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++)
        ao_view_add(hall->view, &hall->bodies[i], 0);
}

void stream_hall_open(stream_hall *hall, nook_volume_kind kind)
{
    const double corner[3] = { -20.0, 0.0, -60.0 }, u[3] = { 0.0, 0.0, 80.0 }, v[3] = { 40.0, 0.0, 0.0 };
    memset(hall, 0, sizeof *hall);
    hall->kind = kind;
    nook_fixture_add_quad(&hall->ground, corner, u, v);
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++) {
        make_body(i, &hall->bodies[i]);
        for (uint32_t level = 0; level < STREAM_HALL_LEVELS; level++)
            bake(hall, i, level);
    }
    set_up_view(hall);
    stream_hall_look(hall, 0.0, 0.0);
}

void stream_hall_close(stream_hall *hall)
{
    nook_stream_destroy(hall->stream);
    ao_view_destroy(hall->view);
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++)
        nook_fixture_mesh_free(&hall->bodies[i]);
    nook_fixture_mesh_free(&hall->ground);
}

void stream_hall_add_all(stream_hall *hall)
{
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++) {
        nook_file file;
        assert_int_equal(nook_file_read(hall->paths[i][0], &file), NOOK_OK);
        assert_int_equal(
            nook_ao_add_volume(hall->view->ao, hall->paths[i][0], file.bytes, file.size, &hall->volumes[i]), NOOK_OK);
        hall->view->occluders[i].volume = hall->volumes[i];
        nook_file_free(&file);
    }
}

void stream_hall_add(stream_hall *hall, uint32_t body, uint32_t levels)
{
    nook_stream_level files[STREAM_HALL_LEVELS];
    for (uint32_t level = 0; level < levels; level++)
        files[level] = (nook_stream_level){ hall->paths[body][level], hall->infos[body][level], errors[level] };
    assert_int_equal(nook_stream_add(hall->stream, "pillar", files, levels, &hall->volumes[body]), NOOK_OK);
    hall->view->occluders[body].volume = hall->volumes[body];
}

void stream_hall_remove(stream_hall *hall, uint32_t body)
{
    nook_stream_remove(hall->stream, hall->volumes[body]);
    hall->view->occluders[body].volume = (nook_ao_volume){ 0 };
}

void stream_hall_start(stream_hall *hall, uint32_t levels, double mib)
{
    nook_stream_params params = nook_stream_params_initial();
    params.budget = (float)mib;
    assert_int_equal(nook_stream_create(hall->view->ao, &params, &hall->stream), NOOK_OK);
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++)
        stream_hall_add(hall, i, levels);
}

uint64_t stream_hall_bytes(const stream_hall *hall)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++)
        bytes += nook_volume_gpu_bytes(&hall->infos[i][0]);
    return bytes;
}

void stream_hall_look(stream_hall *hall, double metres, double degrees)
{
    double c = cos(degrees * NOOK_DEGREE), s = sin(degrees * NOOK_DEGREE);
    nook_matrix turn = nook_matrix_identity(), move = nook_matrix_translation(0.0, -eye_height, metres);
    turn.m[0] = c, turn.m[2] = s;
    turn.m[8] = -s, turn.m[10] = c;
    hall->view->view_from_world = nook_matrix_multiply(&turn, &move);
}

void stream_hall_update(stream_hall *hall)
{
    nook_stream_view view;
    memcpy(view.view_from_world, hall->view->view_from_world.m, sizeof view.view_from_world);
    memcpy(view.clip_from_view, hall->view->clip_from_view.m, sizeof view.clip_from_view);
    assert_int_equal(nook_stream_update(hall->stream, &view, 1, hall->view->occluders, hall->view->occluder_count),
                     NOOK_OK);
}

void stream_hall_settle(stream_hall *hall)
{
    const struct timespec pause = { 0, 1000 * 1000 };
    double end = nook_clock_ms() + 60000.0;
    do {
        stream_hall_update(hall);
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    } while (!nook_stream_is_settled(hall->stream));
}

void stream_hall_record(stream_hall *hall, float *out)
{
    nook_fixture_view_clear(hall->view);
    ao_view_draw(hall->view, &hall->ground);
    for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++)
        ao_view_draw(hall->view, &hall->bodies[i]);
    ao_view_record(hall->view, "volume");
    memcpy(out, hall->view->visibility, STREAM_HALL_PIXELS * sizeof *out);
}

nook_stream_status stream_hall_status(const stream_hall *hall)
{
    nook_stream_status status;
    nook_stream_get_status(hall->stream, &status);
    return status;
}
