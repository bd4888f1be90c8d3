#include "engine/ecs/internal.h"
#include <stdlib.h>
#include <string.h>

/* A table's arrays lie in one block, each at a cache line. One spare line between them keeps columns of power-of-two
 * sizes from starting at the same offset of a memory page, where they would compete for the same cache sets. */
static size_t column_stride(uint64_t capacity, uint32_t size)
{
    uint64_t lines = (capacity * size + NOOK_COLUMN_ALIGN - 1) / NOOK_COLUMN_ALIGN;
    return (size_t)((lines + 1) * NOOK_COLUMN_ALIGN);
}

static uint32_t count_bits(const nook_mask *mask)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < NOOK_MASK_BITS; i++)
        count += nook_mask_has(mask, i);
    return count;
}

nook_table *nook_table_create(const nook_type *types, const nook_mask *mask)
{
    uint32_t column_count = count_bits(mask);
    nook_table *table = calloc(1, sizeof *table + column_count * sizeof *table->columns);
    if (!table)
        return NULL;
    table->columns = (nook_column *)(void *)(table + 1);
    table->mask = *mask;
    memset(table->add_to, 0xFF, sizeof table->add_to); /* NOOK_INDEX_NONE */
    memset(table->remove_to, 0xFF, sizeof table->remove_to);
    memset(table->column_of, NOOK_TABLE_NONE, sizeof table->column_of);
    for (uint32_t i = 0; i < NOOK_MASK_BITS; i++) {
        if (!nook_mask_has(mask, i))
            continue;
        table->column_of[i] = (uint8_t)table->column_count;
        table->columns[table->column_count++] = (nook_column){ .size = types[i].size, .component = i };
    }
    return table;
}

void nook_table_destroy(nook_table *table)
{
    free(table->block);
    free(table);
}

static void *move_array(uint8_t *to, const void *from, uint32_t count, uint32_t size)
{
    if (count > 0)
        memcpy(to, from, (size_t)count * size);
    return to;
}

static bool set_capacity(nook_table *table, uint64_t capacity)
{
    size_t total = column_stride(capacity, sizeof(nook_entity));
    for (uint32_t i = 0; i < table->column_count; i++)
        total += column_stride(capacity, table->columns[i].size); /* < 2^32 * 2^16 * 2^8: cannot overflow */
    uint8_t *block = aligned_alloc(NOOK_COLUMN_ALIGN, total);
    if (!block)
        return false;
    uint8_t *at = block;
    table->entities = move_array(at, table->entities, table->count, sizeof(nook_entity));
    at += column_stride(capacity, sizeof(nook_entity));
    for (uint32_t i = 0; i < table->column_count; i++) {
        nook_column *column = &table->columns[i];
        column->bytes = move_array(at, column->bytes, table->count, column->size);
        at += column_stride(capacity, column->size);
    }
    free(table->block);
    table->block = block;
    table->capacity = (uint32_t)capacity;
    return true;
}

bool nook_table_reserve(nook_table *table, uint64_t rows)
{
    if (rows <= table->capacity)
        return true;
    uint64_t capacity = table->capacity ? (uint64_t)table->capacity * 2 : NOOK_FIRST_CAPACITY;
    if (capacity < rows)
        capacity = rows;
    if (capacity > UINT32_MAX)
        capacity = UINT32_MAX;
    return rows <= capacity && set_capacity(table, capacity);
}

void *nook_table_at(const nook_table *table, uint32_t column, uint32_t row)
{
    return table->columns[column].bytes + (size_t)row * table->columns[column].size;
}

/* Constant sizes become a few moves; a call to memcpy per element is what a change of table would mostly cost. */
static inline void copy_element(uint8_t *to, const uint8_t *from, uint32_t size)
{
    switch (size) {
    case 4:
        memcpy(to, from, 4);
        break;
    case 8:
        memcpy(to, from, 8);
        break;
    case 12:
        memcpy(to, from, 12);
        break;
    case 16:
        memcpy(to, from, 16);
        break;
    case 128: /* nook_transform */
        memcpy(to, from, 128);
        break;
    default:
        memcpy(to, from, size);
        break;
    }
}

void nook_table_write(nook_table *table, uint32_t column, uint32_t row, const void *value)
{
    uint8_t *to = nook_table_at(table, column, row);
    if (value)
        copy_element(to, value, table->columns[column].size);
    else
        memset(to, 0, table->columns[column].size);
}

void nook_table_copy_row(nook_table *to, uint32_t to_row, const nook_table *from, uint32_t from_row)
{
    for (uint32_t i = 0; i < to->column_count; i++) {
        uint8_t source = from->column_of[to->columns[i].component];
        if (source != NOOK_TABLE_NONE)
            copy_element(nook_table_at(to, i, to_row), nook_table_at(from, source, from_row), to->columns[i].size);
    }
}

nook_entity nook_table_remove_row(nook_table *table, uint32_t row)
{
    assert(row < table->count);
    uint32_t last = --table->count;
    if (row == last)
        return (nook_entity){ 0 };
    for (uint32_t i = 0; i < table->column_count; i++)
        copy_element(nook_table_at(table, i, row), nook_table_at(table, i, last), table->columns[i].size);
    table->entities[row] = table->entities[last];
    return table->entities[row];
}
