#include "engine/core/log.h"
#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

/* ---- matching ---- */

static bool reserve_matches(nook_query *query, uint64_t count)
{
    if (count == 0)
        return true;
    nook_query_match *matches = nook_ecs_grow(query->matches, &query->match_capacity, count, sizeof *matches);
    if (matches)
        query->matches = matches;
    return matches != NULL;
}

bool nook_query_reserve_match(nook_world *world)
{
    for (uint32_t i = 0; i < world->query_count; i++) {
        if (!reserve_matches(world->queries[i], (uint64_t)world->queries[i]->match_count + 1))
            return false;
    }
    return true;
}

/* After memory for one match is reserved. */
static void match_table(nook_query *query, nook_table *table)
{
    if (!nook_mask_contains(&table->mask, &query->with) || nook_mask_overlaps(&table->mask, &query->without))
        return;
    nook_query_match *match = &query->matches[query->match_count++];
    *match = (nook_query_match){ .table = table };
    for (uint32_t i = 0; i < query->term_count; i++)
        match->columns[i] = table->column_of[query->terms[i].id];
}

void nook_query_table_added(nook_world *world, nook_table *table)
{
    for (uint32_t i = 0; i < world->query_count; i++)
        match_table(world->queries[i], table);
}

/* ---- life ---- */

static void set_terms(nook_query *query, const nook_component *with, uint32_t with_count, const nook_component *without,
                      uint32_t without_count)
{
    query->term_count = with_count;
    for (uint32_t i = 0; i < with_count; i++) {
        assert(!nook_mask_has(&query->with, with[i].id) && "the same component twice");
        nook_mask_set(&query->with, with[i].id);
        query->terms[i] = with[i];
    }
    for (uint32_t i = 0; i < without_count; i++)
        nook_mask_set(&query->without, without[i].id);
    assert(!nook_mask_overlaps(&query->with, &query->without) && "with and without the same component");
}

nook_result nook_query_make(nook_world *world, const nook_component *with, uint32_t with_count,
                            const nook_component *without, uint32_t without_count, nook_query **out_query)
{
    nook_query **queries =
        nook_ecs_grow(world->queries, &world->query_capacity, (uint64_t)world->query_count + 1, sizeof(nook_query *));
    if (!queries)
        return nook_fail(NOOK_E_MEMORY, "query: no memory for one more besides %u", world->query_count);
    world->queries = queries;
    nook_query *query = calloc(1, sizeof *query);
    if (!query || !reserve_matches(query, world->table_count)) {
        nook_query_free(query);
        return nook_fail(NOOK_E_MEMORY, "query: no memory to match %u tables", world->table_count);
    }
    set_terms(query, with, with_count, without, without_count);
    for (uint32_t i = 0; i < world->table_count; i++)
        match_table(query, world->tables[i]);
    world->queries[world->query_count++] = query;
    *out_query = query;
    return NOOK_OK;
}

nook_result nook_query_create(nook_world *world, const nook_query_desc *desc, nook_query **out_query)
{
    nook_component with[NOOK_QUERY_TERMS_MAX], without[NOOK_MAX_ACCESS];
    uint32_t with_count = 0, without_count = 0;
    nook_result result = nook_world_components(world, desc->with, NOOK_QUERY_TERMS_MAX, with, &with_count);
    if (result == NOOK_OK)
        result = nook_world_components(world, desc->without, NOOK_MAX_ACCESS, without, &without_count);
    if (result == NOOK_OK)
        result = nook_query_make(world, with, with_count, without, without_count, out_query);
    return result;
}

void nook_query_free(nook_query *query)
{
    if (!query)
        return;
    free(query->matches);
    free(query);
}

void nook_query_remove(nook_world *world, nook_query *query)
{
    for (uint32_t i = 0; i < world->query_count; i++) {
        if (world->queries[i] == query)
            world->queries[i] = world->queries[--world->query_count];
    }
    nook_query_free(query);
}

/* ---- walking ---- */

nook_query_walk nook_query_begin(nook_world *world, const nook_query *query)
{
    world->locks++;
    return (nook_query_walk){ .world = world, .query = query };
}

bool nook_query_next(nook_query_walk *walk)
{
    assert(walk->world && "the walk has ended");
    const nook_query *query = walk->query;
    while (walk->next < query->match_count) {
        const nook_query_match *match = &query->matches[walk->next++];
        if (match->table->count == 0)
            continue;
        walk->count = match->table->count;
        walk->entities = match->table->entities;
        for (uint32_t i = 0; i < query->term_count; i++)
            walk->columns[i] = match->table->columns[match->columns[i]].bytes;
        return true;
    }
    nook_query_end(walk);
    return false;
}

void nook_query_end(nook_query_walk *walk)
{
    assert(walk->world && walk->world->locks > 0 && "the walk has ended");
    walk->world->locks--;
    walk->world = NULL;
    walk->count = 0;
}

uint64_t nook_query_count(const nook_query *query)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < query->match_count; i++)
        count += query->matches[i].table->count;
    return count;
}
