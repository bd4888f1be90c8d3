#include "modules/plan/shape.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { CORNERS = 8, INDICES = 36 };

typedef struct solid {
    float positions[2 * CORNERS * 3];
    uint32_t indices[2 * INDICES];
} solid;

/* Two cubes of 1 m; the second `apart` metres along x. */
static solid cubes(float apart)
{
    static const uint32_t faces[INDICES] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
    solid s;
    for (uint32_t i = 0; i < 2 * CORNERS; i++) {
        for (uint32_t axis = 0; axis < 3; axis++)
            s.positions[i * 3 + axis] = i >> axis & 1 ? 0.5f : -0.5f;
        s.positions[i * 3] += i < CORNERS ? 0.0f : apart;
    }
    for (uint32_t i = 0; i < INDICES; i++) {
        s.indices[i] = faces[i];
        s.indices[INDICES + i] = faces[i] + CORNERS;
    }
    return s;
}

static void test_a_cube_is_convex_whichever_way_its_triangles_face(void **state)
{
    (void)state;
    solid s = cubes(0.0f);
    assert_true(nook_plan_is_convex(s.positions, s.indices, INDICES));
    for (uint32_t i = 0; i < INDICES; i += 3) {
        uint32_t kept = s.indices[i];
        s.indices[i] = s.indices[i + 1];
        s.indices[i + 1] = kept;
    }
    assert_true(nook_plan_is_convex(s.positions, s.indices, INDICES));
}

static void test_a_cube_with_corners_for_every_face_is_convex(void **state)
{
    (void)state;
    solid s = cubes(0.0f); /* the second cube lies in the first: the same corners twice */
    for (uint32_t i = 0; i < INDICES; i += 6)
        for (uint32_t k = 0; k < 6; k++)
            s.indices[i + k] += i % 12 == 0 ? CORNERS : 0;
    assert_true(nook_plan_is_convex(s.positions, s.indices, INDICES));
}

static void test_an_open_box_sees_itself(void **state)
{
    (void)state;
    solid s = cubes(0.0f);
    assert_false(nook_plan_is_convex(s.positions, s.indices, INDICES - 6));
    assert_false(nook_plan_is_convex(s.positions, s.indices, INDICES - 3));
}

static void test_a_dent_is_found(void **state)
{
    (void)state;
    solid s = cubes(0.0f);
    s.positions[0] = s.positions[1] = s.positions[2] = 0.2f; /* a corner pushed in */
    assert_false(nook_plan_is_convex(s.positions, s.indices, INDICES));
}

static void test_two_cubes_see_each_other(void **state)
{
    (void)state;
    solid s = cubes(3.0f);
    assert_false(nook_plan_is_convex(s.positions, s.indices, (size_t)2 * INDICES));
}

static void test_a_sheet_is_no_solid(void **state)
{
    (void)state;
    solid s = cubes(0.0f);
    assert_false(nook_plan_is_convex(s.positions, s.indices, 6));
    assert_false(nook_plan_is_convex(s.positions, s.indices, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_cube_is_convex_whichever_way_its_triangles_face),
        cmocka_unit_test(test_a_cube_with_corners_for_every_face_is_convex),
        cmocka_unit_test(test_an_open_box_sees_itself),
        cmocka_unit_test(test_a_dent_is_found),
        cmocka_unit_test(test_two_cubes_see_each_other),
        cmocka_unit_test(test_a_sheet_is_no_solid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
