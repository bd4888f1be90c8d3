#include "engine/core/angle.h"
#include "engine/core/matrix.h"
#include "engine/ecs/spin.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

/* A world with the system and one body. */
static nook_world *make_world(double seconds, const nook_spin *spin, nook_entity *out_body)
{
    nook_world *world = NULL;
    nook_component kinds[2];
    const nook_time_step step = { seconds };
    assert_int_equal(nook_world_create(&(nook_world_desc){ .check_access = true }, &world), NOOK_OK);
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(nook_spin), &kinds[0]), NOOK_OK);
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(nook_transform), &kinds[1]), NOOK_OK);
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(nook_time_step), &step), NOOK_OK);
    assert_int_equal(nook_world_add_system(world, &nook_advance_spins), NOOK_OK);
    assert_int_equal(nook_entity_create(world, kinds, 2, 1, out_body), NOOK_OK);
    assert_int_equal(nook_entity_add(world, *out_body, kinds[0], spin), NOOK_OK);
    return world;
}

static nook_matrix transform_of(nook_world *world, nook_entity body)
{
    nook_component kind;
    nook_matrix m;
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(nook_transform), &kind), NOOK_OK);
    const nook_transform *transform = nook_entity_find(world, body, kind);
    assert_non_null(transform);
    memcpy(m.m, transform->world_from_local, sizeof m.m);
    return m;
}

static void assert_same(const nook_matrix *a, const nook_matrix *b, double tolerance)
{
    for (int i = 0; i < 16; i++) {
        if (!(fabs(a->m[i] - b->m[i]) <= tolerance))
            fail_msg("element %d: %.17g instead of %.17g", i, a->m[i], b->m[i]);
    }
}

static void test_a_body_turns_about_its_pivot_with_all_its_scale_and_shear(void **state)
{
    (void)state;
    const nook_matrix start = { { 2, 0, 0, 0, 1, 3, 0, 0, 0, 0, -1, 0, 10, 0, 4, 1 } };
    nook_spin spin = { .pivot = { 10, 5, 0 }, .angular_velocity = { 0, 0, NOOK_PI }, .rotation = { 0, 0, 0, 1 } };
    memcpy(spin.world_from_start, start.m, sizeof start.m);
    nook_entity body;
    nook_world *world = make_world(0.5, &spin, &body);
    assert_int_equal(nook_world_run_phase(world, NOOK_PHASE_UPDATE), NOOK_OK);
    /* A quarter turn about z through (10, 5): x to y, y to -x. The origin, 5 below the pivot, goes 5 to its right. */
    const nook_matrix quarter = { { 0, 2, 0, 0, -3, 1, 0, 0, 0, 0, -1, 0, 15, 5, 4, 1 } };
    nook_matrix now = transform_of(world, body);
    assert_same(&now, &quarter, 1e-14);
    for (int i = 0; i < 3; i++)
        assert_int_equal(nook_world_run_phase(world, NOOK_PHASE_UPDATE), NOOK_OK);
    now = transform_of(world, body);
    assert_same(&now, &start, 1e-13);
    nook_world_destroy(world);
}

static void test_a_body_without_velocity_stands_still(void **state)
{
    (void)state;
    const nook_matrix start = nook_matrix_translation(1, 2, 3);
    nook_spin spin = { .pivot = { 7, 8, 9 }, .rotation = { 0, 0, 0, 1 } };
    memcpy(spin.world_from_start, start.m, sizeof start.m);
    nook_entity body;
    nook_world *world = make_world(0.1, &spin, &body);
    for (int i = 0; i < 100; i++)
        assert_int_equal(nook_world_run_phase(world, NOOK_PHASE_UPDATE), NOOK_OK);
    nook_matrix now = transform_of(world, body);
    assert_same(&now, &start, 0.0);
    nook_world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_body_turns_about_its_pivot_with_all_its_scale_and_shear),
        cmocka_unit_test(test_a_body_without_velocity_stands_still),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
