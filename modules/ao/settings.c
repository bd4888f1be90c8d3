#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <stdio.h>
#include <string.h>

/** A parameter, and the block that holds its value. */
typedef struct found_param {
    const nook_param *param;
    const char *owner;
    void *block;
} found_param;

static const nook_ao_technique *technique_at(const nook_ao *ao, uint32_t index)
{
    return index < ao->slot_count ? ao->slots[index].technique : NULL;
}

static const char *list_techniques(const nook_ao *ao, char *out, size_t capacity)
{
    size_t length = 0;
    out[0] = '\0';
    for (uint32_t i = 0; i < ao->slot_count && length < capacity; i++)
        length +=
            (size_t)snprintf(out + length, capacity - length, "%s%s", i ? ", " : "", ao->slots[i].technique->name);
    return out;
}

static const char *list_params(const nook_param *table, size_t count, char *out, size_t capacity)
{
    size_t length = 0;
    out[0] = '\0';
    for (size_t i = 0; i < count && length < capacity; i++)
        length += (size_t)snprintf(out + length, capacity - length, "%s%s", i ? ", " : "", table[i].name);
    return out;
}

static nook_result find_in(const char *name, const char *owner, const nook_param *table, size_t count, void *block,
                           found_param *out)
{
    char known[1024];
    *out = (found_param){ nook_param_find(table, count, name), owner, block };
    if (out->param)
        return NOOK_OK;
    return nook_fail(NOOK_E_NOT_FOUND, "%s.%s: no such parameter; there are %s", owner, name,
                     list_params(table, count, known, sizeof known));
}

static nook_result find_param(const nook_ao *ao, const char *name, found_param *out)
{
    const char *dot = strchr(name, '.');
    size_t length = dot ? (size_t)(dot - name) : 0;
    if (length == 2 && strncmp(name, "ao", 2) == 0)
        return find_in(dot + 1, "ao", ao_shared_table, NOOK_COUNT(ao_shared_table), (void *)&ao->shared, out);
    for (uint32_t i = 0; dot && i < ao->slot_count; i++) {
        const nook_ao_technique *technique = ao->slots[i].technique;
        if (strlen(technique->name) == length && strncmp(technique->name, name, length) == 0)
            return find_in(dot + 1, technique->name, technique->params, technique->param_count, ao->slots[i].params,
                           out);
    }
    char known[1024];
    return nook_fail(NOOK_E_NOT_FOUND, "%s: give technique.parameter; the techniques are ao, %s", name,
                     list_techniques(ao, known, sizeof known));
}

nook_result nook_ao_set_technique(nook_ao *ao, const char *name)
{
    for (uint32_t i = 0; i < ao->slot_count; i++) {
        if (strcmp(ao->slots[i].technique->name, name) == 0) {
            ao->current = i;
            return NOOK_OK;
        }
    }
    char known[1024];
    return nook_fail(NOOK_E_NOT_FOUND, "%s: no such technique; there are %s", name,
                     list_techniques(ao, known, sizeof known));
}

nook_result nook_ao_set_param(nook_ao *ao, const char *name, double value)
{
    found_param found;
    nook_result result = find_param(ao, name, &found);
    return result == NOOK_OK ? nook_param_set(found.param, found.owner, found.block, value) : result;
}

nook_result nook_ao_parse_param(nook_ao *ao, const char *name, const char *text)
{
    found_param found;
    nook_result result = find_param(ao, name, &found);
    return result == NOOK_OK ? nook_param_parse(found.param, found.owner, found.block, text) : result;
}

nook_result nook_ao_get_param(const nook_ao *ao, const char *name, double *out_value)
{
    found_param found;
    nook_result result = find_param(ao, name, &found);
    if (result == NOOK_OK)
        *out_value = nook_param_get(found.param, found.block);
    return result;
}

void nook_ao_reset_params(nook_ao *ao)
{
    nook_param_reset(ao_shared_table, NOOK_COUNT(ao_shared_table), &ao->shared);
    for (uint32_t i = 0; i < ao->slot_count; i++) {
        const nook_ao_technique *technique = ao->slots[i].technique;
        nook_param_reset(technique->params, technique->param_count, ao->slots[i].params);
    }
}

const struct nook_ao_technique *nook_ao_technique_at(const nook_ao *ao, uint32_t index)
{
    return technique_at(ao, index);
}

const struct nook_param *nook_ao_shared_params(size_t *out_count)
{
    *out_count = NOOK_COUNT(ao_shared_table);
    return ao_shared_table;
}
