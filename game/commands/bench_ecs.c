#include "game/commands/bench_ecs.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "engine/ecs/query.h"
#include <stdlib.h>

typedef struct bench_position {
    float x, y, z;
} bench_position;

typedef struct bench_velocity {
    float x, y, z;
} bench_velocity;

typedef struct bench_tag {
    uint32_t value;
} bench_tag;

typedef struct ecs_bench {
    nook_world *world;
    nook_component moving[2]; /* bench_position, bench_velocity */
    nook_component tag;
    nook_query *query;
    nook_entity *entities;
    uint32_t count;
} ecs_bench;

const char *nook_bench_ecs_name(nook_bench_ecs_step step)
{
    static const char *const names[NOOK_BENCH_STEP_COUNT] = { "create", "add",     "iterate",
                                                              "remove", "destroy", "create_many" };
    return names[step];
}

/* ---- the steps ---- */

static nook_result create_each(ecs_bench *b)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < b->count && result == NOOK_OK; i++)
        result = nook_entity_create(b->world, b->moving, 2, 1, &b->entities[i]);
    return result;
}

static nook_result create_many(ecs_bench *b)
{
    return nook_entity_create(b->world, b->moving, 2, b->count, b->entities);
}

static nook_result add_each(ecs_bench *b)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < b->count && result == NOOK_OK; i++)
        result = nook_entity_add(b->world, b->entities[i], b->tag, &(bench_tag){ i });
    return result;
}

static nook_result remove_each(ecs_bench *b)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < b->count && result == NOOK_OK; i++)
        result = nook_entity_remove(b->world, b->entities[i], b->tag);
    return result;
}

static nook_result destroy_each(ecs_bench *b)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < b->count && result == NOOK_OK; i++)
        result = nook_entity_destroy(b->world, b->entities[i]);
    return result;
}

static nook_result iterate(ecs_bench *b)
{
    const float seconds = 1.0f / 60.0f;
    nook_query_walk walk = nook_query_begin(b->world, b->query);
    while (nook_query_next(&walk)) {
        bench_position *restrict position = walk.columns[0];
        const bench_velocity *restrict velocity = walk.columns[1];
        for (uint32_t i = 0; i < walk.count; i++) {
            position[i].x += velocity[i].x * seconds;
            position[i].y += velocity[i].y * seconds;
            position[i].z += velocity[i].z * seconds;
        }
    }
    return NOOK_OK;
}

/* ---- timing ---- */

static nook_result (*const steps[NOOK_BENCH_STEP_COUNT])(ecs_bench *) = {
    [NOOK_BENCH_CREATE] = create_each, [NOOK_BENCH_ADD] = add_each,         [NOOK_BENCH_ITERATE] = iterate,
    [NOOK_BENCH_REMOVE] = remove_each, [NOOK_BENCH_DESTROY] = destroy_each, [NOOK_BENCH_CREATE_MANY] = create_many,
};

/* Leaves the world empty. @param out_ns  per entity, by step */
static nook_result run_round(ecs_bench *b, double *out_ns)
{
    for (int step = 0; step < NOOK_BENCH_STEP_COUNT; step++) {
        double start = nook_clock_ms();
        nook_result result = steps[step](b);
        out_ns[step] = (nook_clock_ms() - start) * 1e6 / b->count;
        if (result != NOOK_OK)
            return result;
    }
    return destroy_each(b);
}

static nook_bench_times summarise(double *values, uint32_t count)
{
    double median = nook_median(values, count); /* leaves them ordered */
    return (nook_bench_times){ .median = median, .lowest = values[0], .highest = values[count - 1] };
}

static nook_result set_up(ecs_bench *b, uint32_t entity_count)
{
    const nook_query_desc desc = { .with = { NOOK_TYPE(bench_position), NOOK_TYPE(bench_velocity) } };
    b->count = entity_count;
    b->entities = malloc(entity_count * sizeof *b->entities);
    if (!b->entities)
        return nook_fail(NOOK_E_MEMORY, "bench: no memory for %u handles", entity_count);
    nook_result result = nook_world_create(NULL, &b->world);
    if (result == NOOK_OK)
        result = nook_world_component(b->world, NOOK_TYPE_OF(bench_position), &b->moving[0]);
    if (result == NOOK_OK)
        result = nook_world_component(b->world, NOOK_TYPE_OF(bench_velocity), &b->moving[1]);
    if (result == NOOK_OK)
        result = nook_world_component(b->world, NOOK_TYPE_OF(bench_tag), &b->tag);
    return result == NOOK_OK ? nook_query_create(b->world, &desc, &b->query) : result;
}

static nook_result run_rounds(ecs_bench *b, uint32_t rounds, double *values)
{
    double ns[NOOK_BENCH_STEP_COUNT];
    nook_result result = run_round(b, ns); /* warms up */
    for (uint32_t round = 0; round < rounds && result == NOOK_OK; round++) {
        result = run_round(b, ns);
        for (uint32_t step = 0; step < NOOK_BENCH_STEP_COUNT; step++)
            values[step * rounds + round] = ns[step];
    }
    return result;
}

nook_result nook_bench_ecs(uint32_t entity_count, uint32_t rounds, nook_bench_times *out_times)
{
    ecs_bench b = { 0 };
    double *values = calloc((size_t)rounds * NOOK_BENCH_STEP_COUNT, sizeof *values);
    nook_result result = values ? set_up(&b, entity_count) : nook_fail(NOOK_E_MEMORY, "bench: no memory for the times");
    if (result == NOOK_OK)
        result = run_rounds(&b, rounds, values);
    for (uint32_t step = 0; step < NOOK_BENCH_STEP_COUNT && result == NOOK_OK; step++)
        out_times[step] = summarise(values + step * rounds, rounds);
    nook_world_destroy(b.world);
    free(b.entities);
    free(values);
    return result;
}
