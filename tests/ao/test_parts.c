/* Parts of a picture: what is inside is the whole picture's bit for bit, what is outside stays. */
#include "modules/ao/technique.h"
#include "tests/support/ao_screen.h"
#include "tests/support/log_capture.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 67, HEIGHT = 45, PIXELS = WIDTH * HEIGHT };

static const char *const techniques[] = { "volume", "ssao", "hsao", "hbao", "gtao", "hao", "reference" };
static const char *const filters[] = { "none", "disc", "tile" };
static const char *const upscales[] = { "direct", "stepped", "bilinear" };
static const nook_rectangle parts[] = { { 0, 0, 33, HEIGHT }, { 17, 9, 1, 1 },   { 21, 5, 40, 13 },
                                        { 66, 44, 1, 1 },     { 3, 30, 64, 15 }, { 0, 0, WIDTH, HEIGHT } };

/** A room's corner with two boxes in it, one volume each, and sky beside. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    static const double boxes[][2][3] = { { { -0.5, -0.6, 0 }, { 0.1, 0.0, 0.5 } },
                                          { { 0.15, -0.4, 0 }, { 0.6, 0.3, 0.3 } } };
    ao_screen_look(view, (double[]){ -1.5, -2, 1.5 }, (double[]){ 0.1, 0, 0.2 }, 1.0, 0.6);
    for (size_t i = 0; i < 3; i++) {
        nook_fixture_mesh mesh = { 0 };
        if (i == 2)
            nook_fixture_add_quad(&mesh, (double[]){ -1, -1, 0 }, (double[]){ 2, 0, 0 }, (double[]){ 0, 2, 0 });
        else
            nook_fixture_add_box(&mesh, boxes[i][0], boxes[i][1], 63);
        ao_view_draw(view, &mesh);
        ao_view_add(view, &mesh, 24);
        nook_fixture_mesh_free(&mesh);
    }
    ao_view_param(view, "ao.filter_radius", "9");
    ao_view_param(view, "reference.rays", "8");
    ao_view_param(view, "ssao.samples", "4");
    ao_view_param(view, "volume.rays", "2");
    ao_view_param(view, "hsao.directions", "2");
    ao_view_param(view, "hsao.rays", "1");
    ao_view_param(view, "hao.voxels", "48"); /* large enough for a few tests to meet */
    ao_view_param(view, "hao.slicemaps", "three");
    ao_view_param(view, "hao.rays", "8");
    *state = view;
    return 0;
}

static bool inside(const nook_rectangle *part, uint32_t x, uint32_t y)
{
    return x >= part->x && x - part->x < part->width && y >= part->y && y - part->y < part->height;
}

/** All open: what a picture holds before a part of it is recorded. */
static void record_open(nook_fixture_view *view)
{
    view->part = (nook_rectangle){ 0 };
    view->same_view = false;
    ao_view_record(view, "probe");
}

static void expect_part(nook_fixture_view *view, const char *technique, const float *whole, const char *scale,
                        const char *filter)
{
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            size_t i = (size_t)y * WIDTH + x;
            float wanted = inside(&view->part, x, y) ? whole[i] : 1.0f;
            if (memcmp(&view->visibility[i], &wanted, sizeof wanted) != 0)
                fail_msg("%s, scale %s, filter %s, part %u %u %u %u: pixel %u, %u is %.9g, not %.9g", technique, scale,
                         filter, view->part.x, view->part.y, view->part.width, view->part.height, x, y,
                         (double)view->visibility[i], (double)wanted);
        }
    }
}

/** @return how many pixels of the whole picture are darkened: a test of nothing would pass */
static uint32_t compare_parts(nook_fixture_view *view, const char *technique, const char *scale, const char *filter)
{
    float whole[PIXELS];
    uint32_t dark = 0;
    record_open(view);
    ao_view_param(view, "ao.scale", scale);
    ao_view_param(view, "ao.filter", filter);
    ao_view_record(view, technique);
    memcpy(whole, view->visibility, sizeof whole);
    for (size_t i = 0; i < PIXELS; i++)
        dark += whole[i] < 0.9f;
    for (size_t k = 0; k < NOOK_COUNT(parts); k++) {
        record_open(view);
        view->part = parts[k];
        view->same_view = k % 2;
        ao_view_record(view, technique);
        expect_part(view, technique, whole, scale, filter);
    }
    view->part = (nook_rectangle){ 0 };
    view->same_view = false;
    return dark;
}

static void test_part_is_bit_for_bit_that_of_the_whole_picture(void **state)
{
    nook_fixture_view *view = *state;
    for (size_t t = 0; t < NOOK_COUNT(techniques); t++) {
        for (size_t s = 0; s < NOOK_FIXTURE_SCALES; s++) {
            for (size_t f = 0; f < NOOK_COUNT(filters) * (s > 0 ? NOOK_COUNT(upscales) : 1); f++) {
                ao_view_param(view, "ao.upscale", upscales[f / NOOK_COUNT(filters)]);
                assert_true(compare_parts(view, techniques[t], nook_fixture_scales[s],
                                          filters[f % NOOK_COUNT(filters)]) > PIXELS / 50);
            }
        }
    }
}

static void test_part_without_occluders_is_open_and_nothing_else_changes(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t occluders = view->occluder_count;
    ao_view_param(view, "ao.scale", "full");
    ao_view_param(view, "ao.filter", "none");
    ao_view_record(view, "ssao");
    float before[PIXELS];
    memcpy(before, view->visibility, sizeof before);
    view->occluder_count = 0;
    view->part = parts[2];
    ao_view_record(view, "volume");
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_true(view->visibility[i] == (inside(&parts[2], i % WIDTH, i / WIDTH) ? 1.0f : before[i]));
    view->part = (nook_rectangle){ 0 };
    view->occluder_count = occluders;
}

static void test_part_outside_of_the_picture_is_refused(void **state)
{
    static const nook_rectangle wrong[] = { { 0, 0, WIDTH + 1, 1 },  { 0, HEIGHT, 1, 1 },    { 1, 0, WIDTH, 1 },
                                            { 0, 0, 0, 1 },          { 5, 5, 1, 0 },         { 1, 0, 0, 0 },
                                            { UINT32_MAX, 0, 2, 2 }, { 0, 2, 1, UINT32_MAX } };
    nook_fixture_view *view = *state;
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_log_capture log;
        view->part = wrong[i];
        nook_log_capture_begin(&log);
        nook_result result = nook_fixture_view_record(view, "ssao");
        nook_log_capture_end();
        assert_int_equal(result, NOOK_E_RANGE);
        assert_int_equal(log.count, 1);
    }
    view->part = (nook_rectangle){ 0 };
}

static void test_same_view_reads_the_host_s_buffers_only_when_their_copies_are_gone(void **state)
{
    nook_fixture_view *view = *state;
    float before[PIXELS];
    ao_view_param(view, "ao.upscale", "direct"); /* stepped keeps no copy of the full size */
    for (size_t s = 0; s < NOOK_FIXTURE_SCALES; s++) {
        ao_view_param(view, "ao.scale", nook_fixture_scales[s]);
        ao_view_record(view, "gtao");
        memcpy(before, view->visibility, sizeof before);
        float kept = view->device_depth[20 * WIDTH + 30];
        for (uint32_t i = 0; i < WIDTH; i++)
            view->device_depth[20 * WIDTH + i] *= 0.9f; /* a step back */
        view->same_view = true;
        ao_view_record(view, "gtao");
        assert_memory_equal(view->visibility, before, sizeof before);
        view->same_view = false;
        ao_view_record(view, "gtao");
        assert_memory_not_equal(view->visibility, before, sizeof before);
        for (uint32_t i = 0; i < WIDTH; i++)
            view->device_depth[20 * WIDTH + i] /= 0.9f;
        assert_true(view->device_depth[20 * WIDTH + 30] > 0.999f * kept);
    }
}

/** Records the view's part with fetches counted into an image that held none. */
static void count_fetches(nook_fixture_view *view, nook_texture image, const char *technique, uint32_t *out_pixels)
{
    const uint32_t zero = 0;
    view->gpu->gl->ClearTexImage(image.id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    view->fetches = (nook_ao_texture){ image.id, WIDTH, HEIGHT };
    ao_view_record(view, technique);
    view->fetches = (nook_ao_texture){ 0 };
    nook_texture_read(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, out_pixels, PIXELS * sizeof *out_pixels);
}

/** What the image says in sum, and what the counter says; then a part, which must say the same of its pixels, and of no others. */
static void expect_same_fetches(nook_fixture_view *view, nook_texture image, const char *technique)
{
    static uint32_t whole[PIXELS], part[PIXELS];
    double sum = 0.0, geometry = 0.0;
    nook_ao_statistics statistics;
    count_fetches(view, image, technique, whole);
    nook_ao_get_statistics(view->ao, &statistics);
    for (uint32_t i = 0; i < PIXELS; i++) {
        geometry += view->device_depth[i] > 0.0f;
        sum += whole[i] / (double)NOOK_AO_FETCH_UNITS;
    }
    double counted = statistics.fetches_per_pixel * geometry;
    if (!(counted > 0.0) || sum < 0.98 * counted ||
        sum > 1.0000001 * counted) /* blocks that the border cuts lose a part */
        fail_msg("%s: %.1f in the image, %.1f counted", technique, sum, counted);
    view->part = parts[2];
    count_fetches(view, image, technique, part);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_int_equal(part[i], inside(&parts[2], i % WIDTH, i / WIDTH) ? whole[i] : 0);
    view->part = (nook_rectangle){ 0 };
}

static void test_fetches_of_all_pixels_are_the_sum_that_is_counted(void **state)
{
    nook_fixture_view *view = *state;
    nook_texture image;
    assert_int_equal(nook_texture_create_2d(view->gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &image), NOOK_OK);
    ao_view_param(view, "ao.count", "1");
    ao_view_param(view, "ao.filter", "tile");
    for (size_t t = 0; t + 1 < NOOK_COUNT(techniques); t++) { /* not the reference, which fetches nothing */
        for (size_t s = 0; s < NOOK_FIXTURE_SCALES; s++) {
            ao_view_param(view, "ao.scale", nook_fixture_scales[s]);
            ao_view_param(view, "ao.upscale", upscales[t % 3]);
            expect_same_fetches(view, image, techniques[t]);
        }
    }
    ao_view_param(view, "ao.count", "0");
    nook_texture_destroy(view->gpu, &image);
}

static void test_texture_of_fetches_of_another_size_is_refused(void **state)
{
    nook_fixture_view *view = *state;
    nook_log_capture log;
    view->fetches = (nook_ao_texture){ 1, WIDTH, HEIGHT + 1 };
    nook_log_capture_begin(&log);
    nook_result result = nook_fixture_view_record(view, "ssao");
    nook_log_capture_end();
    view->fetches = (nook_ao_texture){ 0 };
    assert_int_equal(result, NOOK_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_part_is_bit_for_bit_that_of_the_whole_picture),
        cmocka_unit_test(test_part_without_occluders_is_open_and_nothing_else_changes),
        cmocka_unit_test(test_part_outside_of_the_picture_is_refused),
        cmocka_unit_test(test_same_view_reads_the_host_s_buffers_only_when_their_copies_are_gone),
        cmocka_unit_test(test_fetches_of_all_pixels_are_the_sum_that_is_counted),
        cmocka_unit_test(test_texture_of_fetches_of_another_size_is_refused),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
