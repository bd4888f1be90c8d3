/**
 * result_columns.h - every member of a row and of a site by name, for the journal, the CSV and the JSON.
 */
#pragma once
#include "engine/asset/json_tree.h"
#include "engine/core/json.h"
#include "game/measure/results.h"

typedef enum nook_result_kind {
    NOOK_RESULT_TEXT,   /**< char *, owned; never NULL. */
    NOOK_RESULT_NUMBER, /**< double; NaN: there is none. */
    NOOK_RESULT_WHOLE,  /**< uint32_t */
    NOOK_RESULT_COUNT,  /**< uint64_t */
    NOOK_RESULT_FLAG    /**< bool */
} nook_result_kind;

typedef struct nook_result_column {
    const char *name; /**< In files. */
    nook_result_kind kind;
    size_t offset; /**< Into nook_result_row or nook_result_site. */
} nook_result_column;

const nook_result_column *nook_result_row_columns(size_t *out_count);
const nook_result_column *nook_result_site_columns(size_t *out_count);

/** Writes all members as one JSON object. @param record  a row or a site */
void nook_result_write_json(nook_json *json, const nook_result_column *columns, size_t count, const void *record);

/**
 * Reads what nook_result_write_json wrote; members that are missing are "", NaN, 0 or false, unknown ones are nothing.
 * @param where   for messages
 * @param record  zeroed row or site; to be freed also on failure
 * @return NOOK_E_FORMAT, NOOK_E_MEMORY
 */
nook_result nook_result_read_json(const char *where, const nook_json_tree *tree, uint32_t object,
                                  const nook_result_column *columns, size_t count, void *record);

/** Frees the texts and zeroes the record. */
void nook_result_clear(const nook_result_column *columns, size_t count, void *record, size_t record_size);
