/* Bins of the picture: they leave out only what cannot change a pixel, so that a picture has the same bits with them and without. */
#include "modules/ao/ao_internal.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* No multiple of a tile, of a bin nor of the trace's scales. */
enum { WIDTH = 141, HEIGHT = 99, PIXELS = WIDTH * HEIGHT, MANY = 300, PILED = 90 };

static const char *const kinds[] = { "binary", "density", "surfel", "distance" };

static double next_random(uint32_t *seed, double low, double high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) / 16777216.0;
}

/** Turned, stretched, one in four mirrored; some behind the camera, which stands among them. */
static nook_matrix random_place(uint32_t *seed)
{
    const double at[3] = { next_random(seed, -2, 2), next_random(seed, -2, 2), next_random(seed, -0.1, 0.9) };
    const double turn = next_random(seed, 0, 6), size = next_random(seed, 0.3, 1.5);
    const double rotation[4] = { 0.6 * sin(0.5 * turn), 0, 0.8 * sin(0.5 * turn), cos(0.5 * turn) };
    const double scale[3] = { next_random(seed, 0, 1) < 0.25 ? -size : size, size, size * next_random(seed, 0.6, 1.6) };
    return nook_matrix_compose(at, rotation, scale);
}

/** Small boxes scattered over a floor, and more of them in one place than a chunk of a tile's list has entries when all are taken. */
static int setup(void **state)
{
    nook_fixture_view *view = ao_view_create(WIDTH, HEIGHT);
    const nook_fixture_projection projection = { .fov_y_radians = 1.1, .aspect = 1.4, .z_near = 0.01 };
    nook_fixture_mesh floor = { 0 }, box = { 0 };
    uint32_t seed = 7;
    view->view_from_world =
        nook_matrix_look_at((double[]){ -0.7, -1.1, 0.8 }, (double[]){ 0.4, 0.5, 0 }, (double[]){ 0, 0, 1 });
    view->clip_from_view = nook_fixture_projection_matrix(&projection);
    nook_fixture_view_clear(view);
    nook_fixture_add_quad(&floor, (double[]){ -2, -2, 0 }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    nook_fixture_add_box(&box, (double[]){ -0.1, -0.07, -0.08 }, (double[]){ 0.1, 0.07, 0.08 }, 63);
    ao_view_draw(view, &floor);
    ao_view_add(view, &box, 12);
    for (int i = 1; i < MANY; i++) {
        nook_matrix place = random_place(&seed);
        if (i >= MANY - PILED)
            place = nook_matrix_translation(0.4 + 0.0001 * i, 0.5, 0.1);
        assert_int_equal(nook_fixture_view_add_instance(view, 0, &place), NOOK_OK);
    }
    nook_fixture_mesh_free(&floor);
    nook_fixture_mesh_free(&box);
    ao_view_param(view, "volume.rays", "11"); /* more than one batch */
    ao_view_param(view, "volume.steps", "24");
    ao_view_param(view, "ao.r_max", "0.2");
    ao_view_param(view, "ao.falloff", "linear");
    ao_view_param(view, "ao.filter", "none");
    *state = view;
    return 0;
}

static void record(nook_fixture_view *view, uint32_t least, uint32_t items, float out[PIXELS])
{
    view->ao->bins.least = least;
    view->ao->bins.item_max = items;
    ao_view_record(view, "volume");
    assert_int_equal(view->outside, 0);
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

static uint32_t count_bins_of_all(const ao_bins *bins)
{
    uint32_t found = 0;
    for (uint32_t bin = 0; bin < bins->across * bins->down; bin++)
        found += bins->words[2 * bin + 1] == AO_BIN_OF_ALL;
    return found;
}

static void expect_equal(const float *found, const float *wanted, const char *what)
{
    for (size_t i = 0; i < PIXELS; i++)
        if (memcmp(&found[i], &wanted[i], sizeof *found) != 0)
            fail_msg("%s: pixel %zu, %zu is %.9g with bins, %.9g without", what, i % WIDTH, i / WIDTH, (double)found[i],
                     (double)wanted[i]);
}

/** With room for all lists, for some of them, and for none: bins that find no room test all. */
static void compare(nook_fixture_view *view, const char *what)
{
    static float wanted[PIXELS], found[PIXELS];
    const ao_bins *bins = &view->ao->bins;
    const uint32_t items = bins->item_max;
    uint32_t dark = 0;
    record(view, UINT32_MAX, items, wanted);
    assert_int_equal(bins->across, 0);
    for (size_t i = 0; i < PIXELS; i++)
        dark += wanted[i] < 0.9f;
    assert_true(dark > PIXELS / 50);
    record(view, AO_BINS_LEAST, items, found);
    assert_true(count_bins_of_all(bins) < bins->across * bins->down / 2);
    expect_equal(found, wanted, what);
    assert_true(bins->entries > 200);
    record(view, AO_BINS_LEAST, (uint32_t)bins->entries / 2 + 1, found);
    assert_in_range(count_bins_of_all(bins), 1, bins->across * bins->down - 1);
    expect_equal(found, wanted, what);
    record(view, AO_BINS_LEAST, 0, found);
    assert_int_equal(bins->across, 0);
    expect_equal(found, wanted, what);
    view->ao->bins.item_max = items;
}

static void test_a_picture_has_the_same_bits_with_bins_and_without(void **state)
{
    nook_fixture_view *view = *state;
    static const char *const ways[] = { "union", "multiply" };
    char what[64];
    for (size_t i = 0; i < NOOK_COUNT(kinds) * NOOK_COUNT(ways); i++) {
        ao_view_param(view, "volume.kind", kinds[i / 2]);
        ao_view_param(view, "volume.combine", ways[i % 2]);
        snprintf(what, sizeof what, "%s, %s", kinds[i / 2], ways[i % 2]);
        compare(view, what);
    }
}

static void test_scales_reuse_parts_and_corners_have_the_same_bits_too(void **state)
{
    nook_fixture_view *view = *state;
    ao_view_param(view, "volume.kind", "binary");
    ao_view_param(view, "volume.combine", "union");
    static float wanted[PIXELS], found[PIXELS];
    const uint32_t items = view->ao->bins.item_max;
    for (int scale = 1; scale < NOOK_FIXTURE_SCALES; scale++) {
        ao_view_param(view, "ao.scale", nook_fixture_scales[scale]);
        record(view, UINT32_MAX, items, wanted);
        record(view, AO_BINS_LEAST, items, found);
        expect_equal(found, wanted, nook_fixture_scales[scale]);
    }
    ao_view_param(view, "ao.scale", "full");
    record(view, UINT32_MAX, items, wanted);
    ao_view_param(view, "ao.reuse",
                  "4"); /* with nothing to take over yet every tile is on the list of those to trace */
    record(view, AO_BINS_LEAST, items, found);
    expect_equal(found, wanted, "reuse");
    ao_view_param(view, "ao.reuse", "1");
    view->part = (nook_rectangle){ 37, 21, 70, 60 };
    compare(view, "part");
    view->part = (nook_rectangle){ 0 };
    ao_view_param(view, "volume.sampling", "corners");
    compare(view, "corners");
    ao_view_param(view, "volume.sampling", "filter");
}

static void test_few_occluders_have_no_bins(void **state)
{
    nook_fixture_view *view = *state;
    const uint32_t all = view->occluder_count;
    for (uint32_t count = 63; count <= 66; count++) {
        view->occluder_count = count;
        ao_view_record(view, "volume");
        assert_int_equal(view->ao->bins.across > 0, count > 64);
    }
    view->occluder_count = all;
}

static void test_boxes_that_are_drawn_have_no_bins(void **state)
{
    nook_fixture_view *view = *state;
    const uint32_t least = view->ao->bins.least;
    view->ao->bins.least = 1;
    ao_view_param(view, "volume.path", "raster");
    ao_view_record(view, "volume");
    assert_int_equal(view->ao->bins.across, 0);
    assert_int_equal(view->ao->bins.longest, MANY);
    ao_view_param(view, "volume.path", "compute");
    ao_view_record(view, "volume");
    assert_true(view->ao->bins.across > 0);
    ao_view_record(view, "ssao");
    assert_int_equal(view->ao->bins.across, 0);
    view->ao->bins.least = least;
}

/** Each of them may be seen in every bin: lists would take occluders times bins. */
static void test_occluders_all_around_the_eye_have_no_bins_and_the_same_picture(void **state)
{
    nook_fixture_view *view = *state;
    static float wanted[PIXELS], found[PIXELS];
    const ao_bins *bins = &view->ao->bins;
    const uint32_t items = bins->item_max;
    assert_int_equal(view->occluder_count, MANY);
    ao_view_param(view, "ao.r_max", "6"); /* reaches the eye from everywhere */
    record(view, UINT32_MAX, items, wanted);
    record(view, AO_BINS_LEAST, MANY * AO_BIN_ITEMS / 2, found);
    assert_true(bins->entries > (uint64_t)MANY * 16);
    assert_int_equal(bins->across, 0);
    assert_int_equal(bins->longest, MANY);
    expect_equal(found, wanted, "around the eye");
    record(view, AO_BINS_LEAST, items, found); /* the room of a default context has all of them */
    assert_true(bins->across > 0);
    expect_equal(found, wanted, "around the eye, with room");
    ao_view_param(view, "ao.r_max", "0.2");
    view->ao->bins.item_max = items;
}

/* ---- the lists themselves ---------------------------------------------------------------------------------------- */

enum { BALLS = 200, POINTS = 4000 };

static ao_gpu_occluder random_ball(uint32_t *seed)
{
    ao_gpu_occluder o = { .size = { 8, 8, 8, 0 } };
    const double size = pow(10.0, next_random(seed, -3, 1)), ahead = pow(10.0, next_random(seed, -2, 2));
    for (int axis = 0; axis < 3; axis++)
        o.normal_from_view[axis][axis] = (float)(size / 8);
    o.centre[0] = (float)(next_random(seed, -1.5, 1.5) * ahead);
    o.centre[1] = (float)(next_random(seed, -1.5, 1.5) * ahead);
    o.centre[2] = (float)(next_random(seed, 0, 1) < 0.2 ? ahead : -ahead);
    o.centre[3] = (float)(0.5 * sqrt(3.0) * size);
    return o;
}

static bool lists(const ao_bins *bins, uint32_t bin, uint32_t occluder)
{
    const uint32_t *head = &bins->words[2 * bin];
    for (uint32_t i = 0; head[1] != AO_BIN_OF_ALL && i < head[1]; i++)
        if (bins->words[head[0] + i] == occluder)
            return true;
    return head[1] == AO_BIN_OF_ALL;
}

/** As high over it a ray of a point starts at the most, voxels: sqrt(3)/2 + 1 - threshold, of which the least is 0.01; and FILTER_PRECISION. */
static const double SLAB = 0.8661 + 0.99 + 0.015;

/** Every occluder in reach of a point, or of a ray's start over it, is listed where the point is seen. @return how many were in reach */
static uint32_t check_point(const ao_bins *bins, const ao_bin_view *view, const ao_gpu_occluder *balls, uint32_t *seed)
{
    double point[3], depth = pow(10.0, next_random(seed, -2, 2));
    uint32_t bin[2], reached = 0;
    for (int axis = 0; axis < 2; axis++) {
        uint32_t pixel = (uint32_t)next_random(seed, 0, view->size[axis]);
        double full = fmin(pixel * view->scale + view->scale / 2, view->full_size[axis] - 1);
        double ndc = (full + 0.5) / view->full_size[axis] * 2.0 - 1.0;
        point[axis] = (ndc * view->ray_scale[axis] + view->ray_offset[axis]) * depth;
        bin[axis] = pixel / AO_BIN_SIZE;
    }
    point[2] = -depth;
    for (uint32_t i = 0; i < BALLS; i++) {
        const float *c = balls[i].centre;
        double apart = hypot(hypot(point[0] - (double)c[0], point[1] - (double)c[1]), point[2] - (double)c[2]);
        if (apart > (double)c[3] + view->r_max + SLAB * (double)balls[i].normal_from_view[0][0])
            continue;
        reached++;
        if (!lists(bins, bin[1] * bins->across + bin[0], i))
            fail_msg("a ball of %g m at %g, %g, %g is not listed in bin %u, %u, where %g, %g, %g is seen", (double)c[3],
                     (double)c[0], (double)c[1], (double)c[2], bin[0], bin[1], point[0], point[1], point[2]);
    }
    return reached;
}

static void test_what_reaches_a_point_is_listed_where_the_point_is_seen(void **state)
{
    nook_fixture_view *view = *state;
    static ao_gpu_occluder balls[BALLS];
    uint32_t seed = 3, reached = 0, made = 0, listed = 0;
    ao_bins bins;
    assert_int_equal(ao_bins_create(view->gpu, BALLS, &bins), NOOK_OK);
    bins.item_max = BALLS * 13 * 8; /* room for the largest balls everywhere: made with the first picture's bins */
    for (int round = 0; round < 16; round++) {
        const uint32_t scale = 1u << round % 3;
        const ao_bin_view of = { .size = { nook_groups(401, scale), nook_groups(255, scale) },
                                 .full_size = { 401, 255 },
                                 .scale = scale,
                                 .ray_scale = { 0.9, round & 4 ? -0.5 : 0.5 },
                                 .ray_offset = { round & 8 ? 0.3 : 0.0, -0.1 },
                                 .r_max = next_random(&seed, 0, 0.3) };
        for (uint32_t i = 0; i < BALLS; i++)
            balls[i] = random_ball(&seed);
        assert_int_equal(ao_bins_fill(view->gpu, &bins, &of, balls, BALLS), NOOK_OK);
        assert_int_equal(bins.across, nook_groups(of.size[0], AO_BIN_SIZE));
        made += bins.across * bins.down;
        listed += bins.across * bins.down - count_bins_of_all(&bins);
        for (int point = 0; point < POINTS; point++)
            reached += check_point(&bins, &of, balls, &seed);
    }
    assert_true(reached > 1000);
    assert_true(listed > made / 2);
    ao_bins_release(view->gpu, &bins);
}

static void test_lists_ascend_and_leave_out_what_is_elsewhere_or_behind(void **state)
{
    nook_fixture_view *view = *state;
    static ao_gpu_occluder balls[BALLS];
    const ao_bin_view of = { { 320, 320 }, { 320, 320 }, 1, { 1, 1 }, { 0, 0 }, 0.05 };
    uint32_t entries = 0;
    ao_bins bins;
    assert_int_equal(ao_bins_create(view->gpu, BALLS, &bins), NOOK_OK);
    for (uint32_t i = 0; i < BALLS; i++) { /* a ring of 20 in each of ten columns; odd ones behind the camera */
        balls[i] = (ao_gpu_occluder){ .size = { 8, 8, 8, 0 }, .centre = { 0, 0, i & 1 ? 10.0f : -10.0f, 0.1f } };
        balls[i].centre[0] = (float)(i % 10) * 2.0f - 9.0f;
        balls[i].centre[1] = (float)(i / 20) * 2.0f - 9.0f;
    }
    assert_int_equal(ao_bins_fill(view->gpu, &bins, &of, balls, BALLS), NOOK_OK);
    for (uint32_t bin = 0; bin < 100; bin++) {
        const uint32_t *head = bins.words + (size_t)2 * bin;
        assert_in_range(head[1], 0, 2);
        entries += head[1];
        for (uint32_t i = 0; i < head[1]; i++) {
            const uint32_t *item = bins.words + head[0] + i;
            assert_int_equal(*item & 1, 0);
            assert_int_equal(*item % 10, bin % 10);
            assert_int_equal(*item / 20, bin / 10);
            assert_true(i == 0 || item[0] > item[-1]);
        }
    }
    assert_int_equal(entries, BALLS / 2);
    ao_bins_release(view->gpu, &bins);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_picture_has_the_same_bits_with_bins_and_without),
        cmocka_unit_test(test_scales_reuse_parts_and_corners_have_the_same_bits_too),
        cmocka_unit_test(test_few_occluders_have_no_bins),
        cmocka_unit_test(test_boxes_that_are_drawn_have_no_bins),
        cmocka_unit_test(test_occluders_all_around_the_eye_have_no_bins_and_the_same_picture),
        cmocka_unit_test(test_what_reaches_a_point_is_listed_where_the_point_is_seen),
        cmocka_unit_test(test_lists_ascend_and_leave_out_what_is_elsewhere_or_behind),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
