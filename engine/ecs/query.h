#pragma once
#include "engine/ecs/world.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NOOK_MAX_ACCESS = 8, /**< Types in one list of a system or query. */
    NOOK_QUERY_TERMS_MAX = 2 * NOOK_MAX_ACCESS
};

/** A question kept ready: the tables that match are remembered, and new ones are added as they appear. */
typedef struct nook_query nook_query;

typedef struct nook_query_desc {
    nook_type
        with[NOOK_QUERY_TERMS_MAX]; /**< Up to the first empty entry: entities that have them all. None: everyone. */
    nook_type without[NOOK_MAX_ACCESS]; /**< Entities that have none of these. */
} nook_query_desc;

/**
 * The world owns the query and frees it at its end; make it once, not every frame.
 * @return NOOK_E_VERSION, NOOK_E_MEMORY
 */
nook_result nook_query_create(nook_world *world, const nook_query_desc *desc, nook_query **out_query);

/** A walk over the tables that match. */
typedef struct nook_query_walk {
    uint32_t count;                      /**< Rows of this table, at least 1. */
    const nook_entity *entities;         /**< count of them. */
    void *columns[NOOK_QUERY_TERMS_MAX]; /**< Arrays of `count`, in the order of desc.with. */
    nook_world *world;                   /**< Private from here on. */
    const nook_query *query;
    uint32_t next;
} nook_query_walk;

/** Starts a walk; nothing structural may change until it ended. Walks may be nested. */
nook_query_walk nook_query_begin(nook_world *world, const nook_query *query);
/** @return false after the last table; the walk has ended then */
bool nook_query_next(nook_query_walk *walk);
/** Ends a walk early. Needed only when it is left before nook_query_next gave false. */
void nook_query_end(nook_query_walk *walk);

/** Entities that match now. */
uint64_t nook_query_count(const nook_query *query);

#ifdef __cplusplus
}
#endif
