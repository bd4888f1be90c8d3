/* "DWARF Debugging Information Format Version 5", 2017: sections 7.5.1 and 7.5.3 have the headers and the abbreviations. */
#include "engine/core/log.h"
#include "engine/module/dwarf_attribute_internal.h"
#include "engine/module/dwarf_internal.h"
#include <stdlib.h>

enum { ABBREVIATIONS_MAX = 1 << 16 };

/* ---- abbreviations ---- */

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

static nook_result read_abbreviations(const char *path, nook_dwarf_unit *unit, uint64_t offset)
{
    nook_dwarf_cursor c = { .bytes = unit->sections->abbrev };
    nook_dwarf_attribute attribute;
    nook_dwarf_skip_bytes(&c, offset);
    unit->abbreviation_count = 0;
    for (uint64_t code = nook_dwarf_read_leb(&c, false); code != 0 && !c.failed;
         code = nook_dwarf_read_leb(&c, false)) {
        if (code >= ABBREVIATIONS_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: its debug information is damaged; build it again", path);
        if (!reserve_abbreviation(unit, (size_t)code))
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for its debug information", path);
        nook_dwarf_abbreviation *abbreviation = &unit->abbreviations[code];
        abbreviation->tag = (uint32_t)nook_dwarf_read_leb(&c, false);
        abbreviation->has_children = nook_dwarf_read_number(&c, 1) != 0;
        abbreviation->attributes = c.at;
        while (nook_dwarf_read_attribute(&c, &attribute)) {
        }
    }
    return c.failed ? nook_fail(NOOK_E_FORMAT, "%s: its debug information is cut; build it again", path) : NOOK_OK;
}

void nook_dwarf_unit_free(nook_dwarf_unit *unit)
{
    free(unit->abbreviations);
    *unit = (nook_dwarf_unit){ 0 };
}

/* ---- headers ---- */

/* @return where its abbreviations are; c->failed when it is cut */
static uint64_t read_unit_header(nook_dwarf_cursor *c, nook_dwarf_unit *unit, bool *out_is_source)
{
    enum { UNIT_COMPILE = 0x01 };
    unit->version = (uint8_t)nook_dwarf_read_number(c, 2);
    *out_is_source = true;
    if (unit->version >= 5) {
        *out_is_source = nook_dwarf_read_number(c, 1) == UNIT_COMPILE;
        unit->address_size = (uint8_t)nook_dwarf_read_number(c, 1);
    }
    uint64_t abbreviations = nook_dwarf_read_number(c, unit->offset_size);
    if (unit->version < 5)
        unit->address_size = (uint8_t)nook_dwarf_read_number(c, 1);
    return abbreviations;
}

nook_result nook_dwarf_unit_read(const char *path, const nook_debug_sections *sections, size_t offset,
                                 nook_dwarf_unit *unit, size_t *out_offset)
{
    nook_dwarf_cursor c = { .bytes = sections->info, .at = offset };
    bool is_source;
    uint64_t length = nook_dwarf_read_number(&c, 4);
    unit->offset_size = length == 0xffffffff ? 8 : 4;
    if (unit->offset_size == 8)
        length = nook_dwarf_read_number(&c, 8);
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
