#pragma once
#include "engine/core/result.h"
#include <stdint.h>

enum { NOOK_BENCH_ROUNDS_MAX = 1000 };

/** What is timed, in the order in which it happens. */
typedef enum nook_bench_ecs_step {
    NOOK_BENCH_CREATE,      /**< Entities with two components, one call each. */
    NOOK_BENCH_ADD,         /**< A third component, one call each. */
    NOOK_BENCH_ITERATE,     /**< position += velocity * time: a query over two components, on one thread. */
    NOOK_BENCH_REMOVE,      /**< The third component, one call each. */
    NOOK_BENCH_DESTROY,     /**< One call each, in the order of their making. */
    NOOK_BENCH_CREATE_MANY, /**< As NOOK_BENCH_CREATE, in one call. */
    NOOK_BENCH_STEP_COUNT
} nook_bench_ecs_step;

/** Nanoseconds per entity. */
typedef struct nook_bench_times {
    double median, lowest, highest;
} nook_bench_times;

/** "create", "add", ... */
const char *nook_bench_ecs_name(nook_bench_ecs_step step);

/**
 * Times all steps. One round before the counted ones touches all memory, so that what is measured is the world at work and
 * not the system handing out pages.
 * @param rounds     [1, NOOK_BENCH_ROUNDS_MAX]
 * @param out_times  NOOK_BENCH_STEP_COUNT of them, over the rounds
 * @return NOOK_E_MEMORY
 */
nook_result nook_bench_ecs(uint32_t entity_count, uint32_t rounds, nook_bench_times *out_times);
