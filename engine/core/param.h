#pragma once
#include "engine/core/result.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a number is measured in; shown beside sliders and in --help. */
typedef enum nook_unit {
    NOOK_UNIT_NONE,
    NOOK_UNIT_METRE,
    NOOK_UNIT_PIXEL,
    NOOK_UNIT_COUNT,
    NOOK_UNIT_DEGREE
} nook_unit;

typedef enum nook_param_type { NOOK_PARAM_FLOAT, NOOK_PARAM_INT, NOOK_PARAM_CHOICE } nook_param_type;

/** One tunable number. The table is generated from a params.def, the only place where the number stands. */
typedef struct nook_param {
    const char *name; /**< [a-z0-9_]+ */
    nook_param_type type;
    nook_unit unit;
    size_t offset; /**< Bytes into the parameter struct. */
    double initial, lowest, highest;
    const char *choices; /**< NOOK_PARAM_CHOICE: "first|second|..."; the value is the index. Else NULL. */
    const char *help;    /**< One line. */
} nook_param;

/** @return the row of that name, or NULL */
const nook_param *nook_param_find(const nook_param *table, size_t count, const char *name);

/** Writes every initial value into `block`, a struct made from the same params.def. */
void nook_param_reset(const nook_param *table, size_t count, void *block);

/**
 * Sets one parameter.
 * @param owner  used in the message only ("volume" in "volume.rays")
 * @return NOOK_E_RANGE outside [lowest, highest] (for a float: of the floats nearest to them), not finite, or not whole for an int or choice; the old value stays
 */
nook_result nook_param_set(const nook_param *param, const char *owner, void *block, double value);

/** The same from text: a number, or a choice by name. @return NOOK_E_ARG not a number or not a choice; NOOK_E_RANGE */
nook_result nook_param_parse(const nook_param *param, const char *owner, void *block, const char *text);

/**
 * Sets the row that is named, from text.
 * @param where  names the source in the message
 * @param owner  of the table, as "plan"; the name may begin with it: "plan.error" is "error"
 * @return NOOK_E_NOT_FOUND (the line lists the names), NOOK_E_ARG, NOOK_E_RANGE; the block stays as it was then
 */
nook_result nook_param_assign(const nook_param *table, size_t count, const char *where, const char *owner, void *block,
                              const char *name, const char *text);

double nook_param_get(const nook_param *param, const void *block);
/** The value as text: a number, or the name of the choice. @return out */
const char *nook_param_print(const nook_param *param, const void *block, char *out, size_t capacity);
/** The same for a value that nook_param_get gave. @return out */
const char *nook_param_print_value(const nook_param *param, double value, char *out, size_t capacity);
/** "metre", "pixel", "" ... */
const char *nook_unit_name(nook_unit unit);

#ifdef __cplusplus
}
#endif
