#include "game/moment.h"
#include "engine/animation/scene_pose.h"
#include "engine/animation/scene_stand.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"

static nook_result refuse(const nook_scene *scene, const char *clip)
{
    nook_suggestion near = nook_suggestion_for(clip);
    for (uint32_t i = 0; i < scene->clip_count; i++)
        nook_suggestion_offer(&near, scene->clips[i].name);
    if (near.nearest && *near.nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: there is no clip %s; did you mean %s?", scene->path, clip,
                         near.nearest);
    return nook_fail(NOOK_E_NOT_FOUND, "%s: there is no clip %s; it has %u (./nook info names them)", scene->path, clip,
                     scene->clip_count);
}

nook_result nook_moment_clip(const nook_scene *scene, const nook_moment *moment, uint32_t *out_clip)
{
    uint32_t clip = NOOK_NONE;
    if (moment->clip) {
        clip = nook_clip_find(scene, moment->clip);
        if (clip == NOOK_NONE)
            return refuse(scene, moment->clip);
    } else if (moment->timed) {
        if (scene->clip_count == 0)
            return nook_fail(NOOK_E_NOT_FOUND, "%s: it has no clips, so there is no time in it; leave --time out",
                             scene->path);
        clip = 0;
    }
    *out_clip = clip;
    return NOOK_OK;
}

nook_result nook_moment_stand_still(nook_scene *scene, const nook_moment *moment)
{
    uint32_t clip = NOOK_NONE;
    nook_result result = nook_moment_clip(scene, moment, &clip);
    return result == NOOK_OK ? nook_scene_stand_still(scene, clip, moment->seconds) : result;
}
