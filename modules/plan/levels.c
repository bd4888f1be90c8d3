#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "modules/plan/plan_internal.h"
#include <math.h>

/* ---- What was measured ------------------------------------------------------------------------------------------ */

/* RMS of visibility against truth by voxels per r_max: docs/plan.md has the scenes, the command and all numbers. */
static const struct {
    double voxels_per_r_max, error;
} measured[] = { { 4.0, 0.162 }, { 8.0, 0.142 }, { 16.0, 0.124 }, { 32.0, 0.058 }, { 64.0, 0.044 } };

double nook_plan_level_error(double voxels_per_r_max)
{
    if (voxels_per_r_max <= measured[0].voxels_per_r_max)
        return voxels_per_r_max == measured[0].voxels_per_r_max ? measured[0].error : 1.0;
    for (size_t i = 1; i < NOOK_COUNT(measured); i++) {
        double low = measured[i - 1].voxels_per_r_max, high = measured[i].voxels_per_r_max;
        double share = log(voxels_per_r_max / low) / log(high / low);
        if (voxels_per_r_max <= high)
            return measured[i - 1].error + share * (measured[i].error - measured[i - 1].error);
    }
    return measured[NOOK_COUNT(measured) - 1].error; /* finer ones were not measured, and are no worse */
}

double nook_plan_level_for(double error)
{
    size_t last = NOOK_COUNT(measured) - 1;
    if (error >= measured[0].error)
        return measured[0].voxels_per_r_max;
    for (size_t i = 1; i <= last; i++) {
        double low = measured[i - 1].voxels_per_r_max, high = measured[i].voxels_per_r_max;
        double share = (measured[i - 1].error - error) / (measured[i - 1].error - measured[i].error);
        if (error >= measured[i].error)
            return low * pow(high / low, share);
    }
    return measured[last].voxels_per_r_max;
}

/* ---- Levels ----------------------------------------------------------------------------------------------------- */

static const uint32_t levels[] = { PLAN_LEVEL_LOWEST, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512 };

uint32_t plan_level_at_least(double wanted)
{
    for (size_t i = 0; i < NOOK_COUNT(levels); i++)
        if (levels[i] >= wanted)
            return levels[i];
    return levels[NOOK_COUNT(levels) - 1];
}

uint32_t plan_level_below(uint32_t resolution)
{
    for (size_t i = NOOK_COUNT(levels); i-- > 0;)
        if (levels[i] < resolution)
            return levels[i];
    return resolution;
}

static double longest(const double sides[3])
{
    return fmax(sides[0], fmax(sides[1], sides[2]));
}

double plan_voxel_metres(const nook_plan_volume *volume, uint32_t resolution)
{
    return longest(volume->sides) * volume->scale / resolution;
}

uint64_t nook_plan_voxel_bytes(const double sides[3], uint32_t resolution)
{
    double voxel = longest(sides) / resolution;
    uint64_t bytes = 1;
    for (int axis = 0; axis < 3; axis++) {
        double inner =
            voxel > 0.0 ? fmax(1.0, ceil(sides[axis] / voxel - 1e-6)) : 1.0; /* as modules/bake/triangle_grid.c */
        bytes *= (uint64_t)inner + 2;
    }
    return bytes;
}

/* Metres of a pixel where a volume's bodies darken something nearest to the eye. */
static double nearest_pixel(const nook_plan_scene *scene, const nook_plan *plan, uint32_t volume)
{
    double nearest = INFINITY;
    for (uint32_t i = 0; scene->view && i < scene->occluder_count; i++) {
        const nook_plan_occluder *occluder = &scene->occluders[i];
        if (plan->occluders[i].rule == NOOK_PLAN_KEPT && plan->volumes[occluder->volume].volume == volume)
            nearest = fmin(nearest, nook_plan_point_gap(&occluder->box, scene->view->eye) - scene->r_max);
    }
    return scene->view && isfinite(nearest) ? fmax(nearest, 0.0) * scene->view->pixel_metres : 0.0;
}

static void choose_level(const nook_plan_scene *scene, nook_plan *plan, uint32_t index)
{
    const nook_plan_volume *volume = &scene->volumes[index];
    nook_plan_volume_choice *choice = &plan->volumes[index];
    double by_error = scene->r_max / nook_plan_level_for((double)plan->params.level_error);
    double by_pixel = nearest_pixel(scene, plan, index);
    double size = longest(volume->sides) * volume->scale;
    uint32_t level = plan_level_at_least(size / fmax(by_error, by_pixel));
    if (level >= choice->resolution)
        return;
    choice->resolution = level;
    choice->why = by_pixel > by_error ? NOOK_PLAN_BY_PIXEL : NOOK_PLAN_BY_ERROR;
}

void plan_choose_levels(const nook_plan_scene *scene, nook_plan *plan)
{
    for (uint32_t i = 0; i < scene->volume_count; i++)
        if (plan->volumes[i].resolution > 0)
            choose_level(scene, plan, i);
}

/* ---- Memory ----------------------------------------------------------------------------------------------------- */

/* A volume or a group, whichever can be made coarser. */
typedef struct knob {
    double sides[3];
    double metres; /* of the longest side, in the world */
    uint32_t *resolution;
    nook_plan_fineness *why; /* NULL for groups */
} knob;

static knob volume_knob(const nook_plan_scene *scene, nook_plan *plan, uint32_t index)
{
    const nook_plan_volume *volume = &scene->volumes[index];
    return (knob){ { volume->sides[0], volume->sides[1], volume->sides[2] },
                   longest(volume->sides) * volume->scale,
                   &plan->volumes[index].resolution,
                   &plan->volumes[index].why };
}

static knob group_knob(nook_plan_group *group)
{
    knob k = { .resolution = &group->resolution };
    for (int axis = 0; axis < 3; axis++)
        k.sides[axis] = group->box.max[axis] - group->box.min[axis];
    k.metres = longest(k.sides);
    return k;
}

/* The index-th of both: volumes, then groups. @return false: it is not baked */
static bool knob_at(const nook_plan_scene *scene, nook_plan *plan, uint32_t index, knob *out)
{
    *out = index < scene->volume_count ? volume_knob(scene, plan, index)
                                       : group_knob(&plan->groups[index - scene->volume_count]);
    return *out->resolution > 0;
}

static double error_of(const nook_plan_scene *scene, const knob *k, uint32_t resolution)
{
    return nook_plan_level_error(scene->r_max * resolution / k->metres);
}

/* Bytes and errors of what was chosen. */
static void sum_up(const nook_plan_scene *scene, nook_plan *plan)
{
    plan->bytes = 0;
    plan->level_error = 0.0;
    for (uint32_t i = 0; i < scene->volume_count + plan->group_count; i++) {
        knob k;
        if (!knob_at(scene, plan, i, &k))
            continue;
        uint64_t bytes = nook_plan_voxel_bytes(k.sides, *k.resolution);
        double error = error_of(scene, &k, *k.resolution);
        plan->bytes += bytes;
        plan->level_error = fmax(plan->level_error, error);
        if (i >= scene->volume_count) {
            plan->groups[i - scene->volume_count].bytes = bytes;
        } else {
            plan->volumes[i].bytes = bytes;
            plan->volumes[i].error = error;
        }
    }
}

/* Makes that one coarser whose error is the smallest afterwards: the largest error of all rises as little as can be. */
static bool coarsen(const nook_plan_scene *scene, nook_plan *plan)
{
    knob best = { .resolution = NULL };
    double least = INFINITY;
    for (uint32_t i = 0; i < scene->volume_count + plan->group_count; i++) {
        knob k;
        if (!knob_at(scene, plan, i, &k) || plan_level_below(*k.resolution) == *k.resolution)
            continue;
        double error = error_of(scene, &k, plan_level_below(*k.resolution));
        bool finer = best.resolution && *k.resolution > *best.resolution;
        if (error < least || (error == least && finer)) {
            least = error;
            best = k;
        }
    }
    if (!best.resolution)
        return false;
    *best.resolution = plan_level_below(*best.resolution);
    if (best.why)
        *best.why = NOOK_PLAN_BY_MEMORY;
    return true;
}

nook_result plan_fit_memory(const nook_plan_scene *scene, nook_plan *plan)
{
    double allowed = (double)plan->params.memory;
    sum_up(scene, plan);
    bool coarser = plan->params.mode == NOOK_PLAN_MEASURED;
    while (coarser && (double)plan->bytes > allowed * NOOK_MIB && coarsen(scene, plan))
        sum_up(scene, plan);
    if (plan->params.mode == NOOK_PLAN_OFF || (double)plan->bytes <= allowed * NOOK_MIB)
        return NOOK_OK;
    double need = ceil((double)plan->bytes / NOOK_MIB * 1e3) * 1e-3;
    if (coarser)
        return nook_fail(
            NOOK_E_RANGE,
            "plan: voxels may take %g MiB, and with %d a side for every body they take %.3f; set plan.memory to "
            "that or more, or leave bodies out of the scene",
            allowed, PLAN_LEVEL_LOWEST, need);
    return nook_fail(
        NOOK_E_RANGE,
        "plan: voxels may take %g MiB, and what is proven needs %.3f; set plan.memory to that or more, or plan to "
        "measured, which may take coarser voxels",
        allowed, need);
}
