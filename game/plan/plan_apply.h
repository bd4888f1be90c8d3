/** plan_apply.h - a plan, and what it makes of the bodies that were collected. */
#pragma once
#include "game/volumes.h"
#include "modules/plan/plan.h"

/**
 * Plans what volumes->plan asks for and applies it: to be called between collecting and baking. Nothing in mode off.
 * @return as nook_plan_describe, nook_plan_make and nook_plan_apply; the volumes can be freed in any case
 */
nook_result nook_plan_apply_to(const nook_scene *scene, nook_scene_volumes *volumes);

/**
 * Applies a plan that was made of a description of these volumes: bodies use their twins' volumes, those that are left out are marked,
 * the static volume is split, resolutions are the plan's.
 * @return NOOK_E_MEMORY; the volumes can only be freed then
 */
nook_result nook_plan_apply(const nook_plan *plan, nook_scene_volumes *volumes);
