#include "engine/core/param.h"
#include "engine/core/log.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const nook_param *nook_param_find(const nook_param *table, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(table[i].name, name) == 0)
            return &table[i];
    }
    return NULL;
}

static void store(const nook_param *param, void *block, double value)
{
    char *field = (char *)block + param->offset;
    if (param->type == NOOK_PARAM_FLOAT) {
        float as_float = (float)value;
        memcpy(field, &as_float, sizeof as_float);
    } else {
        int32_t as_int = (int32_t)value;
        memcpy(field, &as_int, sizeof as_int);
    }
}

void nook_param_reset(const nook_param *table, size_t count, void *block)
{
    for (size_t i = 0; i < count; i++)
        store(&table[i], block, table[i].initial);
}

/** A float parameter is held to the floats nearest to its bounds: what it can store, 0.99 say, is itself a little off. */
static int in_range(const nook_param *param, double value)
{
    if (param->type == NOOK_PARAM_FLOAT && fabs(value) <= (double)FLT_MAX)
        return (float)value >= (float)param->lowest && (float)value <= (float)param->highest;
    return value >= param->lowest && value <= param->highest;
}

nook_result nook_param_set(const nook_param *param, const char *owner, void *block, double value)
{
    int whole = param->type == NOOK_PARAM_FLOAT || value == floor(value);
    if (!in_range(param, value) || !whole)
        return nook_fail(NOOK_E_RANGE, "%s.%s = %g: give %s from %g to %g", owner, param->name, value,
                         param->type == NOOK_PARAM_FLOAT ? "a number" : "a whole number", param->lowest,
                         param->highest);
    store(param, block, value);
    return NOOK_OK;
}

static int find_choice(const char *choices, const char *text)
{
    size_t length = strlen(text);
    int index = 0;
    for (const char *at = choices; at; index++) {
        const char *bar = strchr(at, '|');
        size_t size = bar ? (size_t)(bar - at) : strlen(at);
        if (size == length && memcmp(at, text, size) == 0)
            return index;
        at = bar ? bar + 1 : NULL;
    }
    return -1;
}

nook_result nook_param_parse(const nook_param *param, const char *owner, void *block, const char *text)
{
    if (param->type == NOOK_PARAM_CHOICE) {
        int index = find_choice(param->choices, text);
        if (index < 0)
            return nook_fail(NOOK_E_ARG, "%s.%s = %s: choose one of %s", owner, param->name, text, param->choices);
        return nook_param_set(param, owner, block, index);
    }
    char *end = NULL;
    double value = strtod(text, &end);
    if (end == text || *end != '\0')
        return nook_fail(NOOK_E_ARG, "%s.%s = %s: not a number", owner, param->name, text);
    return nook_param_set(param, owner, block, value);
}

nook_result nook_param_assign(const nook_param *table, size_t count, const char *where, const char *owner, void *block,
                              const char *name, const char *text)
{
    char whole[512], names[256] = "";
    const size_t length = strlen(owner);
    size_t used = 0;
    const char *own = strncmp(name, owner, length) == 0 && name[length] == '.' ? name + length + 1 : name;
    const nook_param *param = nook_param_find(table, count, own);
    snprintf(whole, sizeof whole, "%s: %s", where, owner);
    if (param)
        return nook_param_parse(param, whole, block, text);
    for (size_t i = 0; i < count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s.%s", i ? ", " : "", owner, table[i].name);
    return nook_fail(NOOK_E_NOT_FOUND, "%s has no parameter %s; there are %s", whole, own, names);
}

double nook_param_get(const nook_param *param, const void *block)
{
    const char *field = (const char *)block + param->offset;
    float as_float;
    int32_t as_int;
    if (param->type == NOOK_PARAM_FLOAT) {
        memcpy(&as_float, field, sizeof as_float);
        return as_float;
    }
    memcpy(&as_int, field, sizeof as_int);
    return as_int;
}

const char *nook_param_print(const nook_param *param, const void *block, char *out, size_t capacity)
{
    return nook_param_print_value(param, nook_param_get(param, block), out, capacity);
}

const char *nook_param_print_value(const nook_param *param, double value, char *out, size_t capacity)
{
    if (param->type != NOOK_PARAM_CHOICE) {
        snprintf(out, capacity, "%g", value);
        return out;
    }
    const char *at = param->choices;
    for (int skip = (int)value; skip > 0 && at; skip--) {
        at = strchr(at, '|');
        at = at ? at + 1 : NULL;
    }
    snprintf(out, capacity, "%.*s", at ? (int)strcspn(at, "|") : 0, at ? at : "");
    return out;
}

const char *nook_unit_name(nook_unit unit)
{
    static const char *const names[] = { "", "metre", "pixel", "count", "degree" };
    return names[unit];
}
