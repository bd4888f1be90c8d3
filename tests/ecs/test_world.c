#include "engine/ecs/world.h"
#include "tests/support/abort.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct position {
    float x, y, z;
} position;

typedef struct wide {
    _Alignas(64) double values[8];
} wide;

static nook_world *make_world(void)
{
    nook_world *world = NULL;
    assert_int_equal(nook_world_create(NULL, &world), NOOK_OK);
    assert_non_null(world);
    return world;
}

static void test_component_keeps_its_id_when_asked_again(void **state)
{
    (void)state;
    nook_world *world = make_world();
    nook_component first = { 0 }, second = { 0 }, other = { 0 };
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(position), &first), NOOK_OK);
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(wide), &other), NOOK_OK);
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(position), &second), NOOK_OK);
    assert_int_equal(first.id, second.id);
    assert_int_not_equal(first.id, 0);
    assert_int_not_equal(first.id, other.id);
    nook_world_destroy(world);
}

static void test_component_of_another_size_or_alignment_is_refused(void **state)
{
    (void)state;
    nook_world *world = make_world();
    nook_component id = { 0 };
    nook_log_capture capture;
    const nook_type older = { "position", 8, 4 }, packed = { "position", 12, 1 };
    assert_int_equal(nook_world_component(world, NOOK_TYPE_OF(position), &id), NOOK_OK);
    nook_component refused = { 77 };
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_world_component(world, &older, &refused), NOOK_E_VERSION);
    assert_non_null(strstr(capture.text, "position"));
    assert_int_equal(nook_world_component(world, &packed, &refused), NOOK_E_VERSION);
    nook_log_capture_end();
    assert_int_equal(capture.count, 2);
    assert_int_equal(refused.id, 77);
    nook_world_destroy(world);
}

static void test_component_name_is_copied(void **state)
{
    (void)state;
    nook_world *world = make_world();
    char name[] = "transient";
    nook_component first = { 0 }, second = { 0 };
    assert_int_equal(nook_world_component(world, &(nook_type){ name, 4, 4 }, &first), NOOK_OK);
    memset(name, 'x', strlen(name));
    assert_int_equal(nook_world_component(world, &(nook_type){ "transient", 4, 4 }, &second), NOOK_OK);
    assert_int_equal(first.id, second.id);
    nook_world_destroy(world);
}

static void test_world_holds_255_component_types_on_one_entity_and_refuses_more(void **state)
{
    (void)state;
    nook_world *world = make_world();
    nook_component ids[NOOK_COMPONENTS_MAX], refused = { 77 };
    nook_entity entity;
    char name[16];
    assert_int_equal(nook_entity_create(world, NULL, 0, 1, &entity), NOOK_OK);
    for (uint32_t i = 0; i < NOOK_COMPONENTS_MAX; i++) {
        snprintf(name, sizeof name, "type_%u", i);
        assert_int_equal(nook_world_component(world, &(nook_type){ name, 4, 4 }, &ids[i]), NOOK_OK);
        assert_int_equal(nook_entity_add(world, entity, ids[i], &i), NOOK_OK);
    }
    for (uint32_t i = 0; i < NOOK_COMPONENTS_MAX; i++)
        assert_int_equal(*(uint32_t *)nook_entity_find(world, entity, ids[i]), i);
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_world_component(world, &(nook_type){ "one_more", 4, 4 }, &refused), NOOK_E_MEMORY);
    nook_log_capture_end();
    assert_int_equal(refused.id, 77);
    nook_world_destroy(world);
}

static void test_resource_is_one_of_its_type_and_keeps_its_address(void **state)
{
    (void)state;
    nook_world *world = make_world();
    assert_null(nook_world_resource(world, NOOK_TYPE_OF(position)));
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(position), &(position){ 1, 2, 3 }), NOOK_OK);
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(wide), NULL), NOOK_OK);
    position *first = nook_world_resource(world, NOOK_TYPE_OF(position));
    const wide *other = nook_world_resource(world, NOOK_TYPE_OF(wide));
    assert_non_null(first);
    assert_true(first->x == 1 && first->y == 2 && first->z == 3);
    assert_int_equal((uintptr_t)other % _Alignof(wide), 0);
    assert_true(other->values[7] == 0);
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(position), &(position){ 4, 5, 6 }), NOOK_OK);
    assert_ptr_equal(nook_world_resource(world, NOOK_TYPE_OF(position)), first);
    assert_true(first->x == 4);
    nook_world_destroy(world);
}

static void test_resource_of_another_size_is_refused_and_the_old_one_stays(void **state)
{
    (void)state;
    nook_world *world = make_world();
    nook_log_capture capture;
    const nook_type newer = { "position", 16, 4 };
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(position), &(position){ 1, 2, 3 }), NOOK_OK);
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_world_set_resource(world, &newer, NULL), NOOK_E_VERSION);
    nook_log_capture_end();
    assert_true(((position *)nook_world_resource(world, NOOK_TYPE_OF(position)))->z == 3);
    nook_world_destroy(world);
}

static void test_two_worlds_know_nothing_of_each_other(void **state)
{
    (void)state;
    nook_world *first = make_world(), *second = make_world();
    nook_component id = { 0 };
    nook_entity entity;
    assert_int_equal(nook_world_component(first, &(nook_type){ "thing", 4, 4 }, &id), NOOK_OK);
    assert_int_equal(nook_world_component(second, &(nook_type){ "thing", 8, 8 }, &id), NOOK_OK);
    assert_int_equal(nook_entity_create(first, NULL, 0, 1, &entity), NOOK_OK);
    assert_true(nook_entity_alive(first, entity));
    assert_false(nook_entity_alive(second, entity));
    nook_world_destroy(second);
    assert_int_equal(nook_world_entity_count(first), 1);
    nook_world_destroy(first);
    nook_world_destroy(NULL);
}

static void misuse_component_too_large(void)
{
    nook_component id;
    nook_world *world = NULL;
    nook_world_create(NULL, &world);
    nook_world_component(world, &(nook_type){ "huge", NOOK_TYPE_SIZE_MAX + 1, 4 }, &id);
}

static void misuse_component_of_no_world(void)
{
    nook_entity entity;
    nook_world *world = NULL;
    nook_world_create(NULL, &world);
    nook_entity_create(world, NULL, 0, 1, &entity);
    nook_entity_add(world, entity, (nook_component){ 9 }, NULL);
}

static void test_world_asserts_on_misuse(void **state)
{
    (void)state;
    assert_true(nook_aborts(misuse_component_too_large));
    assert_true(nook_aborts(misuse_component_of_no_world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_component_keeps_its_id_when_asked_again),
        cmocka_unit_test(test_component_of_another_size_or_alignment_is_refused),
        cmocka_unit_test(test_component_name_is_copied),
        cmocka_unit_test(test_world_holds_255_component_types_on_one_entity_and_refuses_more),
        cmocka_unit_test(test_resource_is_one_of_its_type_and_keeps_its_address),
        cmocka_unit_test(test_resource_of_another_size_is_refused_and_the_old_one_stays),
        cmocka_unit_test(test_two_worlds_know_nothing_of_each_other),
        cmocka_unit_test(test_world_asserts_on_misuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
