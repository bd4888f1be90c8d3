/** moment.h - which pose of a scene is meant, on a command line. */
#pragma once
#include "engine/asset/scene.h"
#include "engine/core/result.h"

/** Zero: the pose at rest. */
typedef struct nook_moment {
    const char *clip; /**< By its name; NULL: the first one when `timed`, else none. */
    bool timed;
    double seconds; /**< Into the clip. */
} nook_moment;

/** @return NOOK_E_NOT_FOUND a clip that the scene does not have; *out_clip is NOOK_NONE for the pose at rest */
nook_result nook_moment_clip(const nook_scene *scene, const nook_moment *moment, uint32_t *out_clip);

/** Poses a scene for good: what does not play, stands. @return NOOK_E_NOT_FOUND; as nook_scene_stand_still */
nook_result nook_moment_stand_still(nook_scene *scene, const nook_moment *moment);
