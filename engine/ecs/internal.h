/** internal.h - what the files of engine/ecs share. Nobody else includes it. */
#pragma once
#include "engine/ecs/system.h"
#include <assert.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NOOK_MASK_BITS = 256,        /* component ids 1..255; 0 is none */
    NOOK_TABLE_NONE = UINT8_MAX, /* column_of: the table lacks it */
    NOOK_FIRST_CAPACITY = 16
};
#define NOOK_INDEX_NONE UINT32_MAX          /* no table, no edge yet, end of the free list */
#define NOOK_TABLE_PENDING (UINT32_MAX - 1) /* made by a command that has not been carried out */

/* ---- masks: which component types ---- */

typedef struct nook_mask {
    uint64_t words[NOOK_MASK_BITS / 64];
} nook_mask;

static inline void nook_mask_set(nook_mask *mask, uint32_t bit)
{
    mask->words[bit / 64] |= (uint64_t)1 << (bit % 64);
}

static inline void nook_mask_clear(nook_mask *mask, uint32_t bit)
{
    mask->words[bit / 64] &= ~((uint64_t)1 << (bit % 64));
}

static inline bool nook_mask_has(const nook_mask *mask, uint32_t bit)
{
    return (mask->words[bit / 64] >> (bit % 64)) & 1;
}

static inline bool nook_mask_contains(const nook_mask *mask, const nook_mask *part)
{
    for (int i = 0; i < NOOK_MASK_BITS / 64; i++) {
        if (part->words[i] & ~mask->words[i])
            return false;
    }
    return true;
}

static inline bool nook_mask_overlaps(const nook_mask *a, const nook_mask *b)
{
    for (int i = 0; i < NOOK_MASK_BITS / 64; i++) {
        if (a->words[i] & b->words[i])
            return true;
    }
    return false;
}

/* ---- tables ---- */

typedef struct nook_column {
    uint8_t *bytes; /* capacity elements, aligned to NOOK_COLUMN_ALIGN */
    uint32_t size;  /* of one element */
    uint32_t component;
} nook_column;

/* All entities with one set of components. Columns stand in the order of component ids. */
typedef struct nook_table {
    nook_mask mask;
    uint32_t index;           /* in world->tables */
    uint32_t count, capacity; /* rows */
    void *block;              /* the one allocation under entities and columns */
    nook_entity *entities;
    uint32_t add_to[NOOK_MASK_BITS];    /* the table with this component more, NOOK_INDEX_NONE until first asked */
    uint32_t remove_to[NOOK_MASK_BITS]; /* ... less */
    uint8_t column_of[NOOK_MASK_BITS];  /* by component id, or NOOK_TABLE_NONE */
    uint32_t column_count;
    nook_column *columns; /* behind this struct, in the same allocation */
} nook_table;

/* Where an entity is. On the free list: table NOOK_INDEX_NONE and row the next free index. */
typedef struct nook_entity_record {
    uint32_t generation; /* from 1 */
    uint32_t table;
    uint32_t row;
} nook_entity_record;

/* ---- queries, systems, commands ---- */

typedef struct nook_query_match {
    nook_table *table;
    uint8_t columns[NOOK_QUERY_TERMS_MAX]; /* by term, in the table */
} nook_query_match;

struct nook_query {
    nook_mask with, without;
    nook_component terms[NOOK_QUERY_TERMS_MAX];
    uint32_t term_count;
    nook_query_match *matches;
    uint32_t match_count, match_capacity;
};

typedef struct nook_system_entry {
    nook_system system;
    nook_query *query; /* NULL without components */
    uint32_t read_count;
    nook_mask reads, writes, changes;
    uint64_t resources_read, resources_written; /* bits by resource index */
    nook_component change_ids[NOOK_MAX_ACCESS];
    void *resources[2 * NOOK_MAX_ACCESS];
    uint32_t batch;
} nook_system_entry;

struct nook_commands {
    nook_world *world;
    const nook_mask *allowed; /* what the running system said it changes */
    uint8_t *bytes;
    size_t size, capacity;
    bool out_of_memory;
};

/* A stretch of rows, or a whole system, for one worker. */
typedef struct nook_work_item {
    const nook_system_entry *entry;
    uint32_t match, first, count; /* match NOOK_INDEX_NONE: all tables, in order */
} nook_work_item;

typedef struct nook_resource {
    nook_type type; /* name owned */
    void *data;
} nook_resource;

struct nook_world {
    nook_world_desc desc;
    nook_type types[NOOK_MASK_BITS]; /* by component id; names owned; 0 unused */
    uint32_t type_count;             /* with the unused one */
    nook_resource resources[NOOK_RESOURCES_MAX];
    uint32_t resource_count;

    nook_entity_record *records;
    uint32_t record_count, record_capacity;
    uint32_t first_free; /* index, or NOOK_INDEX_NONE */
    uint32_t alive_count;

    nook_table **tables; /* 0 is that of no components */
    uint32_t table_count, table_capacity;
    uint32_t *table_slots; /* open addressing by mask, NOOK_INDEX_NONE = free; a power of two, at most half full */
    uint32_t slot_count;

    nook_query **queries;
    uint32_t query_count, query_capacity;
    nook_system_entry **systems;
    uint32_t system_count, system_capacity;
    nook_commands commands;
    nook_work_item *items; /* kept between frames: no allocation once it is large enough */
    uint32_t item_capacity;
    uint32_t locks; /* walks and systems under way: structure must not change */
};

/* world.c */
/* The array with room for `needed` (>= 1) elements of `size` bytes, doubling. @return NULL without memory; the old one
 * stands then */
void *nook_ecs_grow(void *array, uint32_t *capacity, uint64_t needed, size_t size);
uint32_t nook_world_resource_index(const nook_world *world, const char *name); /* or NOOK_INDEX_NONE */
/* Registers the types of a list. @param out_count NULL is allowed */
nook_result nook_world_components(nook_world *world, const nook_type *types, uint32_t capacity,
                                  nook_component *out_components, uint32_t *out_count);

/* table.c */
nook_table *nook_table_create(const nook_type *types, const nook_mask *mask);
void nook_table_destroy(nook_table *table);
bool nook_table_reserve(nook_table *table, uint64_t rows);
void *nook_table_at(const nook_table *table, uint32_t column, uint32_t row);
void nook_table_write(nook_table *table, uint32_t column, uint32_t row, const void *value); /* NULL: zeroes */
/* Copies what both tables have. */
void nook_table_copy_row(nook_table *to, uint32_t to_row, const nook_table *from, uint32_t from_row);
/* Fills the gap with the last row. @return the entity that now stands in `row`, or id 0 when it was the last */
nook_entity nook_table_remove_row(nook_table *table, uint32_t row);

/* archetype.c: which table holds which set. @return NULL without memory */
nook_table *nook_archetype_find(nook_world *world, const nook_mask *mask);
nook_table *nook_archetype_with(nook_world *world, nook_table *table, uint32_t component);
nook_table *nook_archetype_without(nook_world *world, nook_table *table, uint32_t component);

/* entity.c */
uint32_t nook_entity_index(nook_entity entity);
/* In a table or pending; NULL when stale. */
nook_entity_record *nook_entity_record_of(const nook_world *world, nook_entity entity);
nook_entity nook_entity_reserve(nook_world *world);              /* pending, in no table; id 0 without memory */
void nook_entity_release(nook_world *world, nook_entity entity); /* the id only, not the row */
void nook_entity_take_row(nook_world *world, nook_table *table, uint32_t row); /* removes it and mends the moved one */
/* Columns that the old table lacks are left unwritten. Takes pending entities too. */
bool nook_entity_move(nook_world *world, nook_entity entity, nook_table *to);

/* query.c */
bool nook_query_reserve_match(nook_world *world); /* so that the next cannot fail */
void nook_query_table_added(nook_world *world, nook_table *table);
nook_result nook_query_make(nook_world *world, const nook_component *with, uint32_t with_count,
                            const nook_component *without, uint32_t without_count, nook_query **out_query);
void nook_query_free(nook_query *query);
void nook_query_remove(nook_world *world, nook_query *query); /* of the world's, and frees it; NULL is allowed */

/* command_buffer.c */
nook_result nook_commands_apply(nook_commands *commands);

#ifdef __cplusplus
}
#endif
