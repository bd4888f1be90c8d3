#include "engine/core/log.h"
#include "game/techniques.h"
#include "game/verify/verify_run.h"
#include <stdlib.h>
#include <string.h>

/** Cuts at commas; empty names stay, and are refused as names. */
static char *next_name(char **rest)
{
    char *name = *rest, *comma = strchr(name, ',');
    *rest = comma ? comma + 1 : NULL;
    if (comma)
        *comma = '\0';
    return name;
}

static nook_result add_technique(const char *name, nook_verify_desc *desc)
{
    if (strcmp(name, "filter") == 0) {
        desc->filter = true;
        return NOOK_OK;
    }
    const nook_ao_technique *technique = nook_technique_find(name);
    if (!technique)
        return nook_technique_refuse("--techniques", name);
    for (size_t i = 0; i < desc->technique_count; i++) {
        if (desc->techniques[i] == technique)
            return NOOK_OK;
    }
    if (desc->technique_count < NOOK_VERIFY_CHOSEN_MAX)
        desc->techniques[desc->technique_count++] = technique;
    return NOOK_OK;
}

nook_result nook_verify_choose_techniques(const char *list, nook_verify_desc *desc)
{
    size_t count;
    const nook_ao_technique *const *all = nook_techniques(&count);
    for (size_t i = 0; !list && i < count; i++)
        add_technique(all[i]->name, desc);
    if (!list)
        return add_technique("filter", desc);
    char copy[512];
    if (strlen(list) >= sizeof copy)
        return nook_fail(NOOK_E_ARG, "--techniques: over %zu letters; name each technique once", sizeof copy - 1);
    char *rest = strcpy(copy, list);
    nook_result result = NOOK_OK;
    while (rest && result == NOOK_OK)
        result = add_technique(next_name(&rest), desc);
    return result;
}

/** Whether any row goes by a name or a number. */
static bool is_fixture(const char *name)
{
    const nook_verify_desc asked = { .fixtures = { name }, .fixture_count = 1 };
    size_t count;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&count);
    for (size_t i = 0; i < count; i++) {
        if (nook_verify_wants(&asked, fixtures[i].row, fixtures[i].name))
            return true;
    }
    return nook_verify_wants(&asked, 18, "positional") || nook_verify_wants(&asked, 19, "volume_self") ||
           nook_verify_wants(&asked, 20, "filter");
}

static nook_result refuse_fixture(const char *name)
{
    char names[512] = "";
    size_t count;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&count);
    for (size_t i = 0; i < count; i++) {
        strncat(names, fixtures[i].name, sizeof names - strlen(names) - 1);
        strncat(names, ", ", sizeof names - strlen(names) - 1);
    }
    return nook_fail(
        NOOK_E_NOT_FOUND,
        "--fixtures: there is no '%s'; give numbers of rows, 1 to 20, or names: %spositional, volume_self, "
        "filter",
        name, names);
}

nook_result nook_verify_choose_fixtures(const char *list, nook_verify_desc *desc, char *storage, size_t capacity)
{
    if (!list)
        return NOOK_OK;
    if (strlen(list) >= capacity)
        return nook_fail(NOOK_E_ARG, "--fixtures: over %zu letters; name each fixture once", capacity - 1);
    char *rest = strcpy(storage, list);
    while (rest) {
        const char *name = next_name(&rest);
        if (!is_fixture(name))
            return refuse_fixture(name);
        if (desc->fixture_count == NOOK_VERIFY_CHOSEN_MAX)
            return nook_fail(NOOK_E_ARG, "--fixtures: more than %d; name each fixture once", NOOK_VERIFY_CHOSEN_MAX);
        desc->fixtures[desc->fixture_count++] = name;
    }
    return NOOK_OK;
}
