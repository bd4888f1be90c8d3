#include "engine/ecs/system.h"
#include "tests/support/abort.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct life {
    int32_t left;
} life;

typedef struct target {
    nook_entity entity;
} target;

typedef struct mark {
    uint64_t value;
} mark;

typedef struct counter {
    uint32_t lives;
} counter;

typedef struct fixture {
    nook_world *world;
    nook_component life, target, mark;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    const nook_world_desc desc = { .threads = 1, .check_access = true };
    return f && nook_world_create(&desc, &f->world) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(life), &f->life) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(target), &f->target) == NOOK_OK &&
                   nook_world_component(f->world, NOOK_TYPE_OF(mark), &f->mark) == NOOK_OK &&
                   nook_world_set_resource(f->world, NOOK_TYPE_OF(counter), NULL) == NOOK_OK
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

static nook_entity make(fixture *f, nook_component component, const void *value)
{
    nook_entity entity = { 0 };
    assert_int_equal(nook_entity_create(f->world, NULL, 0, 1, &entity), NOOK_OK);
    assert_int_equal(nook_entity_add(f->world, entity, component, value), NOOK_OK);
    return entity;
}

static void run_system(fixture *f, const nook_system *system)
{
    assert_int_equal(nook_world_add_system(f->world, system), NOOK_OK);
    assert_int_equal(nook_world_run_phase(f->world, system->phase), NOOK_OK);
}

/* ---- destroy ---- */

static void reap(const nook_rows *rows)
{
    life *l = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++) {
        if (--l[i].left > 0)
            continue;
        nook_commands_destroy(rows->commands, rows->entities[i]);
        nook_commands_destroy(rows->commands, rows->entities[i]); /* twice is ordinary */
    }
}

static void count_lives(const nook_rows *rows)
{
    ((counter *)rows->resources[0])->lives += rows->count;
}

static void test_destroyed_entities_are_gone_for_the_next_system(void **state)
{
    fixture *f = *state;
    const nook_system reaper = { .name = "test.reap", .writes = { NOOK_TYPE(life) }, .structural = true, .run = reap };
    const nook_system counting = {
        .name = "test.count", .reads = { NOOK_TYPE(life) }, .resources = { NOOK_TYPE(counter) }, .run = count_lives
    };
    nook_entity entities[100];
    for (int i = 0; i < 100; i++)
        entities[i] = make(f, f->life, &(life){ 1 + i % 2 });
    assert_int_equal(nook_world_add_system(f->world, &reaper), NOOK_OK);
    assert_int_equal(nook_world_add_system(f->world, &counting), NOOK_OK);
    assert_int_equal(nook_world_run_phase(f->world, NOOK_PHASE_UPDATE), NOOK_OK);
    assert_int_equal(((counter *)nook_world_resource(f->world, NOOK_TYPE_OF(counter)))->lives, 50);
    for (int i = 0; i < 100; i++) {
        const life *l = nook_entity_find(f->world, entities[i], f->life);
        assert_true(i % 2 == 0 ? !l : l && l->left == 1);
    }
    assert_int_equal(nook_world_run_phase(f->world, NOOK_PHASE_UPDATE), NOOK_OK);
    assert_int_equal(nook_world_entity_count(f->world), 0);
}

/* ---- create ---- */

static void spawn(const nook_rows *rows)
{
    target *t = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++) {
        const uint64_t value = 100 + i;
        t[i].entity = nook_commands_create(rows->commands);
        nook_commands_add(rows->commands, t[i].entity, rows->changes[1], &(mark){ value });
        nook_commands_add(rows->commands, t[i].entity, rows->changes[0], NULL);
        nook_entity lost = nook_commands_create(rows->commands);
        nook_commands_add(rows->commands, lost, rows->changes[0], &(life){ 3 });
        nook_commands_destroy(rows->commands, lost);
    }
}

static void test_created_entities_can_be_stored_before_they_live(void **state)
{
    fixture *f = *state;
    const nook_system spawner = { .name = "test.spawn",
                                  .writes = { NOOK_TYPE(target) },
                                  .changes = { NOOK_TYPE(life), NOOK_TYPE(mark) },
                                  .structural = true,
                                  .run = spawn };
    nook_entity parents[20];
    for (int i = 0; i < 20; i++)
        parents[i] = make(f, f->target, NULL);
    run_system(f, &spawner);
    assert_int_equal(nook_world_entity_count(f->world), 40);
    for (int i = 0; i < 20; i++) {
        const target *t = nook_entity_find(f->world, parents[i], f->target);
        const mark *m = nook_entity_find(f->world, t->entity, f->mark);
        const life *l = nook_entity_find(f->world, t->entity, f->life);
        assert_true(m && m->value == 100 + (uint64_t)i);
        assert_true(l && l->left == 0);
    }
}

/* ---- add and remove ---- */

static void swap_components(const nook_rows *rows)
{
    const life *l = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++) {
        nook_entity entity = rows->entities[i];
        nook_commands_remove(rows->commands, entity, rows->changes[0]);
        if (l[i].left == 1) /* the last word counts */
            nook_commands_add(rows->commands, entity, rows->changes[0], &(life){ 55 });
        nook_commands_add(rows->commands, entity, rows->changes[1], &(mark){ 1 });
        nook_commands_add(rows->commands, entity, rows->changes[1], &(mark){ (uint64_t)l[i].left });
        if (l[i].left == 2)
            nook_commands_remove(rows->commands, entity, rows->changes[1]);
    }
}

static void test_changes_to_one_entity_are_done_in_order(void **state)
{
    fixture *f = *state;
    const nook_system swapper = { .name = "test.swap",
                                  .reads = { NOOK_TYPE(life) },
                                  .changes = { NOOK_TYPE(life), NOOK_TYPE(mark) },
                                  .structural = true,
                                  .run = swap_components };
    nook_entity entities[4];
    for (int i = 0; i < 4; i++)
        entities[i] = make(f, f->life, &(life){ i });
    run_system(f, &swapper);
    for (int i = 0; i < 4; i++) {
        const life *l = nook_entity_find(f->world, entities[i], f->life);
        const mark *m = nook_entity_find(f->world, entities[i], f->mark);
        assert_true(i == 1 ? l && l->left == 55 : !l);
        assert_true(i == 2 ? !m : m && m->value == (uint64_t)i);
    }
}

static void change_others(const nook_rows *rows)
{
    const target *t = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++) {
        nook_commands_add(rows->commands, t[i].entity, rows->changes[0], &(mark){ 7 });
        nook_commands_remove(rows->commands, (nook_entity){ 0 }, rows->changes[0]);
    }
}

static void test_changes_to_entities_that_are_gone_are_dropped(void **state)
{
    fixture *f = *state;
    const nook_system changer = { .name = "test.change",
                                  .reads = { NOOK_TYPE(target) },
                                  .changes = { NOOK_TYPE(mark) },
                                  .structural = true,
                                  .run = change_others };
    nook_entity gone = make(f, f->life, NULL), there = make(f, f->life, NULL);
    assert_int_equal(nook_entity_destroy(f->world, gone), NOOK_OK);
    nook_entity heir = make(f, f->life, NULL); /* in the same place */
    make(f, f->target, &(target){ gone });
    make(f, f->target, &(target){ there });
    run_system(f, &changer);
    assert_false(nook_entity_has(f->world, heir, f->mark));
    assert_int_equal(((mark *)nook_entity_find(f->world, there, f->mark))->value, 7);
}

static void test_structural_systems_run_alone_and_in_order(void **state)
{
    fixture *f = *state;
    const nook_system first = { .name = "test.first", .reads = { NOOK_TYPE(life) }, .run = reap };
    const nook_system second = { .name = "test.second", .reads = { NOOK_TYPE(mark) }, .structural = true, .run = reap };
    const nook_system third = { .name = "test.third", .reads = { NOOK_TYPE(target) }, .run = reap };
    uint32_t batches[3];
    assert_int_equal(nook_world_add_system(f->world, &first), NOOK_OK);
    assert_int_equal(nook_world_add_system(f->world, &second), NOOK_OK);
    assert_int_equal(nook_world_add_system(f->world, &third), NOOK_OK);
    assert_int_equal(nook_world_system_batch(f->world, "test.first", &batches[0]), NOOK_OK);
    assert_int_equal(nook_world_system_batch(f->world, "test.second", &batches[1]), NOOK_OK);
    assert_int_equal(nook_world_system_batch(f->world, "test.third", &batches[2]), NOOK_OK);
    assert_true(batches[0] < batches[1] && batches[1] < batches[2]);
}

static void change_undeclared(const nook_rows *rows)
{
    nook_component any = { 1 };
    nook_commands_add(rows->commands, rows->entities[0], any, NULL);
}

static void misuse_change_undeclared(void)
{
    const nook_system system = { .name = "test.undeclared",
                                 .reads = { NOOK_TYPE(life) },
                                 .changes = { NOOK_TYPE(mark) },
                                 .structural = true,
                                 .run = change_undeclared };
    nook_world *world = NULL;
    nook_component component;
    nook_world_create(NULL, &world);
    nook_world_component(world, NOOK_TYPE_OF(life), &component);
    nook_entity_create(world, &component, 1, 1, NULL);
    nook_world_add_system(world, &system);
    nook_world_run_phase(world, NOOK_PHASE_UPDATE);
}

static void test_changing_an_undeclared_component_is_refused_by_assert(void **state)
{
    (void)state;
    assert_true(nook_aborts(misuse_change_undeclared));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_destroyed_entities_are_gone_for_the_next_system),
        TEST(test_created_entities_can_be_stored_before_they_live),
        TEST(test_changes_to_one_entity_are_done_in_order),
        TEST(test_changes_to_entities_that_are_gone_are_dropped),
        TEST(test_structural_systems_run_alone_and_in_order),
        TEST(test_changing_an_undeclared_component_is_refused_by_assert),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
