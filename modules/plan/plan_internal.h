/** plan_internal.h - the rules of the planner, one file each, inside modules/plan only. They fill in what `plan` holds, in this order. */
#pragma once
#include "modules/plan/plan.h"

/** Voxels along the longest side that planned volumes have: bakes of one level serve whatever asks for it. */
enum { PLAN_LEVEL_LOWEST = 16 };

/** The fewest voxels of a level that are `wanted` or more; 512 at the most. */
uint32_t plan_level_at_least(double wanted);
/** The next lower level; the same for the lowest. */
uint32_t plan_level_below(uint32_t resolution);

/** Metres of a voxel in the world, at the largest instance. */
double plan_voxel_metres(const nook_plan_volume *volume, uint32_t resolution);

/** Which bodies are marched: fills in plan->occluders and plan->bound. @return NOOK_E_MEMORY */
nook_result plan_leave_out(const nook_plan_scene *scene, nook_plan *plan);
/** Which volumes are baked and for whom: `volume` and `why` of plan->volumes. */
void plan_find_twins(const nook_plan_scene *scene, nook_plan *plan);
/** How fine those are. */
void plan_choose_levels(const nook_plan_scene *scene, nook_plan *plan);
/** Which static parts share a volume: group_of_part and groups. @return NOOK_E_MEMORY */
nook_result plan_group_parts(const nook_plan_scene *scene, nook_plan *plan);
/** Holds all of it within the memory allowed. @return NOOK_E_RANGE */
nook_result plan_fit_memory(const nook_plan_scene *scene, nook_plan *plan);
