#include "engine/module/type_hash_internal.h"
#include <string.h>

enum { DEPTH_MAX = 64 /* of types in types: only damaged files go deeper */ };

static uint64_t mix_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * 0x100000001B3u; /* FNV-1a */
    return hash;
}

static uint64_t mix_number(uint64_t hash, uint64_t number)
{
    return mix_bytes(hash, &number, sizeof number);
}

static uint64_t mix_text(uint64_t hash, const char *text)
{
    return mix_bytes(hash, text, strlen(text) + 1);
}

/* What a type is called changes nothing. */
static bool is_another_name(uint32_t tag)
{
    return tag == DWARF_TAG_TYPEDEF || tag == DWARF_TAG_CONST || tag == DWARF_TAG_VOLATILE ||
           tag == DWARF_TAG_RESTRICT || tag == DWARF_TAG_ATOMIC;
}

/* @return tag 0 for void */
static nook_dwarf_entry type_behind(const nook_dwarf_unit *unit, size_t place)
{
    nook_dwarf_entry type = { .name = "" };
    for (int depth = 0; depth < DEPTH_MAX && place != 0; depth++) {
        type = nook_dwarf_entry_read(unit, place);
        if (!is_another_name(type.tag))
            return type;
        place = type.type;
    }
    return (nook_dwarf_entry){ .name = "" };
}

static uint64_t mix_reference(const nook_dwarf_unit *unit, uint64_t hash, size_t place, int depth);

/* Result, then parameters; of a function's own entry, among whose children its variables are. */
static uint64_t mix_signature(const nook_dwarf_unit *unit, uint64_t hash, const nook_dwarf_entry *function, int depth)
{
    hash = mix_reference(unit, hash, function->type, depth);
    if (!function->has_children)
        return hash;
    for (size_t place = function->next; place < unit->bytes.size;) {
        nook_dwarf_entry child = nook_dwarf_entry_read(unit, place);
        if (child.tag == 0)
            break;
        if (child.tag == DWARF_TAG_PARAMETER)
            hash = mix_reference(unit, mix_number(hash, child.tag), child.type, depth);
        else if (child.tag == DWARF_TAG_ANY_PARAMETERS)
            hash = mix_number(hash, child.tag);
        place = nook_dwarf_skip(unit, &child);
    }
    return hash;
}

/* A type as those see it who only pass it on: by its name, where it has one. */
static uint64_t mix_reference(const nook_dwarf_unit *unit, uint64_t hash, size_t place, int depth)
{
    nook_dwarf_entry type = type_behind(unit, place);
    hash = mix_number(hash, type.tag);
    if (depth >= DEPTH_MAX)
        return hash;
    switch (type.tag) {
    case DWARF_TAG_BASE:
        return mix_number(mix_number(hash, type.encoding), type.byte_size);
    case DWARF_TAG_POINTER:
    case DWARF_TAG_ARRAY:
        return mix_reference(unit, hash, type.type, depth + 1);
    case DWARF_TAG_FUNCTION_TYPE:
        return mix_signature(unit, hash, &type, depth + 1);
    default:
        return mix_text(hash, type.name);
    }
}

static uint64_t mix_layout(const nook_dwarf_unit *unit, uint64_t hash, size_t place, int depth);

/* A member, an enumerator, or the length of an array. */
static uint64_t mix_child(const nook_dwarf_unit *unit, uint64_t hash, const nook_dwarf_entry *child, int depth)
{
    switch (child->tag) {
    case DWARF_TAG_MEMBER:
        hash = mix_number(mix_text(hash, child->name), child->offset);
        hash = mix_number(mix_number(hash, child->bit_offset), child->bit_size);
        return mix_layout(unit, hash, child->type, depth);
    case DWARF_TAG_ENUMERATOR:
        return mix_number(mix_text(hash, child->name), child->value);
    case DWARF_TAG_RANGE:
        return mix_number(mix_number(hash, child->upper_bound), child->count);
    default:
        return hash;
    }
}

static uint64_t mix_children(const nook_dwarf_unit *unit, uint64_t hash, const nook_dwarf_entry *type, int depth)
{
    for (size_t place = type->next; type->has_children && place < unit->bytes.size;) {
        nook_dwarf_entry child = nook_dwarf_entry_read(unit, place);
        if (child.tag == 0)
            break;
        hash = mix_child(unit, hash, &child, depth);
        place = nook_dwarf_skip(unit, &child);
    }
    return hash;
}

/* A type as it lies in memory. */
static uint64_t mix_layout(const nook_dwarf_unit *unit, uint64_t hash, size_t place, int depth)
{
    nook_dwarf_entry type = type_behind(unit, place);
    hash = mix_number(mix_number(hash, type.tag), type.byte_size);
    if (depth >= DEPTH_MAX)
        return hash;
    switch (type.tag) {
    case DWARF_TAG_BASE:
        return mix_number(hash, type.encoding);
    case DWARF_TAG_POINTER:
        return mix_reference(unit, hash, type.type, depth + 1);
    case DWARF_TAG_ARRAY:
        return mix_children(unit, mix_layout(unit, hash, type.type, depth + 1), &type, depth + 1);
    case DWARF_TAG_STRUCT:
    case DWARF_TAG_UNION:
    case DWARF_TAG_ENUMERATION:
        return mix_children(unit, hash, &type, depth + 1);
    default:
        return hash;
    }
}

static const uint64_t start = 0xCBF29CE484222325u;

uint64_t nook_type_hash(const nook_dwarf_unit *unit, size_t place)
{
    return mix_layout(unit, start, place, 0);
}

uint64_t nook_function_hash(const nook_dwarf_unit *unit, const nook_dwarf_entry *function)
{
    return mix_signature(unit, start, function, 0);
}
