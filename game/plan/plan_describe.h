/** plan_describe.h - a scene as the planner wants it: boxes, spheres, parts, pieces of surface. */
#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"
#include "game/volumes.h"
#include "modules/plan/plan.h"

enum { NOOK_PLAN_SINES = 256 /* places of a table over the sine of a cone */ };

/** What a plan is made for. Zero is what a scene that stands still is. */
typedef struct nook_plan_situation {
    bool moves;                /**< Bodies will not stay where they stand. */
    bool multiplies;           /**< nook_setting_multiplies: several volumes are not joined exactly. */
    const nook_camera *camera; /**< Seen from there only; NULL: from anywhere. */
    double aspect;             /**< Width / height, with a camera. */
    uint32_t height;           /**< Pixels, with a camera. */
} nook_plan_situation;

/** Owns what `scene` points to. */
typedef struct nook_plan_description {
    nook_plan_scene scene; /**< To be planned; must stay where it is, it points into this struct. */
    nook_plan_volume *volumes;
    nook_plan_occluder *occluders;
    nook_plan_receiver *receivers;
    nook_plan_part *parts;
    nook_plan_view view;
    double ray_shares[NOOK_PLAN_SINES + 1]; /**< At sines i / NOOK_PLAN_SINES. */
} nook_plan_description;

/**
 * @param volumes  collected, with its triangles
 * @param rays     nook_plan_params.rays
 * @return NOOK_E_MEMORY; *out can be freed in any case
 */
nook_result nook_plan_describe(const nook_scene *scene, const nook_scene_volumes *volumes, uint32_t rays,
                               const nook_plan_situation *situation, nook_plan_description *out);
void nook_plan_description_free(nook_plan_description *description); /**< Becomes zero. */
