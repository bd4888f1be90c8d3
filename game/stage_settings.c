#include "game/stage_settings.h"
#include "game/techniques.h"
#include "game/volumes.h"

nook_result nook_stage_settings_read(const char *path, nook_settings_file *out)
{
    if (path && *path)
        return nook_settings_file_read(path, out);
    *out = (nook_settings_file){ .setting = nook_setting_initial(nook_technique_find("volume")) };
    return NOOK_OK;
}

nook_result nook_stage_fill_as_set(nook_stage *stage, const nook_settings_file *settings, const char *cache)
{
    double r_max = settings->r_max > 0.0 ? settings->r_max : nook_volumes_default_r_max(stage->scene);
    stage->plan = settings->plan;
    stage->live_scene = settings->live;
    const nook_game_world_desc world = { settings->setting.resolution, r_max, cache };
    nook_result result = nook_setting_apply(stage->ao, &settings->setting);
    if (result == NOOK_OK)
        result = nook_ao_set_param(stage->ao, "ao.r_max", r_max);
    if (result == NOOK_OK && settings->falloff[0])
        result = nook_ao_parse_param(stage->ao, "ao.falloff", settings->falloff);
    return result == NOOK_OK ? nook_stage_fill(stage, &world) : result;
}
