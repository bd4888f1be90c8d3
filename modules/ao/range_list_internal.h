/**
 * range_list_internal.h - which places of a growing row are taken.
 */
#pragma once
#include <stdint.h>

typedef struct range {
    uint32_t first, count;
} range;

/** Starts as zero: a row of no places. */
typedef struct range_list {
    range *free; /**< In order, none touching the next. Owned. */
    uint32_t count, capacity;
    uint32_t end; /**< Places that there are, free or taken. */
} range_list;

void range_list_release(range_list *list);
/**
 * Takes `count` places, the first that do, else new ones at the end.
 * @param most  that the row may have
 * @return UINT32_MAX when they do not fit, or there is no memory
 */
uint32_t range_list_take(range_list *list, uint32_t count, uint32_t most);
/** Gives back what was taken; free places at the end go. Without memory they are lost until the list is released, nothing else. */
void range_list_give(range_list *list, range taken);
