/** counter.h - the state of the module in counter.inl, and what it is given. */
#pragma once
#include <stddef.h>
#include <stdint.h>

typedef struct counter_arguments {
    int32_t start;  /**< Value of a state that is made anew. */
    int32_t *alive; /**< Counts the creates. */
} counter_arguments;

/** The state points to it. */
typedef struct counter_heap {
#ifdef COUNTER_INNER_GROWN
    double more;
#endif
    uint32_t frames;
} counter_heap;

/** As it was in version 1. */
typedef struct counter_state_1 {
    int32_t value;
    uint32_t suspended, resumed;
    counter_heap *heap; /**< Owned. */
} counter_state_1;

#ifdef COUNTER_GROWN
typedef struct counter_state {
    double more;
    int32_t value;
    uint32_t suspended, resumed;
    counter_heap *heap;
} counter_state;
#else
typedef struct counter_state {
    int32_t value;
    uint32_t suspended, resumed;
    counter_heap *heap;
} counter_state;
#endif

/** What parts of kind "test.adder" lend. */
typedef struct counter_adder {
    int32_t (*add)(int32_t value);
} counter_adder;

#ifdef NOOK_SHARED_NOTE /* a type of both, as headers of different days have it */
typedef struct nook_shared_note {
    NOOK_SHARED_NOTE note;
} nook_shared_note;
static const nook_shared_note counter_note = { 1 };
#endif
