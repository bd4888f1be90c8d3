/* "DWARF Debugging Information Format Version 5", 2017: chapter 7 has the bytes. */
#include "engine/core/log.h"
#include "engine/module/dwarf_internal.h"
#include <stdlib.h>
#include <string.h>

enum { ABBREVIATIONS_MAX = 1 << 16 };

enum {
    AT_SIBLING = 0x01,
    AT_NAME = 0x03,
    AT_BYTE_SIZE = 0x0b,
    AT_BIT_SIZE = 0x0d,
    AT_CONST_VALUE = 0x1c,
    AT_UPPER_BOUND = 0x2f,
    AT_COUNT = 0x37,
    AT_DATA_MEMBER_LOCATION = 0x38,
    AT_DECLARATION = 0x3c,
    AT_ENCODING = 0x3e,
    AT_EXTERNAL = 0x3f,
    AT_TYPE = 0x49,
    AT_DATA_BIT_OFFSET = 0x6b,
    AT_STR_OFFSETS_BASE = 0x72
};

enum {
    FORM_ADDR = 0x01,
    FORM_BLOCK2 = 0x03,
    FORM_BLOCK4,
    FORM_DATA2,
    FORM_DATA4,
    FORM_DATA8,
    FORM_STRING,
    FORM_BLOCK,
    FORM_BLOCK1,
    FORM_DATA1,
    FORM_FLAG,
    FORM_SDATA,
    FORM_STRP,
    FORM_UDATA,
    FORM_REF_ADDR,
    FORM_REF1,
    FORM_REF2,
    FORM_REF4,
    FORM_REF8,
    FORM_REF_UDATA,
    FORM_SEC_OFFSET = 0x17,
    FORM_EXPRLOC,
    FORM_FLAG_PRESENT,
    FORM_STRX,
    FORM_ADDRX,
    FORM_DATA16 = 0x1e,
    FORM_LINE_STRP,
    FORM_REF_SIG8,
    FORM_IMPLICIT_CONST,
    FORM_LOCLISTX,
    FORM_RNGLISTX,
    FORM_STRX1 = 0x25,
    FORM_STRX2,
    FORM_STRX3,
    FORM_STRX4,
    FORM_ADDRX1,
    FORM_ADDRX2,
    FORM_ADDRX3,
    FORM_ADDRX4
};

struct nook_dwarf_abbreviation {
    uint32_t tag;
    bool has_children;
    size_t attributes; /* offset into .debug_abbrev; 0: no such code */
};

/* ---- bytes ---- */

/* Reads on; behind the end there are zeroes. */
typedef struct cursor {
    nook_section bytes;
    size_t at;
    bool failed;
} cursor;

static uint64_t read_number(cursor *c, size_t size)
{
    uint64_t value = 0;
    if (c->at > c->bytes.size || size > c->bytes.size - c->at) {
        c->failed = true;
        c->at = c->bytes.size;
        return 0;
    }
    for (size_t i = 0; i < size && i < 8; i++)
        value |= (uint64_t)c->bytes.bytes[c->at + i] << (8 * i);
    c->at += size;
    return value;
}

static void skip_bytes(cursor *c, uint64_t size)
{
    c->failed = c->failed || c->at > c->bytes.size || size > c->bytes.size - c->at;
    c->at = c->failed ? c->bytes.size : c->at + (size_t)size;
}

static inline uint64_t read_leb(cursor *c, bool is_signed)
{
    if (!is_signed && c->at < c->bytes.size && c->bytes.bytes[c->at] < 0x80)
        return c->bytes.bytes[c->at++]; /* most are of one byte, and most of the time goes here */
    uint64_t value = 0;
    uint8_t byte = 0x80;
    unsigned shift = 0;
    while ((byte & 0x80) && !c->failed) {
        byte = (uint8_t)read_number(c, 1);
        if (shift < 64)
            value |= (uint64_t)(byte & 0x7f) << shift;
        shift += 7;
    }
    if (is_signed && shift < 64 && (byte & 0x40))
        value |= ~(uint64_t)0 << shift;
    return value;
}

/* A text of a section of texts: it ends there, or at the zero that follows the file. */
static const char *text_at(nook_section section, uint64_t offset)
{
    return offset < section.size ? (const char *)section.bytes + offset : "";
}

/* ---- values of attributes ---- */

typedef struct dwarf_value {
    uint64_t number;
    const char *text; /* NULL: it is no text */
    bool is_place;    /* counted from the start of the unit */
} dwarf_value;

static const char *indexed_text(const nook_dwarf_unit *unit, uint64_t index)
{
    cursor c = { .bytes = unit->sections->str_offsets };
    skip_bytes(&c, unit->str_offsets_base);
    if (index > c.bytes.size)
        return "";
    skip_bytes(&c, index * unit->offset_size);
    return text_at(unit->sections->str, read_number(&c, unit->offset_size));
}

static dwarf_value read_text_form(const nook_dwarf_unit *unit, uint64_t form, cursor *c)
{
    switch (form) {
    case FORM_STRP:
        return (dwarf_value){ .text = text_at(unit->sections->str, read_number(c, unit->offset_size)) };
    case FORM_LINE_STRP:
        return (dwarf_value){ .text = text_at(unit->sections->line_str, read_number(c, unit->offset_size)) };
    case FORM_STRX:
        return (dwarf_value){ .text = indexed_text(unit, read_leb(c, false)) };
    case FORM_STRING: {
        const char *text = text_at(c->bytes, c->at);
        skip_bytes(c, strlen(text) + 1);
        return (dwarf_value){ .text = text };
    }
    default: /* FORM_STRX1 to FORM_STRX4 */
        return (dwarf_value){ .text = indexed_text(unit, read_number(c, form - FORM_STRX1 + 1)) };
    }
}

static dwarf_value read_block_form(uint64_t form, cursor *c)
{
    uint64_t size = form == FORM_BLOCK1   ? read_number(c, 1)
                    : form == FORM_BLOCK2 ? read_number(c, 2)
                    : form == FORM_BLOCK4 ? read_number(c, 4)
                                          : read_leb(c, false);
    skip_bytes(c, size);
    return (dwarf_value){ 0 };
}

/* Bytes of a number; 0: of no size that the form alone tells. */
static size_t number_size(const nook_dwarf_unit *unit, uint64_t form)
{
    switch (form) {
    case FORM_DATA1:
    case FORM_FLAG:
    case FORM_REF1:
    case FORM_ADDRX1:
        return 1;
    case FORM_DATA2:
    case FORM_REF2:
    case FORM_ADDRX2:
        return 2;
    case FORM_ADDRX3:
        return 3;
    case FORM_DATA4:
    case FORM_REF4:
    case FORM_ADDRX4:
        return 4;
    case FORM_DATA8:
    case FORM_REF8:
    case FORM_REF_SIG8:
        return 8;
    case FORM_DATA16:
        return 16;
    case FORM_ADDR:
        return unit->address_size;
    case FORM_SEC_OFFSET:
    case FORM_REF_ADDR:
        return unit->offset_size;
    default:
        return 0;
    }
}

static dwarf_value read_value(const nook_dwarf_unit *unit, uint64_t form, uint64_t constant, cursor *c)
{
    size_t size = number_size(unit, form);
    if (size > 0)
        return (dwarf_value){ .number = read_number(c, size), .is_place = form >= FORM_REF1 && form <= FORM_REF8 };
    switch (form) {
    case FORM_FLAG_PRESENT:
        return (dwarf_value){ .number = 1 };
    case FORM_IMPLICIT_CONST:
        return (dwarf_value){ .number = constant };
    case FORM_SDATA:
        return (dwarf_value){ .number = read_leb(c, true) };
    case FORM_UDATA:
    case FORM_REF_UDATA:
    case FORM_ADDRX:
    case FORM_LOCLISTX:
    case FORM_RNGLISTX:
        return (dwarf_value){ .number = read_leb(c, false), .is_place = form == FORM_REF_UDATA };
    case FORM_BLOCK:
    case FORM_BLOCK1:
    case FORM_BLOCK2:
    case FORM_BLOCK4:
    case FORM_EXPRLOC:
        return read_block_form(form, c);
    case FORM_STRP:
    case FORM_LINE_STRP:
    case FORM_STRING:
    case FORM_STRX:
    case FORM_STRX1:
    case FORM_STRX2:
    case FORM_STRX3:
    case FORM_STRX4:
        return read_text_form(unit, form, c);
    default:
        c->failed = true; /* of unknown size: what follows cannot be found */
        return (dwarf_value){ 0 };
    }
}

/* ---- units ---- */

static bool reserve_abbreviation(nook_dwarf_unit *unit, size_t code)
{
    if (code >= unit->abbreviation_capacity) {
        size_t capacity = unit->abbreviation_capacity ? unit->abbreviation_capacity : 256;
        while (capacity <= code)
            capacity *= 2;
        nook_dwarf_abbreviation *grown = realloc(unit->abbreviations, capacity * sizeof *grown);
        if (!grown)
            return false;
        unit->abbreviations = grown;
        unit->abbreviation_capacity = capacity;
    }
    for (; unit->abbreviation_count <= code; unit->abbreviation_count++)
        unit->abbreviations[unit->abbreviation_count] = (nook_dwarf_abbreviation){ 0 };
    return true;
}

/* Of an attribute as an abbreviation lists it. @return false: the list ends here */
static bool read_attribute(cursor *c, uint64_t *out_name, uint64_t *out_form, uint64_t *out_constant)
{
    *out_name = read_leb(c, false);
    *out_form = read_leb(c, false);
    *out_constant = *out_form == FORM_IMPLICIT_CONST ? read_leb(c, true) : 0;
    return !c->failed && (*out_name != 0 || *out_form != 0);
}

static nook_result read_abbreviations(const char *path, nook_dwarf_unit *unit, uint64_t offset)
{
    cursor c = { .bytes = unit->sections->abbrev };
    uint64_t name, form, constant;
    skip_bytes(&c, offset);
    unit->abbreviation_count = 0;
    for (uint64_t code = read_leb(&c, false); code != 0 && !c.failed; code = read_leb(&c, false)) {
        if (code >= ABBREVIATIONS_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: its debug information is damaged; build it again", path);
        if (!reserve_abbreviation(unit, (size_t)code))
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for its debug information", path);
        nook_dwarf_abbreviation *abbreviation = &unit->abbreviations[code];
        abbreviation->tag = (uint32_t)read_leb(&c, false);
        abbreviation->has_children = read_number(&c, 1) != 0;
        abbreviation->attributes = c.at;
        while (read_attribute(&c, &name, &form, &constant)) {
        }
    }
    return c.failed ? nook_fail(NOOK_E_FORMAT, "%s: its debug information is cut; build it again", path) : NOOK_OK;
}

void nook_dwarf_unit_free(nook_dwarf_unit *unit)
{
    free(unit->abbreviations);
    *unit = (nook_dwarf_unit){ 0 };
}

/* ---- entries ---- */

static void store(nook_dwarf_entry *entry, uint64_t attribute, dwarf_value value)
{
    switch (attribute) {
    case AT_NAME:
        entry->name = value.text ? value.text : "";
        break;
    case AT_TYPE:
        entry->type = value.is_place ? (size_t)value.number : 0;
        break;
    case AT_SIBLING:
        entry->sibling = value.is_place ? (size_t)value.number : 0;
        break;
    case AT_BYTE_SIZE:
        entry->byte_size = value.number;
        break;
    case AT_BIT_SIZE:
        entry->bit_size = value.number;
        break;
    case AT_DATA_BIT_OFFSET:
        entry->bit_offset = value.number;
        break;
    case AT_DATA_MEMBER_LOCATION:
        entry->offset = value.number;
        break;
    case AT_UPPER_BOUND:
        entry->upper_bound = value.number;
        break;
    case AT_COUNT:
        entry->count = value.number;
        break;
    case AT_CONST_VALUE:
        entry->value = value.number;
        break;
    case AT_ENCODING:
        entry->encoding = value.number;
        break;
    case AT_STR_OFFSETS_BASE:
        entry->str_offsets_base = value.number;
        break;
    case AT_DECLARATION:
        entry->declaration = value.number != 0;
        break;
    case AT_EXTERNAL:
        entry->external = value.number != 0;
        break;
    default:
        break;
    }
}

nook_dwarf_entry nook_dwarf_entry_read(const nook_dwarf_unit *unit, size_t place)
{
    nook_dwarf_entry entry = { .name = "" };
    cursor c = { .bytes = unit->bytes, .at = place }, list = { .bytes = unit->sections->abbrev };
    uint64_t code = read_leb(&c, false), name, form, constant;
    entry.next = c.at;
    if (c.failed || code == 0 || code >= unit->abbreviation_count || unit->abbreviations[code].attributes == 0)
        return entry;
    list.at = unit->abbreviations[code].attributes;
    while (!c.failed && read_attribute(&list, &name, &form, &constant)) {
        dwarf_value value = read_value(unit, form, constant, &c);
        store(&entry, name, value);
    }
    if (c.failed)
        return (nook_dwarf_entry){ .name = "", .next = c.at };
    entry.tag = unit->abbreviations[code].tag;
    entry.has_children = unit->abbreviations[code].has_children;
    entry.next = c.at;
    return entry;
}

size_t nook_dwarf_skip(const nook_dwarf_unit *unit, const nook_dwarf_entry *entry)
{
    if (!entry->has_children)
        return entry->next;
    if (entry->sibling > entry->next && entry->sibling < unit->bytes.size)
        return entry->sibling;
    size_t place = entry->next;
    for (int depth = 1; depth > 0 && place < unit->bytes.size;) {
        nook_dwarf_entry inner = nook_dwarf_entry_read(unit, place);
        place = inner.next;
        depth += inner.tag == 0 ? -1 : inner.has_children;
    }
    return place;
}

/* ---- a unit ---- */

/* @return where its abbreviations are; c->failed when it is cut */
static uint64_t read_unit_header(cursor *c, nook_dwarf_unit *unit, bool *out_is_source)
{
    enum { UNIT_COMPILE = 0x01 };
    unit->version = (uint8_t)read_number(c, 2);
    *out_is_source = true;
    if (unit->version >= 5) {
        *out_is_source = read_number(c, 1) == UNIT_COMPILE;
        unit->address_size = (uint8_t)read_number(c, 1);
    }
    uint64_t abbreviations = read_number(c, unit->offset_size);
    if (unit->version < 5)
        unit->address_size = (uint8_t)read_number(c, 1);
    return abbreviations;
}

nook_result nook_dwarf_unit_read(const char *path, const nook_debug_sections *sections, size_t offset,
                                 nook_dwarf_unit *unit, size_t *out_offset)
{
    cursor c = { .bytes = sections->info, .at = offset };
    bool is_source;
    uint64_t length = read_number(&c, 4);
    unit->offset_size = length == 0xffffffff ? 8 : 4;
    if (unit->offset_size == 8)
        length = read_number(&c, 8);
    if (c.failed || length > c.bytes.size - c.at)
        return nook_fail(NOOK_E_FORMAT, "%s: its debug information is cut; build it again", path);
    unit->sections = sections;
    unit->bytes = (nook_section){ sections->info.bytes + offset, c.at + (size_t)length - offset };
    *out_offset = offset + unit->bytes.size;
    uint64_t abbreviations = read_unit_header(&c, unit, &is_source);
    if (unit->version != 4 && unit->version != 5)
        return nook_fail(NOOK_E_FORMAT, "%s: debug information of version %d; build it with -gdwarf-5", path,
                         unit->version);
    unit->root = is_source ? c.at - offset : 0;
    nook_result result = read_abbreviations(path, unit, abbreviations);
    if (result == NOOK_OK && is_source) /* its texts can be read when its base is known */
        unit->str_offsets_base = nook_dwarf_entry_read(unit, unit->root).str_offsets_base;
    return result;
}
