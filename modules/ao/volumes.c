#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/residency.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* ---- Ids -------------------------------------------------------------------------------------------------------- */

/* The place of an id, or where it belongs. */
static uint32_t place_of(const nook_ao *ao, uint32_t id)
{
    uint32_t first = 0, end = ao->volume_id_count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (ao->volume_ids[middle] < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

bool ao_volume_id_is_known(const nook_ao *ao, uint32_t id)
{
    uint32_t i = place_of(ao, id);
    return i < ao->volume_id_count && ao->volume_ids[i] == id;
}

nook_result ao_volume_id_take(nook_ao *ao, uint32_t *out_id)
{
    if (ao->volume_id_count == ao->volume_id_capacity) {
        uint32_t capacity = ao->volume_id_capacity ? ao->volume_id_capacity * 2 : 16;
        uint32_t *grown = realloc(ao->volume_ids, capacity * sizeof *grown);
        if (!grown)
            return nook_fail(NOOK_E_MEMORY, "no memory for another volume");
        ao->volume_ids = grown;
        ao->volume_id_capacity = capacity;
    }
    *out_id = ao->next_volume_id++; /* above all others: it belongs at the end */
    ao->volume_ids[ao->volume_id_count++] = *out_id;
    return NOOK_OK;
}

void ao_volume_id_give(nook_ao *ao, uint32_t id)
{
    uint32_t i = place_of(ao, id);
    if (i < ao->volume_id_count && ao->volume_ids[i] == id)
        memmove(ao->volume_ids + i, ao->volume_ids + i + 1, (--ao->volume_id_count - i) * sizeof *ao->volume_ids);
}

/* ---- Contents --------------------------------------------------------------------------------------------------- */

nook_result nook_ao_keep_volume(nook_ao *ao, nook_ao_volume volume, nook_volume *contents)
{
    nook_volume_kind kind = contents->info.kind;
    assert(ao_volume_id_is_known(ao, volume.id) && !nook_ao_has_volume(ao, volume, kind));
    nook_result result = kind == NOOK_VOLUME_SURFEL ? brick_pool_add(&ao->pool, volume.id, contents)
                                                    : volume_atlas_add(&ao->atlases[kind], volume.id, contents);
    nook_volume_free(contents);
    return result;
}

nook_result nook_ao_reserve_volume(nook_ao *ao, nook_ao_volume *out_volume)
{
    return ao_volume_id_take(ao, &out_volume->id);
}

nook_result nook_ao_add_volume(nook_ao *ao, const char *name, const void *bytes, size_t size,
                               nook_ao_volume *out_volume)
{
    nook_ao_volume made;
    nook_result result = nook_ao_reserve_volume(ao, &made);
    if (result != NOOK_OK)
        return result;
    result = nook_ao_extend_volume(ao, made, name, bytes, size);
    if (result == NOOK_OK)
        *out_volume = made;
    else
        ao_volume_id_give(ao, made.id);
    return result;
}

nook_result nook_ao_extend_volume(nook_ao *ao, nook_ao_volume volume, const char *name, const void *bytes, size_t size)
{
    nook_volume added;
    if (!ao_volume_id_is_known(ao, volume.id))
        return nook_fail(NOOK_E_NOT_FOUND, "%s: the volume %u has been removed", name, volume.id);
    nook_result result = nook_volume_decode(name, bytes, size, &added);
    if (result != NOOK_OK)
        return result;
    if (ao_volume_info(ao, volume.id, NOOK_VOLUME_BIT(added.info.kind))) {
        result = nook_fail(NOOK_E_ARG, "%s: the volume %u is there as %s already", name, volume.id,
                           nook_volume_kind_name(added.info.kind));
        nook_volume_free(&added);
        return result;
    }
    return nook_ao_keep_volume(ao, volume, &added);
}

void nook_ao_remove_volume(nook_ao *ao, nook_ao_volume volume)
{
    ao_volume_id_give(ao, volume.id);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        nook_ao_unplace_volume(ao, volume, (nook_volume_kind)kind);
        nook_ao_drop_volume(ao, volume, (nook_volume_kind)kind);
    }
}

/* ---- On demand -------------------------------------------------------------------------------------------------- */

void nook_ao_set_supply(nook_ao *ao, nook_ao_supply supply, void *user)
{
    ao->supply = supply;
    ao->supply_user = user;
}

nook_result ao_ask_for_volumes(nook_ao *ao, uint32_t kinds)
{
    bool missing = false;
    if (!ao->supply || kinds == 0)
        return NOOK_OK;
    for (uint32_t i = 0; i < ao->occluder_count && !missing; i++) {
        uint32_t id = ao->occluders[i].volume.id;
        missing = ao_volume_id_is_known(ao, id) && !ao_volume_info(ao, id, kinds);
    }
    return missing ? ao->supply(ao->supply_user, kinds) : NOOK_OK;
}
