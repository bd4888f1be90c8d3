#include "modules/measure/silhouettes.h"
#include "tests/support/eye.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = NOOK_EYE_SIDE, PIXELS = NOOK_EYE_PIXELS };

static void face_wall(nook_eye *e, double distance)
{
    nook_eye_face_wall(e, 0.0, 0.0, 0.0, distance);
}

static void mark(nook_eye *e)
{
    memset(e->marks, 255, sizeof e->marks);
    assert_int_equal(nook_silhouettes_mark(&e->seen, e->marks), NOOK_OK);
}

static int count_of(const nook_eye *e, uint8_t side)
{
    uint8_t mask[PIXELS];
    int count = 0;
    nook_silhouettes_mask(e->marks, PIXELS, side, mask);
    for (int i = 0; i < PIXELS; i++)
        count += mask[i];
    return count;
}

static void test_a_wall_that_fills_the_picture_has_no_silhouette(void **state)
{
    (void)state;
    static nook_eye e;
    face_wall(&e, 10.0);
    mark(&e);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_AWAY), PIXELS);
}

static void test_both_sides_of_a_step_reach_as_far_as_is_stated(void **state)
{
    (void)state;
    static nook_eye e;
    enum { EDGE = 13 };
    face_wall(&e, 10.0);
    for (int i = 0; i < PIXELS; i++) {
        if (i % SIDE < EDGE)
            nook_eye_show(&e, i % SIDE, i / SIDE, 5.0, nook_eye_towards);
    }
    mark(&e);
    for (int i = 0; i < PIXELS; i++) { /* the first column of each side stands beside the silhouette itself */
        int inside = EDGE - 1 - i % SIDE, outside = i % SIDE - EDGE;
        uint8_t truth = inside >= 0 && inside <= NOOK_SILHOUETTE_PIXELS     ? NOOK_SILHOUETTE_INSIDE
                        : outside >= 0 && outside <= NOOK_SILHOUETTE_PIXELS ? NOOK_SILHOUETTE_OUTSIDE
                                                                            : NOOK_SILHOUETTE_AWAY;
        assert_int_equal(e.marks[i], truth);
    }
}

static void test_reach_is_round(void **state)
{
    (void)state;
    static nook_eye e;
    face_wall(&e, 10.0);
    nook_eye_show(&e, 16, 16, 5.0, nook_eye_towards);
    mark(&e);
    assert_int_equal(e.marks[16 * SIDE + 16], NOOK_SILHOUETTE_INSIDE);
    for (int i = 0; i < PIXELS; i++) { /* the four around the dot are the silhouette's far side */
        int dx = abs(i % SIDE - 16), dy = abs(i / SIDE - 16);
        if (dx + dy == 0)
            continue;
        int from_right = (dx - 1) * (dx - 1) + dy * dy, from_top = dx * dx + (dy - 1) * (dy - 1);
        int nearest = from_right < from_top ? from_right : from_top;
        uint8_t truth =
            nearest <= NOOK_SILHOUETTE_PIXELS * NOOK_SILHOUETTE_PIXELS ? NOOK_SILHOUETTE_OUTSIDE : NOOK_SILHOUETTE_AWAY;
        /* Diagonally the dot itself is as near as the far side, and outside wins. */
        assert_int_equal(e.marks[i], truth);
    }
}

static void test_an_object_before_nothing_has_an_inside_only(void **state)
{
    (void)state;
    static nook_eye e;
    face_wall(&e, 0.0);
    for (int y = 8; y < 24; y++) {
        for (int x = 8; x < 24; x++)
            nook_eye_show(&e, x, y, 5.0, nook_eye_towards);
    }
    mark(&e);
    int away = 16 - 2 * (NOOK_SILHOUETTE_PIXELS + 1);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_EMPTY), PIXELS - 256);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_AWAY), away * away);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_INSIDE), 256 - away * away);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_OUTSIDE), 0);
}

/* A floor 1.5 m under the eye meets a wall: neither the slant, with 10 m between two pixels, nor the corner is a silhouette. */
static void test_a_slanted_floor_and_its_corner_with_a_wall_are_no_silhouette(void **state)
{
    (void)state;
    static nook_eye e;
    const double up[3] = { 0.0, 1.0, 0.0 };
    face_wall(&e, 30.0);
    for (int i = 0; i < PIXELS; i++) {
        double slope = (0.5 * SIDE - (i / SIDE + 0.5)) / (0.5 * SIDE), distance = 1.5 / slope;
        if (slope > 0.0 && distance < 30.0)
            nook_eye_show(&e, i % SIDE, i / SIDE, distance, up);
    }
    mark(&e);
    assert_int_equal(count_of(&e, NOOK_SILHOUETTE_AWAY), PIXELS);
}

static void test_normals_are_in_world_space_and_the_camera_stands_anywhere(void **state)
{
    (void)state;
    static nook_eye straight, turned;
    const double eye_at[3] = { 7.0, -3.0, 11.0 }, target[3] = { -2.0, 1.0, 5.0 }, up[3] = { 0.0, 1.0, 0.0 };
    nook_matrix view_from_world = nook_matrix_look_at(eye_at, target, up), world_from_view;
    assert_true(nook_matrix_inverse_affine(&view_from_world, &world_from_view));
    face_wall(&straight, 30.0);
    face_wall(&turned, 30.0);
    turned.seen.view_from_world = view_from_world;
    for (int i = 0; i < PIXELS; i++) {
        double slope = (0.5 * SIDE - (i / SIDE + 0.5)) / (0.5 * SIDE), normal[3] = { 0.0, 1.0, 0.0 };
        bool floor_there = slope > 0.0 && 1.5 / slope < 30.0;
        if (i % SIDE == 20) /* a post before both */
            nook_eye_show(&straight, i % SIDE, i / SIDE, 0.7, nook_eye_towards);
        else if (floor_there)
            nook_eye_show(&straight, i % SIDE, i / SIDE, 1.5 / slope, normal);
        for (int k = 0; k < 3; k++)
            normal[k] = (double)straight.normals[3 * i + k];
        nook_matrix_apply_vector(&world_from_view, normal, normal);
        nook_eye_show(&turned, i % SIDE, i / SIDE, (double)straight.distances[i], normal);
    }
    mark(&straight);
    mark(&turned);
    assert_int_equal(count_of(&straight, NOOK_SILHOUETTE_INSIDE), SIDE);
    assert_memory_equal(straight.marks, turned.marks, PIXELS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_wall_that_fills_the_picture_has_no_silhouette),
        cmocka_unit_test(test_both_sides_of_a_step_reach_as_far_as_is_stated),
        cmocka_unit_test(test_reach_is_round),
        cmocka_unit_test(test_an_object_before_nothing_has_an_inside_only),
        cmocka_unit_test(test_a_slanted_floor_and_its_corner_with_a_wall_are_no_silhouette),
        cmocka_unit_test(test_normals_are_in_world_space_and_the_camera_stands_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
