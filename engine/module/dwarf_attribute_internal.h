/**
 * dwarf_attribute_internal.h - attributes as the abbreviation of an entry lists them. Not for use outside engine/module.
 */
#pragma once
#include "engine/module/dwarf_bytes_internal.h"

enum { NOOK_DWARF_FORM_IMPLICIT_CONST = 0x21 };

/** An attribute as an abbreviation lists it. */
typedef struct nook_dwarf_attribute {
    uint64_t name, form;
    uint64_t constant; /**< Of the one form whose value stands in the list. */
} nook_dwarf_attribute;

/** @return false: the list ends here */
static inline bool nook_dwarf_read_attribute(nook_dwarf_cursor *list, nook_dwarf_attribute *out_attribute)
{
    out_attribute->name = nook_dwarf_read_leb(list, false);
    out_attribute->form = nook_dwarf_read_leb(list, false);
    out_attribute->constant =
        out_attribute->form == NOOK_DWARF_FORM_IMPLICIT_CONST ? nook_dwarf_read_leb(list, true) : 0;
    return !list->failed && (out_attribute->name != 0 || out_attribute->form != 0);
}
