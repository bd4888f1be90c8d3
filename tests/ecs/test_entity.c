#include "engine/ecs/world.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct position {
    float x, y, z;
} position;

typedef struct velocity {
    float x, y, z;
} velocity;

typedef struct wide {
    _Alignas(64) double values[8];
} wide;

typedef struct fixture {
    nook_world *world;
    nook_component position, velocity, wide;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return f && nook_world_create(NULL, &f->world) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(position), &f->position) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(velocity), &f->velocity) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(wide), &f->wide) == NOOK_OK
               ? 0
               : -1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    nook_world_destroy(f->world);
    free(f);
    return 0;
}

static nook_entity make_empty(fixture *f)
{
    nook_entity entity = { 0 };
    assert_int_equal(nook_entity_create(f->world, NULL, 0, 1, &entity), NOOK_OK);
    assert_true(entity.id != 0);
    return entity;
}

static void test_entity_without_components_lives_and_dies(void **state)
{
    fixture *f = *state;
    nook_entity entity = make_empty(f);
    assert_true(nook_entity_alive(f->world, entity));
    assert_false(nook_entity_has(f->world, entity, f->position));
    assert_null(nook_entity_find(f->world, entity, f->position));
    assert_int_equal(nook_world_entity_count(f->world), 1);
    assert_int_equal(nook_entity_destroy(f->world, entity), NOOK_OK);
    assert_false(nook_entity_alive(f->world, entity));
    assert_int_equal(nook_world_entity_count(f->world), 0);
}

static void test_no_entity_is_never_alive(void **state)
{
    fixture *f = *state;
    assert_false(nook_entity_alive(f->world, (nook_entity){ 0 }));
    make_empty(f);
    assert_false(nook_entity_alive(f->world, (nook_entity){ 0 }));
    assert_false(nook_entity_alive(f->world, (nook_entity){ UINT64_MAX }));
    assert_false(nook_entity_alive(f->world, (nook_entity){ (uint64_t)1 << 32 | 1000 }));
}

static void test_created_entities_have_zeroed_components(void **state)
{
    fixture *f = *state;
    const nook_component both[] = { f->position, f->wide };
    nook_entity entities[100];
    /* Rows that were used before must be zeroed too. */
    assert_int_equal(nook_entity_create(f->world, both, 2, 100, entities), NOOK_OK);
    for (int i = 0; i < 100; i++)
        memset(nook_entity_find(f->world, entities[i], f->wide), 0xAA, sizeof(wide));
    for (int i = 0; i < 100; i++)
        assert_int_equal(nook_entity_destroy(f->world, entities[i]), NOOK_OK);
    assert_int_equal(nook_entity_create(f->world, both, 2, 100, entities), NOOK_OK);
    const wide zero = { { 0 } };
    for (int i = 0; i < 100; i++) {
        assert_memory_equal(nook_entity_find(f->world, entities[i], f->wide), &zero, sizeof zero);
        assert_true(nook_entity_has(f->world, entities[i], f->position));
        assert_false(nook_entity_has(f->world, entities[i], f->velocity));
    }
}

static void test_components_keep_their_values_when_others_come_and_go(void **state)
{
    fixture *f = *state;
    nook_entity entity = make_empty(f);
    const position p = { 1, 2, 3 };
    const velocity v = { 4, 5, 6 };
    assert_int_equal(nook_entity_add(f->world, entity, f->position, &p), NOOK_OK);
    assert_int_equal(nook_entity_add(f->world, entity, f->velocity, &v), NOOK_OK);
    assert_int_equal(nook_entity_add(f->world, entity, f->wide, NULL), NOOK_OK);
    assert_int_equal(nook_entity_remove(f->world, entity, f->velocity), NOOK_OK);
    assert_memory_equal(nook_entity_find(f->world, entity, f->position), &p, sizeof p);
    assert_null(nook_entity_find(f->world, entity, f->velocity));
    const wide *w = nook_entity_find(f->world, entity, f->wide);
    assert_non_null(w);
    assert_int_equal((uintptr_t)w % _Alignof(wide), 0);
}

static void test_adding_twice_overwrites_and_removing_twice_does_nothing(void **state)
{
    fixture *f = *state;
    nook_entity entity = make_empty(f);
    assert_int_equal(nook_entity_add(f->world, entity, f->position, &(position){ 1, 1, 1 }), NOOK_OK);
    assert_int_equal(nook_entity_add(f->world, entity, f->position, &(position){ 2, 2, 2 }), NOOK_OK);
    assert_true(((position *)nook_entity_find(f->world, entity, f->position))->x == 2);
    assert_int_equal(nook_entity_add(f->world, entity, f->position, NULL), NOOK_OK);
    assert_true(((position *)nook_entity_find(f->world, entity, f->position))->x == 0);
    assert_int_equal(nook_entity_remove(f->world, entity, f->position), NOOK_OK);
    assert_int_equal(nook_entity_remove(f->world, entity, f->position), NOOK_OK);
    assert_true(nook_entity_alive(f->world, entity));
}

static void test_destroying_one_leaves_the_values_of_the_others(void **state)
{
    fixture *f = *state;
    nook_entity entities[50];
    assert_int_equal(nook_entity_create(f->world, &f->position, 1, 50, entities), NOOK_OK);
    for (int i = 0; i < 50; i++)
        ((position *)nook_entity_find(f->world, entities[i], f->position))->x = (float)i;
    for (int i = 0; i < 50; i += 3)
        assert_int_equal(nook_entity_destroy(f->world, entities[i]), NOOK_OK);
    for (int i = 0; i < 50; i++) {
        const position *p = nook_entity_find(f->world, entities[i], f->position);
        if (i % 3 == 0)
            assert_null(p);
        else
            assert_true(p && p->x == (float)i);
    }
}

static void test_a_reused_index_gets_another_generation(void **state)
{
    fixture *f = *state;
    nook_entity first = make_empty(f);
    assert_int_equal(nook_entity_destroy(f->world, first), NOOK_OK);
    nook_entity second = make_empty(f);
    assert_int_equal((uint32_t)first.id, (uint32_t)second.id);
    assert_int_equal((second.id >> 32) - (first.id >> 32), 1);
    assert_false(nook_entity_alive(f->world, first));
    assert_true(nook_entity_alive(f->world, second));
    /* A forged handle with the generation that a freed index will have next. */
    assert_int_equal(nook_entity_destroy(f->world, second), NOOK_OK);
    assert_false(nook_entity_alive(f->world, (nook_entity){ second.id + ((uint64_t)1 << 32) }));
}

static void test_stale_handles_are_not_found_and_change_nothing(void **state)
{
    fixture *f = *state;
    nook_entity stale = make_empty(f);
    assert_int_equal(nook_entity_destroy(f->world, stale), NOOK_OK);
    nook_entity heir = make_empty(f);
    nook_log_capture capture;
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_entity_destroy(f->world, stale), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_entity_add(f->world, stale, f->position, NULL), NOOK_E_NOT_FOUND);
    assert_int_equal(nook_entity_remove(f->world, stale, f->position), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_int_equal(capture.count, 3);
    assert_null(nook_entity_find(f->world, stale, f->position));
    assert_false(nook_entity_has(f->world, stale, f->position));
    assert_true(nook_entity_alive(f->world, heir));
    assert_false(nook_entity_has(f->world, heir, f->position));
}

static void test_tables_are_shared_whatever_the_order_of_adding(void **state)
{
    fixture *f = *state;
    nook_entity a = make_empty(f), b = make_empty(f);
    nook_entity_add(f->world, a, f->position, NULL);
    nook_entity_add(f->world, a, f->velocity, NULL);
    uint32_t tables = nook_world_table_count(f->world); /* {}, {p}, {p v} */
    assert_int_equal(tables, 3);
    nook_entity_add(f->world, b, f->velocity, NULL);
    nook_entity_add(f->world, b, f->position, NULL);
    assert_int_equal(nook_world_table_count(f->world), tables + 1); /* and {v} */
}

static void test_a_million_entities_are_made_changed_and_destroyed(void **state)
{
    enum { COUNT = 1000000 };
    fixture *f = *state;
    nook_entity *entities = malloc(COUNT * sizeof *entities);
    assert_non_null(entities);
    assert_int_equal(nook_entity_create(f->world, &f->position, 1, COUNT, entities), NOOK_OK);
    for (uint32_t i = 0; i < COUNT; i++) {
        ((position *)nook_entity_find(f->world, entities[i], f->position))->x = (float)i;
        assert_int_equal(nook_entity_add(f->world, entities[i], f->velocity, &(velocity){ 1, 2, (float)i }), NOOK_OK);
    }
    for (uint32_t i = 0; i < COUNT; i += 2)
        assert_int_equal(nook_entity_remove(f->world, entities[i], f->position), NOOK_OK);
    for (uint32_t i = 0; i < COUNT; i++) {
        const position *p = nook_entity_find(f->world, entities[i], f->position);
        const velocity *v = nook_entity_find(f->world, entities[i], f->velocity);
        assert_true(v && v->z == (float)i);
        assert_true(i % 2 == 0 ? p == NULL : p && p->x == (float)i);
    }
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(nook_entity_destroy(f->world, entities[i]), NOOK_OK);
    assert_int_equal(nook_world_entity_count(f->world), 0);
    free(entities);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_entity_without_components_lives_and_dies),
        TEST(test_no_entity_is_never_alive),
        TEST(test_created_entities_have_zeroed_components),
        TEST(test_components_keep_their_values_when_others_come_and_go),
        TEST(test_adding_twice_overwrites_and_removing_twice_does_nothing),
        TEST(test_destroying_one_leaves_the_values_of_the_others),
        TEST(test_a_reused_index_gets_another_generation),
        TEST(test_stale_handles_are_not_found_and_change_nothing),
        TEST(test_tables_are_shared_whatever_the_order_of_adding),
        TEST(test_a_million_entities_are_made_changed_and_destroyed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
