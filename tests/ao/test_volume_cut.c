/* How the work of the volume technique is cut into dispatches: what a software driver would end silently must never be one. */
#include "modules/ao_volume/cut_internal.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { TURNS_MAX = 65535 }; /* of all loops of an invocation: llvmpipe */

static const uint32_t many[] = { 1, 2, 7, 16, 17, 64, 300, 1024, 4096, 65536 };
enum { MANY = sizeof many / sizeof *many };

/**
 * Loops over samples with their last, failing test, and over rays; over those that reach the point, with a look at each of all, by each of
 * `lanes` invocations of a vector at others of them; and over their list, 64 at once, and then in words of 32 bits. Union once for each 8
 * rays, and again through the list if it has more than one chunk.
 */
static uint64_t turns(const volume_work *work, const volume_cut *cut, uint32_t met, uint64_t lanes)
{
    uint64_t boxes = met < cut->occluders ? met : cut->occluders, batches = work->multiply ? 1 : (cut->rays + 7) / 8;
    uint64_t chunks = (cut->occluders + 255) / 256, list = cut->occluders / 64 + cut->occluders / 32 + 3 * chunks;
    uint64_t look = boxes + (cut->occluders - boxes) + (lanes - 1) * cut->occluders + chunks;
    return cut->rays * boxes * (work->steps + 1 + 1) + batches * (boxes + look + list);
}

static void check_cut(const volume_work *work, const volume_cut *cut, uint32_t met, uint64_t lanes)
{
    assert_in_range(cut->rays, 1, work->rays > 64 ? work->rays : 64);
    assert_in_range(cut->occluders, 1, work->occluders);
    if (turns(work, cut, met, lanes) > TURNS_MAX)
        fail_msg("%u rays, %u steps, %u occluders, %s: %u rays of %u occluders take %llu turns", work->rays,
                 work->steps, work->occluders, work->multiply ? "product" : "union", cut->rays, cut->occluders,
                 (unsigned long long)turns(work, cut, met, lanes));
    if (work->multiply && cut->rays < work->rays)
        assert_int_equal(cut->occluders, 1); /* one sum waits for the next part */
    if (!work->multiply && cut->occluders < work->occluders)
        assert_int_equal(cut->rays, 1); /* one nearest hit waits */
}

static void for_each_work(void (*check)(const volume_work *work))
{
    for (uint32_t i = 0; i < MANY * MANY * MANY * 2; i++) {
        const volume_work work = { many[i / 2 % MANY], many[i / 2 / MANY % MANY], many[i / 2 / MANY / MANY], i % 2, 0 };
        if (work.rays <= 4096 && work.steps <= 1024)
            check(&work);
    }
}

static void check_careful(const volume_work *work)
{
    volume_cut cut = volume_cut_careful(work);
    assert_true(cut.sure);
    check_cut(work, &cut, work->occluders, 8);
}

static void check_likely(const volume_work *work)
{
    volume_cut cut = volume_cut_likely(work);
    if (cut.sure)
        check_cut(work, &cut, work->occluders, 8);
    else if (work->occluders <= 4096) /* of more, missing alone may be too much for a ray: then it is done again */
        check_cut(work, &cut, 16, 1);
}

static void check_common(const volume_work *work)
{
    if (work->occluders <= 16)
        assert_true(volume_cut_likely(work).sure);
}

static void test_careful_cuts_hold_whatever_meets_what(void **state)
{
    (void)state;
    for_each_work(check_careful);
}

static void test_likely_cuts_hold_when_a_ray_meets_sixteen_boxes(void **state)
{
    (void)state;
    for_each_work(check_likely);
}

static void test_a_few_occluders_are_never_done_again(void **state)
{
    (void)state;
    for_each_work(check_common);
}

static void test_what_no_tile_tests_takes_no_room_in_a_dispatch(void **state)
{
    (void)state;
    for (uint32_t multiply = 0; multiply < 2; multiply++) {
        volume_work work = { .rays = 8, .steps = 96, .occluders = 4096, .multiply = multiply };
        volume_cut piled = volume_cut_likely(&work);
        assert_true(piled.rays < 8 || piled.occluders < 4096);
        work.tested = 128;
        volume_cut apart = volume_cut_likely(&work);
        assert_in_range(apart.rays, 8, 64);
        assert_int_equal(apart.occluders, 4096);
    }
}

static void test_only_cuts_of_a_ray_or_of_an_occluder_keep_an_image(void **state)
{
    (void)state;
    volume_work work = { .rays = 8, .steps = 96, .occluders = 300 };
    volume_cut cut = volume_cut_careful(&work);
    assert_false(volume_cut_needs_image(&work, &cut)); /* 300 x 100 turns a ray */
    work.occluders = 4096;
    cut = volume_cut_careful(&work);
    assert_true(volume_cut_needs_image(&work, &cut));
    work = (volume_work){ .rays = 64, .steps = 96, .occluders = 4096, .multiply = true };
    cut = volume_cut_careful(&work);
    assert_false(volume_cut_needs_image(&work, &cut));
    work.rays = 4096;
    cut = volume_cut_careful(&work);
    assert_true(volume_cut_needs_image(&work, &cut));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_careful_cuts_hold_whatever_meets_what),
        cmocka_unit_test(test_likely_cuts_hold_when_a_ray_meets_sixteen_boxes),
        cmocka_unit_test(test_a_few_occluders_are_never_done_again),
        cmocka_unit_test(test_what_no_tile_tests_takes_no_room_in_a_dispatch),
        cmocka_unit_test(test_only_cuts_of_a_ray_or_of_an_occluder_keep_an_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
