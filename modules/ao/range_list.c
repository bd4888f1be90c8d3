#include "modules/ao/range_list_internal.h"
#include <stdlib.h>
#include <string.h>

void range_list_release(range_list *list)
{
    free(list->free);
    *list = (range_list){ 0 };
}

static void drop(range_list *list, uint32_t index)
{
    list->count--;
    memmove(list->free + index, list->free + index + 1, (list->count - index) * sizeof *list->free);
}

static uint32_t take_free(range_list *list, uint32_t count)
{
    for (uint32_t i = 0; i < list->count; i++) {
        range *place = &list->free[i];
        if (place->count < count)
            continue;
        uint32_t first = place->first;
        place->first += count;
        place->count -= count;
        if (place->count == 0)
            drop(list, i);
        return first;
    }
    return UINT32_MAX;
}

uint32_t range_list_take(range_list *list, uint32_t count, uint32_t most)
{
    if (count == 0)
        return 0;
    uint32_t first = take_free(list, count);
    if (first != UINT32_MAX || count > most || list->end > most - count)
        return first;
    first = list->end;
    list->end += count;
    return first;
}

/* The first free range behind a place. */
static uint32_t find_behind(const range_list *list, uint32_t place)
{
    uint32_t i = 0;
    while (i < list->count && list->free[i].first < place)
        i++;
    return i;
}

static int insert(range_list *list, uint32_t index, range place)
{
    if (list->count == list->capacity) {
        uint32_t capacity = list->capacity ? list->capacity * 2 : 16;
        range *grown = realloc(list->free, capacity * sizeof *grown);
        if (!grown)
            return 0;
        list->free = grown;
        list->capacity = capacity;
    }
    memmove(list->free + index + 1, list->free + index, (list->count - index) * sizeof *list->free);
    list->free[index] = place;
    list->count++;
    return 1;
}

void range_list_give(range_list *list, range taken)
{
    if (taken.count == 0)
        return;
    uint32_t i = find_behind(list, taken.first);
    if (i < list->count && taken.first + taken.count == list->free[i].first) {
        taken.count += list->free[i].count;
        drop(list, i);
    }
    if (i > 0 && list->free[i - 1].first + list->free[i - 1].count == taken.first) {
        taken.first = list->free[i - 1].first;
        taken.count += list->free[i - 1].count;
        drop(list, --i);
    }
    if (taken.first + taken.count == list->end)
        list->end = taken.first;
    else
        insert(list, i, taken);
}
