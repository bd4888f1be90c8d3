#include "engine/ecs/query.h"
#include "tests/support/abort.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct number {
    uint32_t value;
} number;

typedef struct mark {
    uint8_t value;
} mark;

typedef struct fixture {
    nook_world *world;
    nook_component number, mark;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return f && nook_world_create(NULL, &f->world) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(number), &f->number) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(mark), &f->mark) == NOOK_OK
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

static void make(fixture *f, uint32_t count, bool with_number, bool with_mark)
{
    nook_component components[2];
    uint32_t component_count = 0;
    if (with_number)
        components[component_count++] = f->number;
    if (with_mark)
        components[component_count++] = f->mark;
    assert_int_equal(nook_entity_create(f->world, components, component_count, count, NULL), NOOK_OK);
}

static uint64_t walk_and_count(nook_world *world, const nook_query *query)
{
    uint64_t count = 0;
    nook_query_walk walk = nook_query_begin(world, query);
    while (nook_query_next(&walk)) {
        assert_true(walk.count > 0);
        for (uint32_t i = 0; i < walk.count; i++)
            assert_true(nook_entity_alive(world, walk.entities[i]));
        count += walk.count;
    }
    return count;
}

static void test_query_visits_those_that_have_all_and_none_of_the_others(void **state)
{
    fixture *f = *state;
    nook_query *all, *numbers, *only_numbers, *both;
    make(f, 3, true, false); /* before the queries are made */
    const nook_query_desc with_number = { .with = { NOOK_TYPE(number) } },
                          no_mark = { .with = { NOOK_TYPE(number) }, .without = { NOOK_TYPE(mark) } },
                          with_both = { .with = { NOOK_TYPE(mark), NOOK_TYPE(number) } }, anyone = { 0 };
    assert_int_equal(nook_query_create(f->world, &anyone, &all), NOOK_OK);
    assert_int_equal(nook_query_create(f->world, &with_number, &numbers), NOOK_OK);
    assert_int_equal(nook_query_create(f->world, &no_mark, &only_numbers), NOOK_OK);
    assert_int_equal(nook_query_create(f->world, &with_both, &both), NOOK_OK);
    make(f, 5, true, true); /* in tables that did not exist then */
    make(f, 7, false, true);
    make(f, 11, false, false);
    assert_int_equal(nook_query_count(all), 26);
    assert_int_equal(nook_query_count(numbers), 8);
    assert_int_equal(nook_query_count(only_numbers), 3);
    assert_int_equal(nook_query_count(both), 5);
    assert_int_equal(walk_and_count(f->world, all), 26);
    assert_int_equal(walk_and_count(f->world, numbers), 8);
    assert_int_equal(walk_and_count(f->world, only_numbers), 3);
    assert_int_equal(walk_and_count(f->world, both), 5);
}

static void test_query_gives_columns_in_the_order_asked_and_aligned(void **state)
{
    fixture *f = *state;
    nook_query *query;
    make(f, 1000, true, true);
    const nook_query_desc desc = { .with = { NOOK_TYPE(mark), NOOK_TYPE(number) } };
    assert_int_equal(nook_query_create(f->world, &desc, &query), NOOK_OK);
    nook_query_walk walk = nook_query_begin(f->world, query);
    while (nook_query_next(&walk)) {
        mark *marks = walk.columns[0];
        number *numbers = walk.columns[1];
        assert_int_equal((uintptr_t)marks % NOOK_COLUMN_ALIGN, 0);
        assert_int_equal((uintptr_t)numbers % NOOK_COLUMN_ALIGN, 0);
        for (uint32_t i = 0; i < walk.count; i++) {
            marks[i].value = (uint8_t)i;
            numbers[i].value = (uint32_t)walk.entities[i].id;
        }
    }
    walk = nook_query_begin(f->world, query);
    while (nook_query_next(&walk)) {
        for (uint32_t i = 0; i < walk.count; i++) {
            assert_int_equal(((mark *)nook_entity_find(f->world, walk.entities[i], f->mark))->value, (uint8_t)i);
            assert_int_equal(((number *)nook_entity_find(f->world, walk.entities[i], f->number))->value,
                             (uint32_t)walk.entities[i].id);
        }
    }
}

static void test_structure_may_change_again_after_a_walk_that_was_left_early(void **state)
{
    fixture *f = *state;
    nook_query *query;
    make(f, 2, true, false);
    make(f, 2, true, true);
    const nook_query_desc desc = { .with = { NOOK_TYPE(number) } };
    assert_int_equal(nook_query_create(f->world, &desc, &query), NOOK_OK);
    nook_query_walk walk = nook_query_begin(f->world, query);
    assert_true(nook_query_next(&walk));
    nook_query_end(&walk);
    make(f, 1, true, false);
    assert_int_equal(nook_query_count(query), 5);
}

/* Leaves a world in the middle of a walk, as what the misuses below start from. */
static nook_world *start_walk(nook_entity *out_entity, nook_component *out_component)
{
    static const nook_query_desc anyone = { 0 };
    nook_world *world = NULL;
    nook_query *query = NULL;
    nook_world_create(NULL, &world);
    nook_world_component(world, NOOK_TYPE_OF(number), out_component);
    nook_entity_create(world, NULL, 0, 1, out_entity);
    nook_query_create(world, &anyone, &query);
    nook_query_walk walk = nook_query_begin(world, query);
    nook_query_next(&walk);
    return world;
}

static void misuse_create_during_walk(void)
{
    nook_entity entity;
    nook_component component;
    nook_entity_create(start_walk(&entity, &component), NULL, 0, 1, NULL);
}

static void misuse_destroy_during_walk(void)
{
    nook_entity entity;
    nook_component component;
    nook_world *world = start_walk(&entity, &component);
    nook_entity_destroy(world, entity);
}

static void misuse_add_during_walk(void)
{
    nook_entity entity;
    nook_component component;
    nook_world *world = start_walk(&entity, &component);
    nook_entity_add(world, entity, component, NULL);
}

static void misuse_remove_during_walk(void)
{
    nook_entity entity;
    nook_component component;
    nook_world *world = start_walk(&entity, &component);
    nook_entity_remove(world, entity, component);
}

static void test_structural_changes_during_a_walk_are_refused_by_assert(void **state)
{
    (void)state;
    assert_true(nook_aborts(misuse_create_during_walk));
    assert_true(nook_aborts(misuse_destroy_during_walk));
    assert_true(nook_aborts(misuse_add_during_walk));
    assert_true(nook_aborts(misuse_remove_during_walk));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_query_visits_those_that_have_all_and_none_of_the_others),
        TEST(test_query_gives_columns_in_the_order_asked_and_aligned),
        TEST(test_structure_may_change_again_after_a_walk_that_was_left_early),
        TEST(test_structural_changes_during_a_walk_are_refused_by_assert),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
