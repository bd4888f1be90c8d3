/**
 * type_hash_internal.h - a number for how a type is laid out. Not for use outside engine/module.
 */
#pragma once
#include "engine/module/dwarf_internal.h"

/** Of a struct, union or enum: the same for the same layout. @param place  of its entry */
uint64_t nook_type_hash(const nook_dwarf_unit *unit, size_t place);
/** Of a function: the same for the same types of result and parameters. */
uint64_t nook_function_hash(const nook_dwarf_unit *unit, const nook_dwarf_entry *function);
