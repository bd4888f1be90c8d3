#include "game/stream_volumes.h"
#include "engine/core/mebibyte.h"
#include <stdio.h>
#include <string.h>

bool nook_volume_can_stream(const nook_scene_volume *baked)
{
    bool any = false, all = true;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        uint32_t count;
        nook_scene_volume_levels(baked, (nook_volume_kind)kind, &count);
        any = any || count > 0;
        all = all && (count > 0 || !baked->bakes[kind].bytes);
    }
    return any && all;
}

nook_result nook_volume_stream(nook_stream *stream, const nook_scene_volume *baked, nook_volume_kind kind,
                               nook_ao_volume *volume)
{
    nook_stream_level levels[NOOK_VOLUMES_LEVELS_MAX];
    uint32_t count;
    const nook_volume_level *files = nook_scene_volume_levels(baked, kind, &count);
    for (uint32_t i = 0; i < count; i++)
        levels[i] = (nook_stream_level){ files[i].path, files[i].info, files[i].error };
    return volume->id ? nook_stream_extend(stream, *volume, levels, count)
                      : nook_stream_add(stream, baked->name, levels, count, volume);
}

nook_result nook_stream_look(nook_stream *stream, const nook_camera *camera, const nook_matrix *clip_from_view,
                             const nook_ao_occluder *occluders, uint32_t count)
{
    nook_stream_view view;
    memcpy(view.view_from_world, camera->view_from_world.m, sizeof view.view_from_world);
    memcpy(view.clip_from_view, clip_from_view->m, sizeof view.clip_from_view);
    return nook_stream_update(stream, &view, 1, occluders, count);
}

const char *nook_stream_print(const nook_stream *stream, char *out, size_t capacity)
{
    nook_stream_status status;
    nook_stream_get_status(stream, &status);
    char budget[32] = "";
    if (status.budget > 0)
        snprintf(budget, sizeof budget, " of %.2f", (double)status.budget / NOOK_MIB);
    snprintf(out, capacity, "volumes: %.2f%s MiB, %u of %u there, %u wanted, %u of these waiting%s",
             (double)status.memory / NOOK_MIB, budget, status.resident, status.volumes, status.wanted, status.waiting,
             status.failed ? "; no room for any more" : "");
    return out;
}
