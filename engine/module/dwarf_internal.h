/**
 * dwarf_internal.h - reads the tree in which compilers describe types (DWARF 4 and 5, of gcc and clang). Not for use outside engine/module.
 *
 * A unit is a source file; its root is an entry, and entries have children. Only what describes types is taken out of them.
 * A file that is damaged gives NOOK_E_FORMAT or entries that are zero, never a read outside of it.
 */
#pragma once
#include "engine/module/debug_sections_internal.h"

/** Tags of entries that we ask for. */
enum {
    DWARF_TAG_ARRAY = 0x01,
    DWARF_TAG_ENUMERATION = 0x04,
    DWARF_TAG_PARAMETER = 0x05,
    DWARF_TAG_MEMBER = 0x0d,
    DWARF_TAG_POINTER = 0x0f,
    DWARF_TAG_STRUCT = 0x13,
    DWARF_TAG_FUNCTION_TYPE = 0x15,
    DWARF_TAG_TYPEDEF = 0x16,
    DWARF_TAG_UNION = 0x17,
    DWARF_TAG_ANY_PARAMETERS = 0x18, /**< The ... of printf. */
    DWARF_TAG_RANGE = 0x21,          /**< Of an array. */
    DWARF_TAG_BASE = 0x24,
    DWARF_TAG_CONST = 0x26,
    DWARF_TAG_ENUMERATOR = 0x28,
    DWARF_TAG_FUNCTION = 0x2e,
    DWARF_TAG_VOLATILE = 0x35,
    DWARF_TAG_RESTRICT = 0x37,
    DWARF_TAG_ATOMIC = 0x47
};

/** Places are offsets into the unit; 0 is none. */
typedef struct nook_dwarf_entry {
    uint32_t tag; /**< 0: the end of a list of children. */
    bool has_children, declaration, external;
    const char *name; /**< "" when it has none. */
    size_t type;      /**< Place of the entry of its type. */
    size_t sibling;   /**< Place of the next one, behind its children; 0: not told. */
    size_t next;      /**< Place of what stands behind it: its first child, when it has children. */
    uint64_t byte_size, encoding, offset, bit_offset, bit_size, upper_bound, count, value;
    uint64_t str_offsets_base; /**< Of a root; 0: not told. */
} nook_dwarf_entry;

/** What entries that look alike have in common. */
typedef struct nook_dwarf_abbreviation {
    uint32_t tag;
    bool has_children;
    size_t attributes; /**< Offset of their list into .debug_abbrev; 0: no such code. */
} nook_dwarf_abbreviation;

typedef struct nook_dwarf_unit {
    const nook_debug_sections *sections;
    nook_section bytes;                     /**< With its header. */
    size_t root;                            /**< Place of its first entry. */
    nook_dwarf_abbreviation *abbreviations; /**< By code. */
    size_t abbreviation_count, abbreviation_capacity;
    uint64_t str_offsets_base;
    uint8_t version, offset_size, address_size;
} nook_dwarf_unit;

/**
 * The unit at `offset` of .debug_info.
 * @param unit        zeroed for the first; reused for the next; release it in the end
 * @param out_offset  of the one behind it
 * @return NOOK_E_FORMAT damaged, or of a version that is not known; NOOK_E_MEMORY
 */
nook_result nook_dwarf_unit_read(const char *path, const nook_debug_sections *sections, size_t offset,
                                 nook_dwarf_unit *unit, size_t *out_offset);
void nook_dwarf_unit_free(nook_dwarf_unit *unit);

/** The entry at a place; all zero (tag 0) when there is none. */
nook_dwarf_entry nook_dwarf_entry_read(const nook_dwarf_unit *unit, size_t place);
/** Place of the entry behind this one and all its children. */
size_t nook_dwarf_skip(const nook_dwarf_unit *unit, const nook_dwarf_entry *entry);
