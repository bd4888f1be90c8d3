/**
 * dwarf_bytes_internal.h - numbers and texts out of the bytes of a section. Not for use outside
 * engine/module. All inline: most of the time of reading a program goes here.
 */
#pragma once
#include "engine/module/debug_sections_internal.h"

/** Reads on from a place; behind the end there are zeroes. */
typedef struct nook_dwarf_cursor {
    nook_section bytes;
    size_t at;
    bool failed; /**< It was asked for more than there is. */
} nook_dwarf_cursor;

/** Of `size` bytes, the lowest first; of more than 8, the first 8. */
static inline uint64_t nook_dwarf_read_number(nook_dwarf_cursor *c, size_t size)
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

static inline void nook_dwarf_skip_bytes(nook_dwarf_cursor *c, uint64_t size)
{
    c->failed = c->failed || c->at > c->bytes.size || size > c->bytes.size - c->at;
    c->at = c->failed ? c->bytes.size : c->at + (size_t)size;
}

/** As nook_dwarf_read_leb, of any length. */
static inline uint64_t nook_dwarf_read_long_leb(nook_dwarf_cursor *c, bool is_signed)
{
    uint64_t value = 0;
    uint8_t byte = 0x80;
    unsigned shift = 0;
    while ((byte & 0x80) && !c->failed) {
        byte = (uint8_t)nook_dwarf_read_number(c, 1);
        if (shift < 64)
            value |= (uint64_t)(byte & 0x7f) << shift;
        shift += 7;
    }
    if (is_signed && shift < 64 && (byte & 0x40))
        value |= ~(uint64_t)0 << shift;
    return value;
}

/** "Little Endian Base 128": seven bits a byte, the lowest first. */
static inline uint64_t nook_dwarf_read_leb(nook_dwarf_cursor *c, bool is_signed)
{
    if (!is_signed && c->at < c->bytes.size && c->bytes.bytes[c->at] < 0x80)
        return c->bytes.bytes[c->at++]; /* most are of one byte */
    return nook_dwarf_read_long_leb(c, is_signed);
}

/** A text of a section of texts: it ends there, or at the zero that follows the file. "" behind the end. */
static inline const char *nook_dwarf_text_at(nook_section section, uint64_t offset)
{
    return offset < section.size ? (const char *)section.bytes + offset : "";
}
