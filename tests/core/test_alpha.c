/* What of a list of triangles is not opaque: which part, which texel, what is refused. */
#include "engine/core/alpha.h"
#include <math.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const uint8_t texels[] = { 10, 20, 30, 40, 50, 60 }; /* 3 x 2 */
static const nook_alpha_part textured = {
    .index_count = 3, .alpha = 1, .texels = texels, .width = 3, .height = 2, .texel_size = 1
};

static double alpha_at(const nook_alpha_part *part, float u, float v)
{
    const float uvs[3][2] = { { u, v }, { 9, 9 }, { 9, 9 } };
    const nook_alphas alphas = { part, 1, uvs[0] };
    return nook_alpha_at(&alphas, part, (const uint32_t[]){ 0, 1, 2 }, (const double[]){ 1, 0, 0 });
}

static void test_the_nearest_texel_counts_and_textures_repeat(void **state)
{
    (void)state;
    for (int turn = -2; turn <= 2; turn++)
        for (int y = 0; y < 2; y++)
            for (int x = 0; x < 3; x++) {
                float u = ((float)x + 0.5f) / 3.0f + (float)turn, v = ((float)y + 0.5f) / 2.0f + (float)turn;
                assert_true(alpha_at(&textured, u, v) == texels[y * 3 + x] / 255.0);
            }
    assert_true(alpha_at(&textured, NAN, 0) == 1.0);
}

static void test_masks_are_there_from_their_cutoff_on(void **state)
{
    (void)state;
    nook_alpha_part mask = textured;
    mask.masked = true;
    mask.cutoff = 0.1f;
    assert_true(alpha_at(&mask, 0.5f, 0.25f) == 0.0); /* 20 */
    assert_true(alpha_at(&mask, 0.9f, 0.25f) == 1.0); /* 30 */
    mask.alpha = 0.5f;
    assert_true(alpha_at(&mask, 0.9f, 0.25f) == 0.0); /* 15 */
    assert_true(alpha_at(&mask, 0.9f, 0.75f) == 1.0); /* 60 / 2 */
    mask.texels = NULL;
    assert_true(alpha_at(&mask, 0, 0) == 1.0);
}

static void test_colours_have_their_alpha_last(void **state)
{
    (void)state;
    const uint8_t colours[] = { 1, 2, 3, 51, 4, 5, 6, 102 };
    const nook_alpha_part part = { .index_count = 3, .alpha = 1, .texels = colours, .width = 2, .height = 1 };
    assert_int_equal(nook_alpha_texel(&part, 0, 0), 51);
    assert_int_equal(nook_alpha_texel(&part, 1, 0), 102);
}

static void test_the_most_of_a_part_is_that_of_its_densest_texel(void **state)
{
    (void)state;
    const uint8_t densities[] = { 0, 51, 204, 102 };
    nook_alpha_part part = {
        .index_count = 3, .alpha = 0.5f, .texels = densities, .width = 2, .height = 2, .texel_size = 1
    };
    assert_true(fabs(nook_alpha_most(&part) - 0.4) < 1e-6);
    part.masked = true;
    part.cutoff = 0.41f;
    assert_true(nook_alpha_most(&part) == 0.0);
    part.texels = NULL;
    assert_true(nook_alpha_most(&part) == 1.0);
}

static void test_a_triangle_is_of_the_part_that_holds_it(void **state)
{
    (void)state;
    const nook_alpha_part parts[] = { { .first_index = 3, .index_count = 6 },
                                      { .first_index = 9, .index_count = 0 },
                                      { .first_index = 12, .index_count = 3 } };
    const nook_alphas alphas = { parts, 3, NULL };
    const nook_alpha_part *const part_of[] = { NULL, &parts[0], &parts[0], NULL, &parts[2], NULL };
    for (size_t t = 0; t < 6; t++)
        assert_ptr_equal(nook_alpha_part_of(&alphas, t), part_of[t]);
    assert_null(nook_alpha_part_of(NULL, 0));
}

static void test_parts_must_be_in_order_apart_and_within(void **state)
{
    (void)state;
    const nook_alpha_part first = { .index_count = 3 }, second = { .first_index = 3, .index_count = 3 };
    const nook_alpha_part good[] = { first, second }, back[] = { second, first }, twice[] = { first, first };
    const nook_alpha_part odd = { .first_index = 1, .index_count = 3 }, half = { .index_count = 2 };
    assert_true(nook_alphas_are_sound(NULL, 0));
    assert_true(nook_alphas_are_sound(&(nook_alphas){ good, 2, NULL }, 6));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ good, 2, NULL }, 3));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ back, 2, NULL }, 6));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ twice, 2, NULL }, 6));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ &odd, 1, NULL }, 6));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ &half, 1, NULL }, 6));
    assert_false(nook_alphas_are_sound(&(nook_alphas){ &textured, 1, NULL }, 6)); /* no uvs */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_nearest_texel_counts_and_textures_repeat),
        cmocka_unit_test(test_masks_are_there_from_their_cutoff_on),
        cmocka_unit_test(test_colours_have_their_alpha_last),
        cmocka_unit_test(test_the_most_of_a_part_is_that_of_its_densest_texel),
        cmocka_unit_test(test_a_triangle_is_of_the_part_that_holds_it),
        cmocka_unit_test(test_parts_must_be_in_order_apart_and_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
