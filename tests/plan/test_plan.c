/* The planner's rules, on scenes of numbers. */
#include "modules/plan/plan.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 64 };

/* Cubes over a floor of 20 m in pieces of 1 m, r_max 2 m. Its volumes, occluders and receivers are the tests' to change. */
typedef struct table {
    nook_plan_volume volumes[MOST];
    nook_plan_occluder occluders[MOST];
    nook_plan_receiver receivers[400 + MOST];
    nook_plan_part parts[MOST];
    nook_plan_scene scene;
    nook_plan_params params;
} table;

static nook_plan_box cube(double x, double y, double z, double half)
{
    return (nook_plan_box){ { x - half, y - half, z - half }, { x + half, y + half, z + half } };
}

static void set_up(table *t)
{
    memset(t, 0, sizeof *t);
    t->params = nook_plan_params_initial();
    t->params.mode = NOOK_PLAN_ON;
    t->scene = (nook_plan_scene){ .volumes = t->volumes,
                                  .occluders = t->occluders,
                                  .receivers = t->receivers,
                                  .parts = t->parts,
                                  .static_volume = NOOK_PLAN_NONE,
                                  .r_max = 2.0,
                                  .exact_union = true };
    for (uint32_t i = 0; i < 400; i++) {
        double x = i % 20, z = i / 20;
        t->receivers[i] = (nook_plan_receiver){ { { x, 0.0, z }, { x + 1.0, 0.0, z + 1.0 } }, NOOK_PLAN_NONE };
    }
    t->scene.receiver_count = 400;
}

/* A cube with a volume of its own, and its surface. */
static uint32_t add_cube(table *t, double x, double y, double z, double half, bool alone)
{
    uint32_t i = t->scene.occluder_count++;
    t->volumes[i] = (nook_plan_volume){ { 2.0 * half, 2.0 * half, 2.0 * half }, 1.0, 64, i };
    t->occluders[i] = (nook_plan_occluder){ i, cube(x, y, z, half), { x, y, z }, half * sqrt(3.0), alone };
    t->receivers[t->scene.receiver_count++] = (nook_plan_receiver){ t->occluders[i].box, i };
    t->scene.volume_count = t->scene.occluder_count;
    return i;
}

static nook_plan make(const table *t)
{
    nook_plan plan;
    assert_int_equal(nook_plan_make(&t->scene, &t->params, &plan), NOOK_OK);
    return plan;
}

static void test_off_changes_nothing(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.0, 50.0, 5.0, 0.1, true);
    t.params.mode = NOOK_PLAN_OFF;
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    assert_int_equal(plan.volumes[0].resolution, 64);
    assert_true(plan.bytes == plan.bytes_before && plan.bytes == 66u * 66u * 66u);
    nook_plan_free(&plan);
}

static void test_a_body_beyond_r_max_of_every_surface_needs_no_volume(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    t.params.error = 0.0f;
    uint32_t far = add_cube(&t, 5.0, 2.3, 5.0, 0.1, true), near = add_cube(&t, 15.0, 2.0, 15.0, 0.1, true);
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[far].rule, NOOK_PLAN_OUT_OF_REACH);
    assert_int_equal(plan.volumes[far].why, NOOK_PLAN_UNUSED);
    assert_int_equal(plan.occluders[near].rule, NOOK_PLAN_KEPT);
    assert_int_equal(plan.volumes[near].resolution, 64);
    assert_true(plan.bound == 0.0);
    assert_true(plan.bytes == 66u * 66u * 66u && plan.bytes_before == 2 * plan.bytes);
    nook_plan_free(&plan);
}

static void test_a_body_that_sees_itself_stays_even_far_away(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    t.params.error = 0.5f;
    add_cube(&t, 5.0, 30.0, 5.0, 0.1, false);
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    nook_plan_free(&plan);
}

static void test_a_body_that_stands_on_the_floor_stays(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    t.params.error = 0.9f;
    add_cube(&t, 5.0, 0.1, 5.0, 0.1, true);
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    assert_true(plan.occluders[0].bound == 1.0);
    nook_plan_free(&plan);
}

static void test_a_small_body_is_left_out_when_its_solid_angle_is_within_the_error(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.5, 1.5, 5.5, 0.05, true);
    double radius = 0.05 * sqrt(3.0) + 4.5 * 0.1 / 64.0; /* with what its voxels and the guard add */
    double sphere = radius * radius / (1.5 * 1.5);
    t.params.error = (float)(1.01 * sphere);
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_TOO_SMALL);
    assert_true(plan.bound <= sphere + 1e-12 && plan.bound > 0.3 * sphere);
    nook_plan_free(&plan);
    t.params.error = (float)(0.3 * sphere);
    plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    assert_true(plan.bound == 0.0);
    nook_plan_free(&plan);
}

static void test_bodies_over_one_place_share_its_error_and_those_over_another_have_their_own(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    for (int i = 0; i < 10; i++) {
        add_cube(&t, 4.5, 1.0 + 0.01 * i, 4.5, 0.03, true);
        add_cube(&t, 15.5, 1.0 + 0.01 * i, 15.5, 0.03, true);
    }
    t.scene.receiver_count = 400; /* cubes in a heap would see each other */
    t.params.error = 1.0f;
    nook_plan all = make(&t);
    t.params.error = (float)(0.55 * all.bound);
    nook_plan half = make(&t);
    uint32_t left_out[2] = { 0, 0 };
    for (uint32_t i = 0; i < 20; i++) {
        assert_int_equal(all.occluders[i].rule, NOOK_PLAN_TOO_SMALL);
        left_out[i % 2] += half.occluders[i].rule != NOOK_PLAN_KEPT;
    }
    assert_int_equal(left_out[0], left_out[1]);
    assert_in_range(left_out[0], 4, 6);
    assert_true(half.bound <= (double)t.params.error && half.bound > 0.4 * all.bound);
    nook_plan_free(&all);
    nook_plan_free(&half);
}

static void test_what_moves_is_never_left_out(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.0, 30.0, 5.0, 0.1, true);
    t.scene.moves = true;
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    nook_plan_free(&plan);
}

static void test_a_camera_leaves_out_what_darkens_nothing_that_it_sees(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 1.0, 0.1, 10.0, 0.1, false);
    add_cube(&t, 19.0, 0.1, 10.0, 0.1, false);
    /* Sees x > 10. */
    nook_plan_view view = { .eye = { 10.0, 1.0, 10.0 }, .pixel_metres = 1e-3 };
    for (int i = 0; i < 5; i++)
        view.planes[i][0] = 1.0, view.planes[i][3] = -10.0;
    t.scene.view = &view;
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_OUT_OF_REACH);
    assert_int_equal(plan.occluders[1].rule, NOOK_PLAN_KEPT);
    assert_true(plan.bound == 0.0);
    nook_plan_free(&plan);
}

static double eighth(void *user, double sine)
{
    (void)user, (void)sine;
    return 0.125;
}

static void test_of_eight_rays_one_may_always_hit(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.5, 1.5, 5.5, 0.01, true);
    nook_plan plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_TOO_SMALL);
    nook_plan_free(&plan);
    t.scene.ray_share = eighth;
    plan = make(&t);
    assert_int_equal(plan.occluders[0].rule, NOOK_PLAN_KEPT);
    nook_plan_free(&plan);
    t.params.error = 0.13f;
    plan = make(&t);
    assert_true(plan.bound == 0.125);
    nook_plan_free(&plan);
}

/* ---- Instances -------------------------------------------------------------------------------------------------- */

static void test_twins_share_a_volume_where_they_are_as_fine(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    for (int i = 0; i < 3; i++)
        add_cube(&t, 5.0 * i, 0.1, 5.0, 0.1, true);
    t.volumes[1].twin = t.volumes[2].twin = 0;
    t.volumes[2].resolution = 96;
    nook_plan plan = make(&t);
    assert_int_equal(plan.volumes[1].why, NOOK_PLAN_TWIN);
    assert_int_equal(plan.volumes[1].volume, 0);
    assert_int_equal(plan.volumes[2].why, NOOK_PLAN_AS_EVER); /* coarser voxels would be another picture */
    assert_int_equal(plan.volumes[2].volume, 2);
    nook_plan_free(&plan);
    t.params.mode = NOOK_PLAN_MEASURED;
    t.params.level_error = 0.0f;
    plan = make(&t);
    assert_int_equal(plan.volumes[2].volume, 0);
    assert_int_equal(plan.volumes[0].resolution,
                     16); /* 16 voxels on 0.2 m are 160 on r_max already: finer than any that was measured */
    nook_plan_free(&plan);
}

/* ---- Levels and memory ------------------------------------------------------------------------------------------ */

static void test_errors_of_levels_fall_and_their_inverse_is_theirs(void **state)
{
    (void)state;
    double before = 1.0;
    for (double k = 4.0; k <= 64.0; k *= 1.1) {
        double error = nook_plan_level_error(k);
        assert_true(error < before);
        assert_true(fabs(nook_plan_level_for(error) / k - 1.0) < 1e-9);
        before = error;
    }
    assert_true(nook_plan_level_error(1.0) == 1.0);
    assert_true(nook_plan_level_for(0.0) == 64.0);
    assert_true(nook_plan_level_for(1.0) == 4.0);
}

static void test_levels_are_as_coarse_as_the_error_allows_and_no_coarser(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.0, 1.0, 5.0, 1.0, false); /* 2 m, r_max 2 m: voxels on r_max are those on its side */
    t.params.mode = NOOK_PLAN_MEASURED;
    for (float error = 0.05f; error < 0.2f; error += 0.01f) {
        t.params.level_error = error;
        nook_plan plan = make(&t);
        assert_true(plan.level_error <= (double)error);
        assert_true(plan.volumes[0].resolution == 16 ||
                    nook_plan_level_error(plan.volumes[0].resolution / 2.0) > (double)error);
        assert_true(plan.volumes[0].error == plan.level_error);
        nook_plan_free(&plan);
    }
}

static void test_far_bodies_have_voxels_of_a_pixel(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_cube(&t, 5.0, 1.0, 5.0, 1.0, false);
    t.params.mode = NOOK_PLAN_MEASURED;
    t.params.level_error = 0.0f;
    nook_plan_view view = { .eye = { 5.0, 1.0, 105.0 }, .pixel_metres = 1e-3 };
    for (int i = 0; i < 5; i++)
        view.planes[i][3] = 1.0; /* sees everything */
    t.scene.view = &view;
    nook_plan plan = make(&t); /* 97 m from what it darkens: a pixel is 0.097 m, 2 m take 21 of them, and 24 voxels */
    assert_int_equal(plan.volumes[0].why, NOOK_PLAN_BY_PIXEL);
    assert_int_equal(plan.volumes[0].resolution, 24);
    nook_plan_free(&plan);
}

static void test_memory_makes_all_coarser_alike_until_it_fits(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    for (int i = 0; i < 4; i++)
        add_cube(&t, 5.0 * i, 1.0, 5.0, 1.0, false);
    t.params.mode = NOOK_PLAN_MEASURED;
    t.params.level_error = 0.0f;
    nook_plan free_plan = make(&t);
    assert_int_equal(free_plan.bytes, 4 * 66 * 66 * 66);
    t.params.memory = 0.5f * (float)free_plan.bytes / (1024.0f * 1024.0f);
    nook_plan plan = make(&t);
    assert_true((double)plan.bytes <= (double)t.params.memory * 1024.0 * 1024.0);
    for (int i = 0; i < 4; i++)
        assert_in_range(plan.volumes[i].resolution, 48, 64);
    assert_int_equal(plan.volumes[0].why, NOOK_PLAN_BY_MEMORY);
    nook_plan_free(&plan);
    nook_plan_free(&free_plan);
}

static void refuse(const table *t, const char *first, const char *second)
{
    nook_log_capture log;
    nook_plan plan;
    nook_log_capture_begin(&log);
    nook_result result = nook_plan_make(&t->scene, &t->params, &plan);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_RANGE);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, first));
    assert_non_null(strstr(log.text, second));
    assert_null(plan.occluders);
}

static void test_memory_that_cannot_be_kept_is_refused_with_what_would_do(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    for (int i = 0; i < 4; i++)
        add_cube(&t, 5.0 * i, 1.0, 5.0, 1.0, false);
    t.params.memory = 0.01f;
    refuse(&t, "needs 1.097", "measured"); /* 4 x 66^3 bytes */
    t.params.mode = NOOK_PLAN_MEASURED;
    refuse(&t, "0.01 MiB", "take 0.023"); /* 4 x 18^3 bytes */
}

/* ---- What stands still ------------------------------------------------------------------------------------------ */

/* A room of six plates, 10 m a side, 0.1 m thick. */
static void add_room(table *t)
{
    for (uint32_t i = 0; i < 6; i++) {
        nook_plan_box plate = cube(5.0, 5.0, 5.0, 5.0);
        double *side = i % 2 ? &plate.min[i / 2] : &plate.max[i / 2];
        *side = i % 2 ? plate.max[i / 2] - 0.1 : plate.min[i / 2] + 0.1;
        t->parts[i].box = plate;
    }
    t->scene.part_count = 6;
    t->scene.static_volume = add_cube(t, 5.0, 5.0, 5.0, 5.0, false);
    t->volumes[t->scene.static_volume].resolution = 100;
    t->params.mode = NOOK_PLAN_MEASURED;
    t->params.level_error = 0.0f;
}

static void test_walls_of_a_room_have_a_volume_each(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_room(&t);
    nook_plan plan = make(&t);
    assert_int_equal(plan.group_count, 6);
    assert_int_equal(plan.volumes[0].why, NOOK_PLAN_UNUSED);
    assert_true(plan.bytes == 6u * 102u * 102u * 3u && plan.bytes_before == 102u * 102u * 102u);
    for (uint32_t i = 0; i < 6; i++) {
        assert_int_equal(plan.groups[i].resolution, 100);
        assert_int_equal(plan.groups[i].parts, 1);
    }
    nook_plan_free(&plan);
}

static void test_a_volume_more_must_save_its_share(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_room(&t);
    t.params.split = 1.0f; /* MiB; the whole is 1.01 */
    nook_plan plan = make(&t);
    assert_int_equal(plan.group_count, 0);
    assert_int_equal(plan.volumes[0].resolution, 100);
    nook_plan_free(&plan);
}

static void test_walls_stay_together_where_volumes_are_multiplied(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_room(&t);
    t.scene.exact_union = false;
    nook_plan plan = make(&t);
    assert_int_equal(plan.group_count, 0);
    nook_plan_free(&plan);
}

static void test_what_is_proven_splits_nothing(void **state)
{
    (void)state;
    table t;
    set_up(&t);
    add_room(&t);
    t.params.mode = NOOK_PLAN_ON;
    nook_plan plan = make(&t);
    assert_int_equal(plan.group_count, 0);
    assert_true(plan.bytes == plan.bytes_before);
    nook_plan_free(&plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_off_changes_nothing),
        cmocka_unit_test(test_a_body_beyond_r_max_of_every_surface_needs_no_volume),
        cmocka_unit_test(test_a_body_that_sees_itself_stays_even_far_away),
        cmocka_unit_test(test_a_body_that_stands_on_the_floor_stays),
        cmocka_unit_test(test_a_small_body_is_left_out_when_its_solid_angle_is_within_the_error),
        cmocka_unit_test(test_bodies_over_one_place_share_its_error_and_those_over_another_have_their_own),
        cmocka_unit_test(test_what_moves_is_never_left_out),
        cmocka_unit_test(test_a_camera_leaves_out_what_darkens_nothing_that_it_sees),
        cmocka_unit_test(test_of_eight_rays_one_may_always_hit),
        cmocka_unit_test(test_twins_share_a_volume_where_they_are_as_fine),
        cmocka_unit_test(test_errors_of_levels_fall_and_their_inverse_is_theirs),
        cmocka_unit_test(test_levels_are_as_coarse_as_the_error_allows_and_no_coarser),
        cmocka_unit_test(test_far_bodies_have_voxels_of_a_pixel),
        cmocka_unit_test(test_memory_makes_all_coarser_alike_until_it_fits),
        cmocka_unit_test(test_memory_that_cannot_be_kept_is_refused_with_what_would_do),
        cmocka_unit_test(test_walls_of_a_room_have_a_volume_each),
        cmocka_unit_test(test_a_volume_more_must_save_its_share),
        cmocka_unit_test(test_walls_stay_together_where_volumes_are_multiplied),
        cmocka_unit_test(test_what_is_proven_splits_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
