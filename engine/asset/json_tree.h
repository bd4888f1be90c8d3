/**
 * json_tree.h - strict JSON (RFC 8259) as one flat list of values, for checking a file before another parser sees it.
 *
 * No recursion, so no nesting depth can overflow the stack. Values are indices into `values`; value 0 is the root.
 * The children of an array stand behind it, each at `next` of the one before; an object's are key, value, key, value.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_JSON_NONE UINT32_MAX /**< No such value. */

typedef enum nook_json_kind {
    NOOK_JSON_NULL,
    NOOK_JSON_BOOL,
    NOOK_JSON_NUMBER,
    NOOK_JSON_STRING,
    NOOK_JSON_ARRAY,
    NOOK_JSON_OBJECT
} nook_json_kind;

typedef struct nook_json_value {
    nook_json_kind kind;
    uint32_t start, length; /**< Bytes of the text; a string's are without its quotes, escapes as written. */
    uint32_t count;         /**< Elements of an array, members of an object; else 0. */
    uint32_t next;          /**< The value after this one and everything inside it. */
} nook_json_value;

typedef struct nook_json_tree {
    const char *text; /**< Borrowed from the caller of nook_json_tree_read. */
    nook_json_value *values;
    uint32_t value_count;
} nook_json_tree;

/**
 * Reads and checks a whole JSON text: syntax, UTF-8, nesting.
 * @param name       used in messages only
 * @param text       must outlive the tree; need not end in a zero byte
 * @param depth_max  nesting beyond this is refused, at most 256
 * @return NOOK_E_FORMAT with the line number; NOOK_E_MEMORY; *out_tree is untouched on failure
 */
nook_result nook_json_tree_read(const char *name, const char *text, size_t size, uint32_t depth_max,
                                nook_json_tree *out_tree);
void nook_json_tree_free(nook_json_tree *tree); /**< Zeroed trees are allowed. */

/** The value of the first member of that name. @return NOOK_JSON_NONE when absent or when `object` is not an object */
uint32_t nook_json_tree_find(const nook_json_tree *tree, uint32_t object, const char *key);
/** Whether the string value, with its escapes resolved, equals `text`. */
bool nook_json_tree_string_is(const nook_json_tree *tree, uint32_t value, const char *text);
/** A number written as a non-negative integer without fraction or exponent. @return false otherwise, or from 10^18 on */
bool nook_json_tree_integer(const nook_json_tree *tree, uint32_t value, uint64_t *out);
/** A number as double; not finite when it is too large for one. The value must be a number. */
double nook_json_tree_number(const nook_json_tree *tree, uint32_t value);
/**
 * Copies a string with its escapes resolved, zero-terminated.
 * @param out_length  bytes without the final zero; larger than strlen when the string holds a NUL. May be NULL.
 * @return release with free; NULL when out of memory
 */
char *nook_json_tree_copy_string(const nook_json_tree *tree, uint32_t value, size_t *out_length);

#ifdef __cplusplus
}
#endif
