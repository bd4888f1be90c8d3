#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"
#include "game/measure/sweep.h"

/** A camera that is measured from. */
typedef struct nook_measure_view {
    char name[256];     /**< The scene's own name for it, "camera 2", or "sample 3"; no two of a scene are the same. */
    nook_camera camera; /**< Of the sampled ones only after nook_measure_views_find. */
    bool sampled;
} nook_measure_view;

/** The cameras of a sweep in one scene. */
typedef struct nook_measure_views {
    nook_measure_view *items; /**< Owned. */
    uint32_t count;
    bool found; /**< Where the sampled ones stand. */
} nook_measure_views;

/** Their names, and where the scene's own stand. @return NOOK_E_MEMORY; *out_views untouched then */
nook_result nook_measure_views_create(const nook_scene *scene, const nook_sweep *sweep, nook_measure_views *out_views);
void nook_measure_views_free(nook_measure_views *views); /**< Zeroed ones are allowed. */

/** Where the sampled ones stand: a search, so only when something is measured. @return why there are none */
nook_result nook_measure_views_find(const nook_scene *scene, double aspect, nook_measure_views *views);
