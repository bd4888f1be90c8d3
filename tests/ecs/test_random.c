#include "engine/ecs/system.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

/* Random operations on a world and on a model too simple to be wrong: an array of slots, one per entity ever made. */

enum { TYPES = 6, SLOTS = 3000, OPERATIONS = 20000, VALUE_MAX = 128 };

/* Sizes with and without a constant-size copy; the first word of a component is its value, the rest is made from it. */
static const nook_type types[TYPES] = { { "four", 4, 4 },    { "eight", 8, 8 },     { "twelve", 12, 4 },
                                        { "twenty", 20, 4 }, { "sixteen", 16, 16 }, { "transform", 128, 64 } };

typedef struct slot {
    nook_entity entity;
    bool alive;
    bool has[TYPES];
    uint32_t values[TYPES];
} slot;

typedef struct model {
    nook_world *world;
    nook_component ids[TYPES];
    slot slots[SLOTS];
    uint32_t slot_count, alive_count;
    uint64_t random;
} model;

static uint32_t random_below(model *m, uint32_t bound)
{
    m->random ^= m->random << 13; /* xorshift64, Marsaglia 2003 */
    m->random ^= m->random >> 7;
    m->random ^= m->random << 17;
    return (uint32_t)(m->random >> 32) % bound;
}

static void make_value(uint32_t value, uint32_t size, uint8_t *out)
{
    for (uint32_t i = 0; i < size; i++)
        out[i] = (uint8_t)(value >> (i % 4 * 8)) ^ (uint8_t)(i / 4);
}

static void check_slot(const model *m, const slot *s)
{
    assert_int_equal(nook_entity_alive(m->world, s->entity), s->alive);
    for (int t = 0; t < TYPES; t++) {
        uint8_t expected[VALUE_MAX] = { 0 };
        const void *found = nook_entity_find(m->world, s->entity, m->ids[t]);
        assert_int_equal(found != NULL, s->alive && s->has[t]);
        assert_int_equal(nook_entity_has(m->world, s->entity, m->ids[t]), s->alive && s->has[t]);
        if (!found)
            continue;
        assert_int_equal((uintptr_t)found % types[t].align, 0);
        if (s->values[t] != 0)
            make_value(s->values[t], types[t].size, expected);
        assert_memory_equal(found, expected, types[t].size);
    }
}

static void check_all(const model *m)
{
    assert_int_equal(nook_world_entity_count(m->world), m->alive_count);
    for (uint32_t i = 0; i < m->slot_count; i++)
        check_slot(m, &m->slots[i]);
}

/* Entities with the first type and without the second, by a query made at the start. */
static void check_query(const model *m, nook_query *query)
{
    uint64_t expected = 0, walked = 0;
    for (uint32_t i = 0; i < m->slot_count; i++)
        expected += m->slots[i].alive && m->slots[i].has[0] && !m->slots[i].has[1];
    nook_query_walk walk = nook_query_begin(m->world, query);
    while (nook_query_next(&walk)) {
        for (uint32_t i = 0; i < walk.count; i++) {
            const uint8_t *row = (const uint8_t *)walk.columns[0] + (size_t)i * types[0].size;
            assert_ptr_equal(row, nook_entity_find(m->world, walk.entities[i], m->ids[0]));
        }
        walked += walk.count;
    }
    assert_int_equal(walked, expected);
    assert_int_equal(nook_query_count(query), expected);
}

/* ---- operations, done directly, or by commands when there are any ---- */

static void create_one(model *m, nook_commands *commands)
{
    if (m->slot_count == SLOTS)
        return;
    slot *s = &m->slots[m->slot_count++];
    if (commands) {
        s->entity = nook_commands_create(commands);
    } else {
        nook_component some[TYPES];
        uint32_t count = 0;
        for (uint32_t t = random_below(m, TYPES + 1); t < TYPES; t += 1 + random_below(m, 3)) {
            some[count++] = m->ids[t];
            s->has[t] = true;
        }
        assert_int_equal(nook_entity_create(m->world, some, count, 1, &s->entity), NOOK_OK);
    }
    assert_true(s->entity.id != 0);
    s->alive = true;
    m->alive_count++;
}

static void destroy_one(model *m, nook_commands *commands, slot *s)
{
    if (commands)
        nook_commands_destroy(commands, s->entity);
    else
        assert_int_equal(nook_entity_destroy(m->world, s->entity), NOOK_OK);
    s->alive = false;
    m->alive_count--;
}

static void add_to_one(model *m, nook_commands *commands, slot *s)
{
    uint32_t t = random_below(m, TYPES), value = random_below(m, 4) ? random_below(m, UINT32_MAX) : 0;
    uint8_t bytes[VALUE_MAX];
    make_value(value, types[t].size, bytes);
    const void *given = value ? bytes : NULL; /* NULL: zeroes */
    if (commands)
        nook_commands_add(commands, s->entity, m->ids[t], given);
    else
        assert_int_equal(nook_entity_add(m->world, s->entity, m->ids[t], given), NOOK_OK);
    s->has[t] = true;
    s->values[t] = value;
}

static void remove_from_one(model *m, nook_commands *commands, slot *s)
{
    uint32_t t = random_below(m, TYPES);
    if (commands)
        nook_commands_remove(commands, s->entity, m->ids[t]);
    else
        assert_int_equal(nook_entity_remove(m->world, s->entity, m->ids[t]), NOOK_OK);
    s->has[t] = false;
    s->values[t] = 0;
}

static void operate(model *m, nook_commands *commands)
{
    uint32_t dice = random_below(m, 100);
    if (m->slot_count == 0 || dice < 20) {
        create_one(m, commands);
        return;
    }
    slot *s = &m->slots[random_below(m, m->slot_count)];
    for (int tries = 0; !s->alive && tries < 20; tries++)
        s = &m->slots[random_below(m, m->slot_count)];
    if (!s->alive)
        return;
    uint32_t repeats = 1 + random_below(m, 4); /* several changes to one entity are carried out together */
    for (uint32_t i = 0; i < repeats; i++) {
        if (dice < 60)
            add_to_one(m, commands, s);
        else if (dice < 88)
            i % 2 ? add_to_one(m, commands, s) : remove_from_one(m, commands, s);
    }
    if (dice >= 88)
        destroy_one(m, commands, s);
}

typedef struct model_resource {
    model *model;
} model_resource;

static void operate_deferred(const nook_rows *rows)
{
    model *m = ((const model_resource *)rows->resources[0])->model;
    uint32_t count = random_below(m, 60);
    for (uint32_t i = 0; i < count; i++)
        operate(m, rows->commands);
}

/* ---- the test ---- */

static void set_up_model(model *m, uint64_t seed)
{
    nook_system deferred = {
        .name = "test.deferred", .resources = { NOOK_TYPE(model_resource) }, .structural = true, .run = operate_deferred
    };
    m->random = seed;
    assert_int_equal(nook_world_create(NULL, &m->world), NOOK_OK);
    for (int t = 0; t < TYPES; t++) {
        assert_int_equal(nook_world_component(m->world, &types[t], &m->ids[t]), NOOK_OK);
        deferred.changes[t] = types[t];
    }
    assert_int_equal(nook_world_set_resource(m->world, NOOK_TYPE_OF(model_resource), &(model_resource){ m }), NOOK_OK);
    assert_int_equal(nook_world_add_system(m->world, &deferred), NOOK_OK);
}

static void run_sequence(uint64_t seed)
{
    model *m = calloc(1, sizeof *m);
    nook_query *query;
    const nook_query_desc desc = { .with = { types[0] }, .without = { types[1] } };
    assert_non_null(m);
    set_up_model(m, seed);
    assert_int_equal(nook_query_create(m->world, &desc, &query), NOOK_OK);
    for (uint32_t i = 0; i < OPERATIONS; i++) {
        if (random_below(m, 50) == 0)
            assert_int_equal(nook_world_run_phase(m->world, NOOK_PHASE_UPDATE), NOOK_OK);
        else
            operate(m, NULL);
        if (i % 500 == 0) {
            check_all(m);
            check_query(m, query);
        }
    }
    check_all(m);
    check_query(m, query);
    nook_world_destroy(m->world);
    free(m);
}

static void test_random_operations_give_what_a_simple_model_gives(void **state)
{
    (void)state;
    const char *given = getenv("NOOK_SEED");
    uint64_t seed = given ? strtoull(given, NULL, 0) : (uint64_t)time(NULL) | 1;
    print_message("seed %llu (repeat it with NOOK_SEED)\n", (unsigned long long)seed);
    for (uint64_t i = 0; i < 4; i++)
        run_sequence((seed + i) * 0x9E3779B97F4A7C15u | 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_operations_give_what_a_simple_model_gives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
