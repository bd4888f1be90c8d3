/* "DWARF Debugging Information Format Version 5", 2017: sections 7.5.4 to 7.5.6 have the attributes and their forms. */
#include "engine/module/dwarf_attribute_internal.h"
#include "engine/module/dwarf_internal.h"
#include <string.h>

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
    FORM_LOCLISTX = 0x22,
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

/* ---- values of attributes ---- */

typedef struct value_of_form {
    uint64_t number;
    const char *text; /* NULL: it is no text */
    bool is_place;    /* counted from the start of the unit */
} value_of_form;

static const char *indexed_text(const nook_dwarf_unit *unit, uint64_t index)
{
    nook_dwarf_cursor c = { .bytes = unit->sections->str_offsets };
    nook_dwarf_skip_bytes(&c, unit->str_offsets_base);
    if (index > c.bytes.size)
        return "";
    nook_dwarf_skip_bytes(&c, index * unit->offset_size);
    return nook_dwarf_text_at(unit->sections->str, nook_dwarf_read_number(&c, unit->offset_size));
}

static value_of_form read_text_form(const nook_dwarf_unit *unit, uint64_t form, nook_dwarf_cursor *c)
{
    switch (form) {
    case FORM_STRP:
        return (value_of_form){ .text = nook_dwarf_text_at(unit->sections->str,
                                                           nook_dwarf_read_number(c, unit->offset_size)) };
    case FORM_LINE_STRP:
        return (value_of_form){ .text = nook_dwarf_text_at(unit->sections->line_str,
                                                           nook_dwarf_read_number(c, unit->offset_size)) };
    case FORM_STRX:
        return (value_of_form){ .text = indexed_text(unit, nook_dwarf_read_leb(c, false)) };
    case FORM_STRING: {
        const char *text = nook_dwarf_text_at(c->bytes, c->at);
        nook_dwarf_skip_bytes(c, strlen(text) + 1);
        return (value_of_form){ .text = text };
    }
    default: /* FORM_STRX1 to FORM_STRX4 */
        return (value_of_form){ .text = indexed_text(unit, nook_dwarf_read_number(c, form - FORM_STRX1 + 1)) };
    }
}

static value_of_form read_block_form(uint64_t form, nook_dwarf_cursor *c)
{
    uint64_t size = form == FORM_BLOCK1   ? nook_dwarf_read_number(c, 1)
                    : form == FORM_BLOCK2 ? nook_dwarf_read_number(c, 2)
                    : form == FORM_BLOCK4 ? nook_dwarf_read_number(c, 4)
                                          : nook_dwarf_read_leb(c, false);
    nook_dwarf_skip_bytes(c, size);
    return (value_of_form){ 0 };
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

static value_of_form read_value(const nook_dwarf_unit *unit, const nook_dwarf_attribute *attribute,
                                nook_dwarf_cursor *c)
{
    uint64_t form = attribute->form;
    size_t size = number_size(unit, form);
    if (size > 0)
        return (value_of_form){ .number = nook_dwarf_read_number(c, size),
                                .is_place = form >= FORM_REF1 && form <= FORM_REF8 };
    switch (form) {
    case FORM_FLAG_PRESENT:
        return (value_of_form){ .number = 1 };
    case NOOK_DWARF_FORM_IMPLICIT_CONST:
        return (value_of_form){ .number = attribute->constant };
    case FORM_SDATA:
        return (value_of_form){ .number = nook_dwarf_read_leb(c, true) };
    case FORM_UDATA:
    case FORM_REF_UDATA:
    case FORM_ADDRX:
    case FORM_LOCLISTX:
    case FORM_RNGLISTX:
        return (value_of_form){ .number = nook_dwarf_read_leb(c, false), .is_place = form == FORM_REF_UDATA };
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
        return (value_of_form){ 0 };
    }
}

/* ---- entries ---- */

static void store(nook_dwarf_entry *entry, uint64_t name, value_of_form value)
{
    switch (name) {
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
    nook_dwarf_cursor c = { .bytes = unit->bytes, .at = place }, list = { .bytes = unit->sections->abbrev };
    nook_dwarf_attribute attribute;
    uint64_t code = nook_dwarf_read_leb(&c, false);
    entry.next = c.at;
    if (c.failed || code == 0 || code >= unit->abbreviation_count || unit->abbreviations[code].attributes == 0)
        return entry;
    list.at = unit->abbreviations[code].attributes;
    while (!c.failed && nook_dwarf_read_attribute(&list, &attribute)) {
        value_of_form value = read_value(unit, &attribute, &c);
        store(&entry, attribute.name, value);
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
