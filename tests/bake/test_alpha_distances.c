/* Distances to what is not opaque: in each voxel a triangle is there where its alpha is at least a half in the mean of what lies in it. */
#include "tests/support/surfel_shapes.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 16, TEXELS = 4 };
static const double step = 1.0 / NOOK_DISTANCES_PER_VOXEL, height = 8.5;
static const double layer_end = 0.002; /* voxels end up to 1/1000 below their faces */

/* A square across z over all of the grid, of voxels of 1 m; u is `first` to `first` + `repeat` along x. */
typedef struct square {
    test_sheet sheet;
    float uvs[6][2];
    uint8_t texels[TEXELS];
    nook_alpha_part part;
    nook_alphas alphas;
} square;

/* @param bars  of the four texels along x those that are there, as bits */
static square *make_square(uint32_t bars, double first, double repeat)
{
    square *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->sheet = test_make_sheet(SIDE, (const float[]){ 0, 0, (float)height }, (const float[]){ SIDE, 0, 0 },
                               (const float[]){ 0, SIDE, 0 });
    for (int i = 0; i < TEXELS; i++)
        s->texels[i] = bars >> i & 1 ? 128 : 127;
    for (int k = 0; k < 4; k++)
        s->uvs[k][0] = (float)(first + (k & 1 ? repeat : 0.0));
    s->part = test_mask(0, 6, s->texels, TEXELS);
    s->part.height = 1;
    s->alphas = (nook_alphas){ &s->part, 1, s->uvs[0] };
    return s;
}

static nook_volume make(const square *s, const nook_alphas *alphas, uint32_t threads)
{
    nook_volume volume;
    const nook_triangles triangles = test_sheet_triangles(&s->sheet);
    const nook_voxelize_desc desc = {
        .resolution = SIDE, .threads = threads, .kind = NOOK_VOLUME_DISTANCE, .alphas = alphas
    };
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    return volume;
}

/* The same grid with the whole square, and without it. */
static nook_volume make_whole(void)
{
    square *s = make_square(0, 0.0, 1.0);
    nook_volume v = make(s, NULL, 1);
    free(s);
    return v;
}

static nook_volume make_none(void)
{
    square *s = make_square(0, 0.0, 1.0);
    for (int i = 1; i < 6; i++)
        s->sheet.indices[i] = s->sheet.indices[6]; /* a point of what holds the grid */
    s->sheet.indices[0] = s->sheet.indices[6];
    nook_volume v = make(s, NULL, 1);
    free(s);
    return v;
}

static bool same_distances(const nook_volume *a, const nook_volume *b)
{
    assert_true(a->info.width == b->info.width && a->info.height == b->info.height && a->info.depth == b->info.depth);
    return a->info.occupied == b->info.occupied &&
           memcmp(a->voxels, b->voxels, (size_t)a->info.width * a->info.height * a->info.depth) == 0;
}

/* Makes it, compares it, frees it. */
static bool is_like(const square *s, const nook_volume *expected)
{
    nook_volume v = make(s, &s->alphas, 1);
    bool same = same_distances(&v, expected);
    nook_volume_free(&v);
    return same;
}

/* Periods of a voxel, of parts of one, and of so little that blocks of texels are looked at. */
static void test_a_grating_finer_than_a_voxel_is_a_wall_or_nothing(void **state)
{
    (void)state;
    static const double repeats[] = { 16, 40, 333, 5000 };
    nook_volume whole = make_whole(), none = make_none();
    assert_false(same_distances(&whole, &none));
    for (size_t i = 0; i < sizeof repeats / sizeof *repeats; i++) {
        square *three_quarters = make_square(7, 0.0, repeats[i]), *quarter = make_square(2, 0.0, repeats[i]);
        assert_true(is_like(three_quarters, &whole));
        assert_true(is_like(quarter, &none));
        free(three_quarters);
        free(quarter);
    }
    nook_volume_free(&whole);
    nook_volume_free(&none);
}

/* Metres from x to the nearest bar; bars are half of a period of `wide` metres, the first from `from` on, within the square. */
static double to_bars(double x, double from, double wide)
{
    double nearest = INFINITY;
    for (double low = from - 2.0 * wide; low < SIDE; low += wide) {
        const double first = fmax(low, 0.0), end = fmin(low + wide / 2.0, SIDE);
        if (end > first)
            nearest = fmin(nearest, fmax(fmax(first - x, x - end), 0.0));
    }
    return nearest;
}

/* The largest error and the mean one, in voxels, against distances to the bars, where those that the square cuts off are not the nearest. */
static void compare_to_bars(const nook_volume *v, double from, double wide, double *out_largest, double *out_mean)
{
    double sum = 0.0, count = 0.0;
    *out_largest = 0.0;
    for (uint32_t z = 0; z < v->info.depth; z++)
        for (uint32_t y = 1; y <= SIDE; y++)
            for (uint32_t x = SIDE / 4; x < 3 * SIDE / 4; x++) {
                const double p[3] = { x - 0.5, y - 0.5, z - 0.5 }, across = to_bars(p[0], from, wide);
                const double speck = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
                const double other = sqrt(pow(SIDE - p[0], 2) + pow(SIDE - p[1], 2) + pow(SIDE - p[2], 2));
                const double distance = fmin(hypot(across, p[2] - height), fmin(speck, other));
                const double stored = v->voxels[((size_t)z * v->info.height + y) * v->info.width + x] * step;
                if (distance > 7.0)
                    continue; /* all ends at 7.97 */
                const double error = stored + step / 2.0 - distance;
                *out_largest = fmax(*out_largest, fabs(error));
                sum += error;
                count++;
            }
    *out_mean = sum / count;
}

/* As they are stored rounded down, within half a step of its middle. */
static void test_bars_that_end_with_voxels_have_distances_of_their_own(void **state)
{
    (void)state;
    double largest, mean;
    square *s = make_square(3, 0.0, 2.0);
    nook_volume v = make(s, &s->alphas, 1), others = make(s, &s->alphas, 5);
    compare_to_bars(&v, 0.0, 8.0, &largest, &mean);
    assert_true(largest < step / 2.0 + layer_end);
    assert_true(same_distances(&v, &others));
    nook_volume_free(&v);
    nook_volume_free(&others);
    free(s);
}

/* Ends within voxels are moved to the nearer face, so that errors are half a voxel at the most, either way. */
static void test_bars_that_end_anywhere_are_right_to_half_a_voxel(void **state)
{
    (void)state;
    static const double wides[] = { 5.3, 6.7, 9.1 };
    for (int i = 0; i < 3; i++)
        for (double from = 0.0; from < 1.0; from += 0.17) {
            double largest, mean;
            square *s = make_square(3, -from / wides[i], SIDE / wides[i]);
            nook_volume v = make(s, &s->alphas, 1);
            compare_to_bars(&v, from, wides[i], &largest, &mean);
            assert_true(largest < 0.5 + step / 2.0 + layer_end);
            assert_true(fabs(mean) < 0.1);
            nook_volume_free(&v);
            free(s);
        }
}

/* Fields of 4 m: across x and y alike, as the square's diagonal is. */
static void test_fields_are_told_apart_along_both_sides(void **state)
{
    (void)state;
    square *s = make_square(3, 0.0, 2.0), *turned = make_square(3, 0.0, 2.0);
    for (int k = 0; k < 4; k++) {
        turned->uvs[k][0] = 0.0f;
        turned->uvs[k][1] = k & 2 ? 2.0f : 0.0f;
    }
    turned->part.width = 1;
    turned->part.height = TEXELS;
    nook_volume along_x = make(s, &s->alphas, 1), along_y = make(turned, &turned->alphas, 1);
    assert_false(same_distances(&along_x, &along_y));
    for (uint32_t z = 0; z < along_x.info.depth; z++)
        for (uint32_t y = 0; y < along_x.info.height; y++)
            for (uint32_t x = 0; x < along_x.info.width; x++) {
                const size_t row = (size_t)z * along_x.info.height;
                assert_true(abs(along_x.voxels[(row + y) * along_x.info.width + x] -
                                along_y.voxels[(row + x) * along_y.info.width + y]) <= 1);
            }
    nook_volume_free(&along_x);
    nook_volume_free(&along_y);
    free(s);
    free(turned);
}

static void test_a_pane_is_there_from_an_alpha_of_a_half_on(void **state)
{
    (void)state;
    nook_volume whole = make_whole(), none = make_none();
    static const struct {
        float alpha;
        bool there;
    } panes[] = { { 1.0f, true }, { 0.6f, true }, { 0.5f, true }, { 0.49f, false }, { 0.0f, false } };
    for (size_t i = 0; i < sizeof panes / sizeof *panes; i++)
        for (int textured = 0; textured < 2; textured++) {
            square *s = make_square(15, 0.0, 1.0);
            s->part.masked = false;
            s->part.alpha = panes[i].alpha;
            memset(s->texels, 255, sizeof s->texels);
            s->part.texels = textured ? s->texels : NULL;
            assert_true(is_like(s, panes[i].there ? &whole : &none));
            free(s);
        }
    nook_volume_free(&whole);
    nook_volume_free(&none);
}

/* As the rays of the reference see it: engine/core/alpha.h. */
static void test_a_texture_without_a_place_leaves_all(void **state)
{
    (void)state;
    nook_volume whole = make_whole();
    square *s = make_square(0, (double)NAN, 1.0);
    assert_true(is_like(s, &whole));
    nook_volume_free(&whole);
    free(s);
}

/* A segment on the first or on the last two of the texels. */
static void test_what_has_no_area_is_there_by_its_middle(void **state)
{
    (void)state;
    square *s = make_square(3, 0.0, 1.0);
    for (int i = 0; i < 6; i++)
        s->sheet.indices[i] = i % 3 == 0 ? 0 : 3;
    nook_volume whole = make(s, NULL, 1), none = make_none();
    assert_false(same_distances(&whole, &none));
    for (int k = 0; k < 4; k++)
        s->uvs[k][0] = k == 0 ? 0.0f : 0.6f; /* 0.4 in the middle */
    assert_true(is_like(s, &whole));
    for (int k = 0; k < 4; k++)
        s->uvs[k][0] = k == 0 ? 0.0f : 0.9f;
    assert_true(is_like(s, &none));
    nook_volume_free(&whole);
    nook_volume_free(&none);
    free(s);
}

static void test_masks_enter_the_hash_and_their_absence_does_not(void **state)
{
    (void)state;
    square *s = make_square(3, 0.0, 1.0);
    const nook_triangles triangles = test_sheet_triangles(&s->sheet);
    nook_voxelize_desc desc = { .resolution = SIDE, .kind = NOOK_VOLUME_DISTANCE };
    const nook_alphas opaque = { NULL, 0, NULL };
    uint64_t plain = nook_voxelize_hash(&triangles, &desc);
    desc.alphas = &opaque;
    assert_true(nook_voxelize_hash(&triangles, &desc) == plain);
    desc.alphas = &s->alphas;
    uint64_t masked = nook_voxelize_hash(&triangles, &desc);
    assert_true(masked != plain);
    s->texels[3] = 255;
    assert_true(nook_voxelize_hash(&triangles, &desc) != masked);
    free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_grating_finer_than_a_voxel_is_a_wall_or_nothing),
        cmocka_unit_test(test_bars_that_end_with_voxels_have_distances_of_their_own),
        cmocka_unit_test(test_bars_that_end_anywhere_are_right_to_half_a_voxel),
        cmocka_unit_test(test_fields_are_told_apart_along_both_sides),
        cmocka_unit_test(test_a_pane_is_there_from_an_alpha_of_a_half_on),
        cmocka_unit_test(test_a_texture_without_a_place_leaves_all),
        cmocka_unit_test(test_what_has_no_area_is_there_by_its_middle),
        cmocka_unit_test(test_masks_enter_the_hash_and_their_absence_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
