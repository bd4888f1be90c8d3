#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** A std140 block's size is a multiple of 16, and a buffer must cover the whole block. */
static size_t block_size(size_t size)
{
    return size ? (size + 15) / 16 * 16 : 16;
}

static nook_result check_version(const nook_ao_technique *technique)
{
    if (technique->version != NOOK_AO_TECHNIQUE_VERSION)
        return nook_fail(NOOK_E_VERSION, "technique %s: made for version %u, this build takes %d", technique->name,
                         technique->version, NOOK_AO_TECHNIQUE_VERSION);
    return NOOK_OK;
}

/** Its name is the first part of its parameters' names: it must be told from the others and from "ao". */
static nook_result check_name(const nook_ao *ao, const char *name)
{
    int taken = strcmp(name, "ao") == 0;
    for (uint32_t i = 0; i < ao->slot_count; i++)
        taken = taken || strcmp(ao->slots[i].technique->name, name) == 0;
    if (taken || !*name || name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_")])
        return nook_fail(NOOK_E_ARG, "technique \"%s\": the name is taken, or not of a-z, 0-9 and _", name);
    return NOOK_OK;
}

static const char *params_path(const nook_ao_technique *technique, char out[128])
{
    snprintf(out, 128, "modules/ao_%s/params.def", technique->name);
    return out;
}

/** A shader that was read after its params.def has changed must not meet the struct of before. */
static nook_result expect_params(nook_ao *ao, const nook_ao_technique *technique)
{
    char path[128];
    return nook_gpu_expect_params(ao->gpu, params_path(technique, path), technique->params, technique->param_count);
}

/* ---- making and releasing ---- */

static void release_params(nook_ao *ao, ao_slot *slot)
{
    nook_buffer_destroy(ao->gpu, &slot->buffer);
    free(slot->params);
    slot->params = NULL;
}

static void release_state(nook_ao *ao, ao_slot *slot)
{
    if (slot->technique->destroy)
        slot->technique->destroy(slot->state, ao->gpu);
    free(slot->state);
    slot->state = NULL;
}

void ao_slot_release(nook_ao *ao, ao_slot *slot)
{
    release_state(ao, slot);
    release_params(ao, slot);
}

/** Parameters at their initial values, and what they are on the GPU. */
static nook_result make_params(nook_ao *ao, ao_slot *slot)
{
    const nook_ao_technique *technique = slot->technique;
    slot->params = calloc(1, block_size(technique->params_size));
    if (!slot->params)
        return nook_fail(NOOK_E_MEMORY, "technique %s: no memory", technique->name);
    nook_param_reset(technique->params, technique->param_count, slot->params);
    nook_result result = nook_buffer_create(ao->gpu, slot->params, block_size(technique->params_size), &slot->buffer);
    if (result == NOOK_OK)
        result = expect_params(ao, technique);
    if (result != NOOK_OK)
        release_params(ao, slot);
    return result;
}

static nook_result make_state(nook_ao *ao, ao_slot *slot)
{
    const nook_ao_technique *technique = slot->technique;
    slot->state = calloc(1, technique->state_size ? technique->state_size : 1);
    if (!slot->state)
        return nook_fail(NOOK_E_MEMORY, "technique %s: no memory", technique->name);
    nook_result result = technique->create ? technique->create(slot->state, ao->gpu) : NOOK_OK;
    if (result != NOOK_OK) {
        free(slot->state);
        slot->state = NULL;
    }
    return result;
}

nook_result nook_ao_add_technique(nook_ao *ao, const struct nook_ao_technique *technique)
{
    ao_slot slot = { .technique = technique };
    nook_result result = check_version(technique);
    if (result == NOOK_OK && ao->slot_count == AO_TECHNIQUE_MAX)
        result =
            nook_fail(NOOK_E_MEMORY, "technique %s: %d techniques are the most", technique->name, AO_TECHNIQUE_MAX);
    if (result == NOOK_OK)
        result = check_name(ao, technique->name);
    if (result == NOOK_OK)
        result = make_params(ao, &slot);
    if (result != NOOK_OK)
        return result;
    result = make_state(ao, &slot);
    if (result == NOOK_OK)
        ao->slots[ao->slot_count++] = slot;
    else
        release_params(ao, &slot);
    return result;
}

uint32_t ao_slot_kinds(const ao_slot *slot)
{
    const nook_ao_technique *technique = slot->technique;
    if (!(technique->inputs & NOOK_AO_IN_VOLUMES))
        return 0;
    return NOOK_VOLUME_BIT(technique->volume_kind ? technique->volume_kind(slot->params) : NOOK_VOLUME_BINARY);
}

uint32_t nook_ao_volume_kinds(const nook_ao *ao)
{
    uint32_t kinds = 0;
    for (uint32_t i = 0; i < ao->slot_count; i++)
        kinds |= ao_slot_kinds(&ao->slots[i]);
    return kinds;
}

/* ---- replacing ---- */

/** @return its index, or slot_count */
static uint32_t find_slot(const nook_ao *ao, const char *name)
{
    uint32_t i = 0;
    while (i < ao->slot_count && strcmp(ao->slots[i].technique->name, name) != 0)
        i++;
    return i;
}

/** The same choice by its name. @return -1 it is gone */
static double same_choice(const nook_param *old, const void *old_block, const nook_param *param)
{
    char wanted[128], offered[128];
    nook_param_print(old, old_block, wanted, sizeof wanted);
    for (double value = param->lowest; value <= param->highest; value += 1.0) {
        if (strcmp(nook_param_print_value(param, value, offered, sizeof offered), wanted) == 0)
            return value;
    }
    return -1.0;
}

static double within(const nook_param *param, double value)
{
    double low = value < param->lowest ? param->lowest : value;
    double clamped = low > param->highest ? param->highest : low;
    return param->type == NOOK_PARAM_INT ? (double)(int64_t)clamped : clamped;
}

/** Values of parameters that both have; numbers are brought into their new range. */
static void take_values_over(const ao_slot *old, ao_slot *slot)
{
    const nook_ao_technique *before = old->technique, *technique = slot->technique;
    for (uint32_t i = 0; i < technique->param_count; i++) {
        const nook_param *param = &technique->params[i];
        const nook_param *known = nook_param_find(before->params, before->param_count, param->name);
        if (!known || (known->type == NOOK_PARAM_CHOICE) != (param->type == NOOK_PARAM_CHOICE))
            continue;
        double value = param->type == NOOK_PARAM_CHOICE ? same_choice(known, old->params, param)
                                                        : within(param, nook_param_get(known, old->params));
        if (param->type != NOOK_PARAM_CHOICE || value >= 0.0)
            nook_param_set(param, technique->name, slot->params, value);
    }
}

/** What a shader sees of parameters: their names, types and places. */
static int same_rows(const nook_ao_technique *a, const nook_ao_technique *b)
{
    int same = a->param_count == b->param_count && a->params_size == b->params_size;
    for (uint32_t i = 0; same && i < a->param_count; i++)
        same = strcmp(a->params[i].name, b->params[i].name) == 0 && a->params[i].offset == b->params[i].offset &&
               (a->params[i].type == NOOK_PARAM_FLOAT) == (b->params[i].type == NOOK_PARAM_FLOAT);
    return same;
}

/** Shaders made of a params.def with other rows were refused until now, or are of the rows before. */
static void reload_shaders(nook_ao *ao, const nook_ao_technique *technique)
{
    char buffer[128];
    const char *path = params_path(technique, buffer);
    nook_shader_report report;
    nook_gpu_reload_shaders(ao->gpu, &path, 1, &report);
}

nook_result nook_ao_replace_technique(nook_ao *ao, const struct nook_ao_technique *technique, int keep_state)
{
    uint32_t index = find_slot(ao, technique->name);
    nook_result result = check_version(technique);
    if (result == NOOK_OK && index == ao->slot_count)
        result = nook_fail(NOOK_E_NOT_FOUND, "technique %s: is not there to be replaced", technique->name);
    if (result != NOOK_OK || ao->slots[index].technique == technique)
        return result;
    ao_slot *old = &ao->slots[index], slot = { .technique = technique };
    const nook_ao_technique *before = old->technique;
    int keep =
        keep_state && before->state_size == technique->state_size && before->state_version == technique->state_version;
    result = make_params(ao, &slot);
    if (result != NOOK_OK)
        return result;
    if (!keep) {
        result = make_state(ao, &slot);
        if (result != NOOK_OK) {
            release_params(ao, &slot);
            expect_params(ao, before);
            return result;
        }
        release_state(ao, old);
    } else {
        slot.state = old->state;
    }
    take_values_over(old, &slot);
    release_params(ao, old);
    *old = slot;
    nook_ao_forget(ao); /* what other code has traced */
    if (!same_rows(before, technique))
        reload_shaders(ao, technique);
    return NOOK_OK;
}
