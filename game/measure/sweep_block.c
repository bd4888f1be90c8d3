#include "game/measure/sweep_block.h"
#include "engine/core/log.h"
#include "game/volumes.h"
#include "modules/ao/technique.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *place(const nook_sweep_block *block, unsigned line, char out[NOOK_LINE_WHERE_SIZE])
{
    snprintf(out, NOOK_LINE_WHERE_SIZE, "%s:%u", block->file, line);
    return out;
}

/* Two ways to say the same: the resolution that is taken when none is given. */
static void make_plain(nook_setting *setting)
{
    if (setting->resolution == NOOK_VOLUMES_RESOLUTION_DEFAULT)
        setting->resolution = 0;
}

/* Cuts the values apart in place. */
static nook_result split_values(const char *where, char *text, nook_sweep_list *list)
{
    for (char *word = strtok(text, NOOK_LINE_BLANKS); word; word = strtok(NULL, NOOK_LINE_BLANKS)) {
        if (list->count == NOOK_SWEEP_VALUES_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: %s has more than %d values", where, list->name, NOOK_SWEEP_VALUES_MAX);
        list->values[list->count++] = word;
    }
    return list->count > 0 ? NOOK_OK : nook_fail(NOOK_E_FORMAT, "%s: %s has no values", where, list->name);
}

static nook_result try_values(const char *where, const nook_sweep_block *block, const nook_sweep_list *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        nook_setting setting = nook_setting_initial(block->technique);
        if (nook_setting_assign(where, &setting, list->name, list->values[i]) != NOOK_OK)
            return NOOK_E_FORMAT; /* whatever is wrong with the value is wrong with the file */
    }
    return NOOK_OK;
}

nook_result nook_sweep_block_add(nook_sweep_block *block, unsigned line, const char *name, const char *values)
{
    char where[NOOK_LINE_WHERE_SIZE];
    place(block, line, where);
    if (block->list_count == NOOK_SWEEP_LISTS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d lists in one block", where, NOOK_SWEEP_LISTS_MAX);
    for (uint32_t i = 0; i < block->list_count; i++) {
        if (strcmp(block->lists[i].name, name) == 0)
            return nook_fail(NOOK_E_FORMAT, "%s: %s stands in line %u of the same block too; join the two", where, name,
                             block->lists[i].line);
    }
    nook_sweep_list *list = &block->lists[block->list_count];
    *list = (nook_sweep_list){ .line = line };
    size_t name_size = strlen(name) + 1;
    int length = snprintf(list->text, sizeof list->text, "%s %s", name, values);
    if (length < 0 || (size_t)length >= sizeof list->text)
        return nook_fail(NOOK_E_FORMAT, "%s: the line is too long", where);
    list->text[name_size - 1] = '\0';
    list->name = list->text;
    nook_result result = split_values(where, list->text + name_size, list);
    if (result == NOOK_OK)
        result = try_values(where, block, list);
    if (result == NOOK_OK)
        block->list_count++;
    return result;
}

static bool same(const nook_setting *a, const nook_setting *b)
{
    char first[NOOK_SETTING_TEXT_MAX], second[NOOK_SETTING_TEXT_MAX];
    return strcmp(nook_setting_print(a, first), nook_setting_print(b, second)) == 0;
}

nook_result nook_sweep_add(const char *where, nook_sweep *sweep, const nook_setting *setting)
{
    nook_setting plain = *setting;
    make_plain(&plain);
    for (size_t i = 0; i < sweep->setting_count; i++) {
        if (same(&sweep->settings[i], &plain))
            return NOOK_OK;
    }
    if (sweep->setting_count == NOOK_SWEEP_SETTINGS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d settings", where, NOOK_SWEEP_SETTINGS_MAX);
    nook_setting *grown = realloc(sweep->settings, (sweep->setting_count + 1) * sizeof *grown);
    if (!grown)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu settings", where, sweep->setting_count + 1);
    sweep->settings = grown;
    sweep->settings[sweep->setting_count++] = plain;
    return NOOK_OK;
}

/* The index-th combination; the last list's values change fastest. */
static nook_result combine(const nook_sweep_block *block, uint64_t index, nook_setting *out_setting)
{
    char where[NOOK_LINE_WHERE_SIZE];
    *out_setting = nook_setting_initial(block->technique);
    for (uint32_t i = block->list_count; i > 0; i--) {
        const nook_sweep_list *list = &block->lists[i - 1];
        nook_result result = nook_setting_assign(place(block, list->line, where), out_setting, list->name,
                                                 list->values[index % list->count]);
        if (result != NOOK_OK)
            return NOOK_E_FORMAT;
        index /= list->count;
    }
    return NOOK_OK;
}

nook_result nook_sweep_block_expand(const nook_sweep_block *block, nook_sweep *sweep)
{
    char where[NOOK_LINE_WHERE_SIZE];
    place(block, block->list_count > 0 ? block->lists[0].line : 0, where);
    nook_setting setting = nook_setting_initial(block->technique);
    nook_result result = block->technique->exact ? NOOK_OK : nook_sweep_add(where, sweep, &setting);
    uint64_t combinations = 1;
    for (uint32_t i = 0; i < block->list_count; i++) {
        combinations *= block->lists[i].count;
        if (combinations > NOOK_SWEEP_SETTINGS_MAX)
            return nook_fail(NOOK_E_FORMAT, "%s: this block has more than %d combinations", where,
                             NOOK_SWEEP_SETTINGS_MAX);
    }
    for (uint64_t i = 0; block->list_count > 0 && i < combinations && result == NOOK_OK; i++) {
        result = combine(block, i, &setting);
        if (result == NOOK_OK)
            result = nook_sweep_add(where, sweep, &setting);
    }
    return result;
}
