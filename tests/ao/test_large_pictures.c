/* Pictures with more tiles, and more pixels to refine, than a dispatch may have groups along one axis. */
#include "modules/ao/ao_internal.h"
#include "tests/support/ao_view.h"
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 2048, HEIGHT = 2400, PIXELS = WIDTH * HEIGHT, GROUPS_MAX = 65535 /* that every device takes */ };

static uint32_t hash(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/** Depths of neighbours have nothing to do with each other. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    for (uint32_t i = 0; i < PIXELS; i++)
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 1.0 + (double)(hash(i) >> 8) / 16777216.0,
                                    (const double[]){ 0, 0, 1 });
    *state = view;
    return 0;
}

static float paint_constant(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)x, (void)y;
    return probe->painted;
}

/** What each pixel fetches, in an array of PIXELS. */
static uint32_t *count_fetches(nook_fixture_view *view, const char *refine)
{
    nook_texture image;
    uint32_t *fetches = calloc(PIXELS, sizeof *fetches);
    assert_non_null(fetches);
    ao_view_param(view, "ao.refine", refine);
    assert_int_equal(nook_texture_create_2d(view->gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &image), NOOK_OK);
    nook_texture_write(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, fetches, PIXELS * sizeof *fetches);
    view->fetches = (nook_ao_texture){ image.id, WIDTH, HEIGHT };
    ao_view_record(view, "probe");
    nook_texture_read(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, fetches, PIXELS * sizeof *fetches);
    view->fetches = (nook_ao_texture){ 0 };
    nook_texture_destroy(view->gpu, &image);
    return fetches;
}

/** Candidates fetch as many texels more as one another, and the other pixels none. */
static void expect_refined_once(nook_fixture_view *view, uint32_t candidates)
{
    uint32_t *without = count_fetches(view, "off"), *with = count_fetches(view, "around"), more = 0, found = 0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (with[i] == without[i])
            continue;
        more = more ? more : with[i] - without[i];
        assert_int_equal(with[i] - without[i], more);
        found++;
    }
    assert_int_equal(found, candidates);
    free(without);
    free(with);
}

static void test_each_of_very_many_candidates_is_refined(void **state)
{
    nook_fixture_view *view = *state;
    uint32_t head[4]; /* groups and count */
    ao_view_param(view, "ao.scale", "quarter");
    ao_view_param(view, "ao.upscale", "bilinear");
    ao_view_param(view, "ao.refine", "around");
    ao_view_param(view, "ao.refine_reach", "1");
    ao_view_param(view, "ao.refine_weight", "1");
    ao_view_probe(view)->paint = paint_constant;
    ao_view_probe(view)->painted = 0.7123456f;
    ao_view_record(view, "probe");
    nook_buffer_read(view->gpu, view->ao->refine.candidates, 0, head, sizeof head);
    assert_in_range(head[3], GROUPS_MAX * 64 + 1, PIXELS);
    assert_int_equal(head[0], GROUPS_MAX);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_true(view->visibility[i] == 0.7123456f);
    expect_refined_once(view, head[3]);
    ao_view_probe(view)->paint = NULL;
    ao_view_param(view, "ao.refine", "off");
}

static void test_each_of_very_many_tiles_is_traced(void **state)
{
    nook_fixture_view *view = *state;
    nook_fixture_mesh box = { 0 };
    nook_ao_statistics statistics;
    uint32_t head[3], dark = 0; /* groups */
    nook_fixture_add_box(&box, (const double[]){ -0.4, -0.4, -1.6 }, (const double[]){ 0.4, 0.4, -1.2 }, 63);
    ao_view_add(view, &box, 8);
    nook_fixture_mesh_free(&box);
    ao_view_param(view, "ao.scale", "full");
    ao_view_param(view, "ao.filter", "none");
    ao_view_param(view, "ao.r_max", "0.2");
    ao_view_param(view, "ao.reuse", "2");
    ao_view_param(view, "volume.rays", "1");
    ao_view_record(view, "volume");
    nook_ao_get_statistics(view->ao, &statistics);
    assert_int_equal(statistics.traced, PIXELS);
    nook_buffer_read(view->gpu, view->ao->reuse.tiles, 0, head, sizeof head);
    assert_int_equal(head[0], GROUPS_MAX);
    assert_int_equal(head[1], 2);
    float *listed = malloc(PIXELS * sizeof *listed);
    assert_non_null(listed);
    memcpy(listed, view->visibility, PIXELS * sizeof *listed);
    ao_view_param(view, "ao.reuse", "1");
    ao_view_record(view, "volume");
    assert_memory_equal(listed, view->visibility, PIXELS * sizeof *listed);
    for (uint32_t i = 0; i < PIXELS; i++)
        dark += listed[i] < 0.5f;
    assert_true(dark > 1000);
    free(listed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_of_very_many_candidates_is_refined),
        cmocka_unit_test(test_each_of_very_many_tiles_is_traced),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
