#include "engine/ecs/internal.h"
#include "engine/ecs/system.h"
#include "tests/support/abort.h"
#include "tests/support/log_capture.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct position {
    double x;
} position;

typedef struct velocity {
    double x;
} velocity;

typedef struct colour {
    uint32_t value;
} colour;

typedef struct frozen {
    uint8_t unused;
} frozen;

typedef struct step {
    double seconds;
} step;

/* Letters of the systems that ran. */
typedef struct history {
    char text[32];
} history;

static nook_world *make_world(unsigned threads)
{
    nook_world *world = NULL;
    const nook_world_desc desc = { .threads = threads, .check_access = true };
    assert_int_equal(nook_world_create(&desc, &world), NOOK_OK);
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(step), &(step){ 0.5 }), NOOK_OK);
    assert_int_equal(nook_world_set_resource(world, NOOK_TYPE_OF(history), NULL), NOOK_OK);
    return world;
}

static nook_component component_of(nook_world *world, const nook_type *type)
{
    nook_component component = { 0 };
    assert_int_equal(nook_world_component(world, type, &component), NOOK_OK);
    return component;
}

static void add(nook_world *world, const nook_system *system)
{
    assert_int_equal(nook_world_add_system(world, system), NOOK_OK);
}

static void run(nook_world *world, nook_phase phase)
{
    assert_int_equal(nook_world_run_phase(world, phase), NOOK_OK);
}

static uint32_t batch_of(const nook_world *world, const char *name)
{
    uint32_t batch = UINT32_MAX;
    assert_int_equal(nook_world_system_batch(world, name, &batch), NOOK_OK);
    return batch;
}

/* ---- systems ---- */

static void move(const nook_rows *rows)
{
    const velocity *v = rows->columns[0];
    position *p = rows->columns[1];
    const step *s = rows->resources[0];
    for (uint32_t i = 0; i < rows->count; i++)
        p[i].x += v[i].x * s->seconds;
}

static void paint(const nook_rows *rows)
{
    colour *c = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++)
        c[i].value = c[i].value * 1664525u + (uint32_t)rows->entities[i].id;
}

static void bounce(const nook_rows *rows)
{
    const position *p = rows->columns[0];
    velocity *v = rows->columns[1];
    for (uint32_t i = 0; i < rows->count; i++)
        v[i].x = p[i].x > 10 ? -v[i].x : v[i].x;
}

static void note(const nook_rows *rows, char letter)
{
    history *h = rows->resources[0];
    size_t length = strlen(h->text);
    if (length + 1 < sizeof h->text)
        h->text[length] = letter;
}

static void note_a(const nook_rows *rows)
{
    note(rows, 'a');
}

static void note_b(const nook_rows *rows)
{
    note(rows, 'b');
}

static const nook_system move_system = {
    .name = "test.move",
    .reads = { NOOK_TYPE(velocity) },
    .writes = { NOOK_TYPE(position) },
    .without = { NOOK_TYPE(frozen) },
    .resources_read = { NOOK_TYPE(step) },
    .run = move,
};

static const nook_system paint_system = {
    .name = "test.paint",
    .writes = { NOOK_TYPE(colour) },
    .run = paint,
};

static const nook_system bounce_system = {
    .name = "test.bounce",
    .reads = { NOOK_TYPE(position) },
    .writes = { NOOK_TYPE(velocity) },
    .run = bounce,
};

static const nook_system note_a_system = {
    .name = "test.note_a",
    .resources = { NOOK_TYPE(history) },
    .run = note_a,
};

static const nook_system note_b_system = {
    .name = "test.note_b",
    .phase = NOOK_PHASE_RENDER,
    .reads = { NOOK_TYPE(colour) },
    .resources = { NOOK_TYPE(history) },
    .run = note_b,
};

/* ---- what systems see ---- */

static void test_system_visits_matching_entities_of_all_tables(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    nook_component p = component_of(world, NOOK_TYPE_OF(position)), v = component_of(world, NOOK_TYPE_OF(velocity)),
                   c = component_of(world, NOOK_TYPE_OF(colour)), ice = component_of(world, NOOK_TYPE_OF(frozen));
    const nook_component sets[][4] = { { p, v }, { p, v, c }, { p }, { p, v, ice } };
    const uint32_t sizes[] = { 2, 3, 1, 3 };
    const double expected[] = { 1.5, 1.5, 0, 0 };
    nook_entity entities[4];
    for (int i = 0; i < 4; i++) {
        assert_int_equal(nook_entity_create(world, sets[i], sizes[i], 1, &entities[i]), NOOK_OK);
        if (i != 2)
            assert_int_equal(nook_entity_add(world, entities[i], v, &(velocity){ 3 }), NOOK_OK);
    }
    add(world, &move_system);
    run(world, NOOK_PHASE_UPDATE);
    for (int i = 0; i < 4; i++)
        assert_true(((position *)nook_entity_find(world, entities[i], p))->x == expected[i]);
    nook_world_destroy(world);
}

static void test_system_without_components_runs_once_and_others_only_for_rows(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    add(world, &note_a_system);
    add(world, &note_b_system);
    run(world, NOOK_PHASE_UPDATE);
    run(world, NOOK_PHASE_RENDER); /* nobody has a colour */
    history *h = nook_world_resource(world, NOOK_TYPE_OF(history));
    assert_string_equal(h->text, "a");
    nook_component c = component_of(world, NOOK_TYPE_OF(colour));
    assert_int_equal(nook_entity_create(world, &c, 1, 10, NULL), NOOK_OK);
    run(world, NOOK_PHASE_RENDER);
    run(world, NOOK_PHASE_PRE_RENDER);
    assert_string_equal(h->text, "ab");
    nook_world_destroy(world);
}

static void test_system_is_refused_without_its_resource_or_with_another_struct(void **state)
{
    (void)state;
    nook_world *world = NULL;
    nook_log_capture capture;
    assert_int_equal(nook_world_create(NULL, &world), NOOK_OK);
    nook_log_capture_begin(&capture);
    assert_int_equal(nook_world_add_system(world, &note_a_system), NOOK_E_NOT_FOUND);
    assert_non_null(strstr(capture.text, "history"));
    assert_int_equal(nook_world_set_resource(world, &(nook_type){ "history", 8, 1 }, NULL), NOOK_OK);
    assert_int_equal(nook_world_add_system(world, &note_a_system), NOOK_E_VERSION);
    nook_component c;
    assert_int_equal(nook_world_component(world, &(nook_type){ "colour", 16, 4 }, &c), NOOK_OK);
    assert_int_equal(nook_world_add_system(world, &paint_system), NOOK_E_VERSION);
    uint32_t batch = 77;
    assert_int_equal(nook_world_system_batch(world, "test.paint", &batch), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_int_equal(batch, 77);
    run(world, NOOK_PHASE_UPDATE);
    nook_world_destroy(world);
}

/* ---- batches ---- */

static void test_systems_share_a_batch_only_when_neither_writes_what_the_other_touches(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    nook_system read_position = { .name = "test.read_1", .reads = { NOOK_TYPE(position) }, .run = note_a };
    nook_system also_reads = { .name = "test.read_2", .reads = { NOOK_TYPE(position) }, .run = note_a };
    nook_system reads_step = { .name = "test.read_3", .resources_read = { NOOK_TYPE(step) }, .run = note_a };
    nook_system writes_step = { .name = "test.write_step", .resources = { NOOK_TYPE(step) }, .run = note_a };
    add(world, &move_system);   /* velocity, step -> position */
    add(world, &paint_system);  /* -> colour: nothing in common */
    add(world, &read_position); /* after move, which writes it */
    add(world, &also_reads);    /* two readers together */
    add(world, &bounce_system); /* position -> velocity: after move, which reads velocity */
    add(world, &reads_step);
    add(world, &writes_step); /* after all who read it */
    add(world, &note_b_system);
    assert_int_equal(batch_of(world, "test.move"), 0);
    assert_int_equal(batch_of(world, "test.paint"), 0);
    assert_int_equal(batch_of(world, "test.read_1"), 1);
    assert_int_equal(batch_of(world, "test.read_2"), 1);
    assert_int_equal(batch_of(world, "test.bounce"), 1);
    assert_int_equal(batch_of(world, "test.read_3"), 0);
    assert_int_equal(batch_of(world, "test.write_step"), 1);
    assert_int_equal(batch_of(world, "test.note_b"), 0); /* another phase */
    nook_world_destroy(world);
}

static void fill(nook_world *world)
{
    nook_component p = component_of(world, NOOK_TYPE_OF(position)), v = component_of(world, NOOK_TYPE_OF(velocity)),
                   c = component_of(world, NOOK_TYPE_OF(colour)), ice = component_of(world, NOOK_TYPE_OF(frozen));
    const nook_component sets[][3] = { { p, v }, { p, v, c }, { c }, { v, p, ice } };
    const uint32_t sizes[] = { 2, 3, 1, 3 }, counts[] = { 50000, 70001, 30000, 5 };
    for (int i = 0; i < 4; i++)
        assert_int_equal(nook_entity_create(world, sets[i], sizes[i], counts[i], NULL), NOOK_OK);
    nook_query *query;
    const nook_query_desc desc = { .with = { NOOK_TYPE(velocity) } };
    assert_int_equal(nook_query_create(world, &desc, &query), NOOK_OK);
    nook_query_walk walk = nook_query_begin(world, query);
    while (nook_query_next(&walk)) {
        for (uint32_t i = 0; i < walk.count; i++)
            ((velocity *)walk.columns[0])[i].x = (double)(walk.entities[i].id % 1000) * 0.1;
    }
}

static uint64_t hash_world(nook_world *world)
{
    static const nook_type types[] = { NOOK_TYPE(position), NOOK_TYPE(velocity), NOOK_TYPE(colour) };
    uint64_t hash = 0;
    for (int t = 0; t < 3; t++) {
        nook_query *query;
        nook_query_desc desc = { .with = { types[t] } };
        assert_int_equal(nook_query_create(world, &desc, &query), NOOK_OK);
        nook_query_walk walk = nook_query_begin(world, query);
        while (nook_query_next(&walk)) {
            const uint8_t *bytes = walk.columns[0];
            for (size_t i = 0; i < (size_t)walk.count * types[t].size; i++)
                hash = (hash ^ bytes[i]) * 0x100000001B3u;
        }
    }
    return hash;
}

static uint64_t simulate(unsigned threads)
{
    nook_world *world = make_world(threads);
    fill(world);
    add(world, &move_system);
    add(world, &paint_system);
    add(world, &bounce_system);
    add(world, &note_a_system);
    for (int frame = 0; frame < 3; frame++)
        run(world, NOOK_PHASE_UPDATE);
    assert_string_equal(((history *)nook_world_resource(world, NOOK_TYPE_OF(history)))->text, "aaa");
    uint64_t hash = hash_world(world);
    nook_world_destroy(world);
    return hash;
}

static void test_results_are_the_same_on_any_number_of_threads(void **state)
{
    (void)state;
    uint64_t alone = simulate(1);
    assert_true(simulate(2) == alone);
    assert_true(simulate(7) == alone);
}

/* ---- asserts ---- */

static void write_to_reads(const nook_rows *rows)
{
    ((position *)rows->columns[0])[0].x += 1;
}

static void misuse_write_to_reads(void)
{
    const nook_system system = { .name = "test.liar", .reads = { NOOK_TYPE(position) }, .run = write_to_reads };
    nook_world *world = make_world(1);
    nook_component p = component_of(world, NOOK_TYPE_OF(position));
    nook_entity_create(world, &p, 1, 1, NULL);
    nook_world_add_system(world, &system);
    nook_world_run_phase(world, NOOK_PHASE_UPDATE);
}

static void write_to_read_resource(const nook_rows *rows)
{
    ((step *)rows->resources[0])->seconds = 9;
}

static void misuse_write_to_read_resource(void)
{
    const nook_system system = { .name = "test.liar",
                                 .resources_read = { NOOK_TYPE(step) },
                                 .run = write_to_read_resource };
    nook_world *world = make_world(1);
    nook_world_add_system(world, &system);
    nook_world_run_phase(world, NOOK_PHASE_UPDATE);
}

static void misuse_read_and_write_the_same(void)
{
    const nook_system system = {
        .name = "test.both", .reads = { NOOK_TYPE(position) }, .writes = { NOOK_TYPE(position) }, .run = note_a
    };
    nook_world_add_system(make_world(1), &system);
}

static void misuse_two_of_one_name(void)
{
    nook_world *world = make_world(1);
    nook_world_add_system(world, &paint_system);
    nook_world_add_system(world, &paint_system);
}

typedef struct world_pointer {
    nook_world *world;
} world_pointer;

static void create_directly(const nook_rows *rows)
{
    nook_entity_create(((world_pointer *)rows->resources[0])->world, NULL, 0, 1, NULL);
}

static void misuse_create_from_a_system(void)
{
    const nook_system system = { .name = "test.direct",
                                 .resources = { NOOK_TYPE(world_pointer) },
                                 .run = create_directly };
    nook_world *world = make_world(1);
    nook_world_set_resource(world, NOOK_TYPE_OF(world_pointer), &(world_pointer){ world });
    nook_world_add_system(world, &system);
    nook_world_run_phase(world, NOOK_PHASE_UPDATE);
}

static void test_undeclared_access_is_refused_by_assert(void **state)
{
    (void)state;
    assert_true(nook_aborts(misuse_write_to_reads));
    assert_true(nook_aborts(misuse_write_to_read_resource));
    assert_true(nook_aborts(misuse_read_and_write_the_same));
    assert_true(nook_aborts(misuse_two_of_one_name));
    assert_true(nook_aborts(misuse_create_from_a_system));
}

/* ---- systems of code that was loaded anew ---- */

static void move_backwards(const nook_rows *rows)
{
    position *p = rows->columns[1];
    const velocity *v = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++)
        p[i].x -= v[i].x;
}

static void move_forwards(const nook_rows *rows)
{
    position *p = rows->columns[1];
    const velocity *v = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++)
        p[i].x += v[i].x;
}

static void grow(const nook_rows *rows)
{
    position *p = rows->columns[0];
    for (uint32_t i = 0; i < rows->count; i++)
        p[i].x *= 10.0;
}

static const nook_system moves = {
    .name = "move", .reads = { NOOK_TYPE(velocity) }, .writes = { NOOK_TYPE(position) }, .run = move_forwards
};
static const nook_system grows = { .name = "grow", .writes = { NOOK_TYPE(position) }, .run = grow };

static double position_after_a_run(nook_world *world, nook_entity entity)
{
    run(world, NOOK_PHASE_UPDATE);
    position *p = nook_entity_find(world, entity, component_of(world, NOOK_TYPE_OF(position)));
    return p->x;
}

static nook_entity make_mover(nook_world *world)
{
    nook_entity entity;
    const nook_component kinds[] = { component_of(world, NOOK_TYPE_OF(position)),
                                     component_of(world, NOOK_TYPE_OF(velocity)) };
    assert_int_equal(nook_entity_create(world, kinds, NOOK_COUNT(kinds), 1, &entity), NOOK_OK);
    assert_int_equal(nook_entity_add(world, entity, kinds[1], &(velocity){ 1.0 }), NOOK_OK);
    return entity;
}

static void test_a_system_takes_the_place_of_the_one_of_its_name_in_the_order_too(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    nook_entity mover = make_mover(world);
    char name[] = "move"; /* of code that is gone afterwards */
    nook_system old = moves, renewed = moves;
    old.name = name;
    add(world, &old);
    add(world, &grows);
    assert_true(position_after_a_run(world, mover) == 10.0);
    renewed.run = move_backwards;
    assert_int_equal(nook_world_replace_system(world, &renewed), NOOK_OK);
    memset(name, '-', sizeof name - 1);
    assert_true(position_after_a_run(world, mover) == 90.0); /* (10 - 1) * 10 */
    uint32_t batch;
    assert_int_equal(nook_world_system_batch(world, "move", &batch), NOOK_OK);
    assert_int_equal(batch, 0);
    nook_world_destroy(world);
}

static void test_a_system_that_touches_something_else_now_is_scheduled_anew(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    nook_entity mover = make_mover(world);
    nook_system idle = moves;
    uint32_t batch;
    memset(idle.reads, 0, sizeof idle.reads);
    memset(idle.writes, 0, sizeof idle.writes);
    idle.reads[0] = (nook_type)NOOK_TYPE(velocity);
    idle.run = grow; /* of nobody's position: its rows are velocities */
    idle.writes[0] = (nook_type)NOOK_TYPE(colour);
    add(world, &idle);
    add(world, &grows);
    assert_int_equal(nook_world_system_batch(world, "grow", &batch), NOOK_OK);
    assert_int_equal(batch, 0);
    assert_int_equal(nook_world_replace_system(world, &moves), NOOK_OK);
    assert_int_equal(nook_world_system_batch(world, "grow", &batch), NOOK_OK);
    assert_int_equal(batch, 1);
    assert_true(position_after_a_run(world, mover) == 10.0);
    nook_world_destroy(world);
}

static void test_a_system_that_cannot_take_the_place_leaves_the_old_one(void **state)
{
    (void)state;
    nook_log_capture log;
    nook_world *world = make_world(1);
    nook_entity mover = make_mover(world);
    nook_system other = moves;
    add(world, &moves);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_world_replace_system(world, &grows), NOOK_E_NOT_FOUND);
    other.phase = NOOK_PHASE_RENDER;
    assert_int_equal(nook_world_replace_system(world, &other), NOOK_E_VERSION);
    other = moves;
    other.run = move_backwards;
    other.writes[0].size = 4;
    assert_int_equal(nook_world_replace_system(world, &other), NOOK_E_VERSION);
    nook_log_capture_end();
    assert_true(position_after_a_run(world, mover) == 1.0);
    nook_world_destroy(world);
}

static void test_systems_replaced_a_thousand_times_leave_one_query(void **state)
{
    (void)state;
    nook_world *world = make_world(1);
    nook_entity mover = make_mover(world);
    add(world, &moves);
    for (int i = 0; i < 1000; i++)
        assert_int_equal(nook_world_replace_system(world, &moves), NOOK_OK);
    assert_int_equal(world->query_count, 1);
    assert_true(position_after_a_run(world, mover) == 1.0);
    nook_world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_system_visits_matching_entities_of_all_tables),
        cmocka_unit_test(test_system_without_components_runs_once_and_others_only_for_rows),
        cmocka_unit_test(test_system_is_refused_without_its_resource_or_with_another_struct),
        cmocka_unit_test(test_systems_share_a_batch_only_when_neither_writes_what_the_other_touches),
        cmocka_unit_test(test_results_are_the_same_on_any_number_of_threads),
        cmocka_unit_test(test_undeclared_access_is_refused_by_assert),
        cmocka_unit_test(test_a_system_takes_the_place_of_the_one_of_its_name_in_the_order_too),
        cmocka_unit_test(test_a_system_that_touches_something_else_now_is_scheduled_anew),
        cmocka_unit_test(test_a_system_that_cannot_take_the_place_leaves_the_old_one),
        cmocka_unit_test(test_systems_replaced_a_thousand_times_leave_one_query),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
