#include "engine/core/mebibyte.h"
#include "modules/plan/plan_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Groups of parts while they are joined. */
typedef struct joining {
    nook_plan_group *groups;
    uint32_t *group_of_part;
    uint32_t count;
    double voxel;       /* metres */
    double least_saved; /* bytes that a volume more must save */
} joining;

enum {
    PAIRS_MAX = 256, /* groups of which all pairs are looked at */
    GROUPS_MAX = 64  /* volumes that a static body may become */
};

static nook_plan_box join_boxes(const nook_plan_box *a, const nook_plan_box *b)
{
    nook_plan_box both;
    for (int axis = 0; axis < 3; axis++) {
        both.min[axis] = fmin(a->min[axis], b->min[axis]);
        both.max[axis] = fmax(a->max[axis], b->max[axis]);
    }
    return both;
}

static double bytes_of(const joining *j, const nook_plan_box *box)
{
    double bytes = 1.0;
    for (int axis = 0; axis < 3; axis++)
        bytes *= fmax(1.0, ceil((box->max[axis] - box->min[axis]) / j->voxel - 1e-6)) + 2.0;
    return bytes;
}

/* What two volumes take more than one of both. */
static double saved_by_joining(const joining *j, uint32_t a, uint32_t b)
{
    nook_plan_box both = join_boxes(&j->groups[a].box, &j->groups[b].box);
    return bytes_of(j, &j->groups[a].box) + bytes_of(j, &j->groups[b].box) + j->least_saved - bytes_of(j, &both);
}

static void join(joining *j, uint32_t part_count, uint32_t a, uint32_t b)
{
    uint32_t last = --j->count;
    j->groups[a].box = join_boxes(&j->groups[a].box, &j->groups[b].box);
    j->groups[a].parts += j->groups[b].parts;
    j->groups[b] = j->groups[last];
    for (uint32_t i = 0; i < part_count; i++) {
        if (j->group_of_part[i] == b)
            j->group_of_part[i] = a;
        else if (j->group_of_part[i] == last)
            j->group_of_part[i] = b;
    }
}

/* The partner with which group `a` saves most, of those behind it. @return what that saves */
static double best_partner(const joining *j, uint32_t a, uint32_t *out_b)
{
    double most = -INFINITY;
    for (uint32_t b = a + 1; b < j->count; b++) {
        double saved = saved_by_joining(j, a, b);
        if (saved > most) {
            most = saved;
            *out_b = b;
        }
    }
    return most;
}

/* The pair that saves most. Of very many groups only the first one looks for a partner. */
static void join_best_pair(joining *j, uint32_t part_count)
{
    uint32_t best_a = 0, best_b = 1;
    double most = -INFINITY;
    for (uint32_t a = 0; a + 1 < j->count && (a == 0 || j->count <= PAIRS_MAX); a++) {
        uint32_t b = a + 1;
        double saved = best_partner(j, a, &b);
        if (saved > most) {
            most = saved;
            best_a = a;
            best_b = b;
        }
    }
    join(j, part_count, best_a, best_b);
}

/* What all of it takes, and what each volume but the first must save. */
static double cost_of(const joining *j)
{
    double cost = 0.0;
    for (uint32_t i = 0; i < j->count; i++)
        cost += bytes_of(j, &j->groups[i].box) + (i > 0 ? j->least_saved : 0.0);
    return cost;
}

/* Joins until one is left, and goes back to the cheapest that was on the way. @param best  room for as many groups and parts */
static void join_all(joining *j, uint32_t part_count, joining *best)
{
    double least = INFINITY;
    for (;;) {
        double cost = j->count <= GROUPS_MAX ? cost_of(j) : INFINITY;
        if (cost <= least) {
            least = cost;
            best->count = j->count;
            memcpy(best->groups, j->groups, j->count * sizeof *j->groups);
            memcpy(best->group_of_part, j->group_of_part, part_count * sizeof *j->group_of_part);
        }
        if (j->count == 1)
            return;
        join_best_pair(j, part_count);
    }
}

/* Of the voxels that the static volume would have. */
static void choose_resolutions(joining *j)
{
    for (uint32_t i = 0; i < j->count; i++) {
        const nook_plan_box *box = &j->groups[i].box;
        double longest = 0.0;
        for (int axis = 0; axis < 3; axis++)
            longest = fmax(longest, box->max[axis] - box->min[axis]);
        j->groups[i].resolution = (uint32_t)fmax(1.0, ceil(longest / j->voxel - 1e-6));
    }
}

/* Each part alone. */
static void begin(const nook_plan_scene *scene, joining *j)
{
    for (uint32_t i = 0; i < scene->part_count; i++) {
        j->groups[i] = (nook_plan_group){ .box = scene->parts[i].box, .parts = 1 };
        j->group_of_part[i] = i;
    }
}

nook_result plan_group_parts(const nook_plan_scene *scene, nook_plan *plan)
{
    uint32_t whole = scene->static_volume;
    if (whole == NOOK_PLAN_NONE || scene->part_count < 2 || !scene->exact_union || plan->volumes[whole].resolution == 0)
        return NOOK_OK;
    joining best = { .groups = calloc(scene->part_count, sizeof *best.groups),
                     .group_of_part = plan->group_of_part,
                     .voxel = plan_voxel_metres(&scene->volumes[whole], plan->volumes[whole].resolution),
                     .least_saved = (double)plan->params.split * NOOK_MIB };
    joining j = best;
    j.count = scene->part_count;
    j.groups = calloc(scene->part_count, sizeof *j.groups);
    j.group_of_part = calloc(scene->part_count, sizeof *j.group_of_part);
    if (j.groups && j.group_of_part && best.groups) {
        begin(scene, &j);
        join_all(&j, scene->part_count, &best);
        choose_resolutions(&best);
    }
    bool made = best.count > 0;
    plan->groups = best.groups;
    plan->group_count = best.count > 1 ? best.count : 0;
    if (plan->group_count > 0)
        plan->volumes[whole] = (nook_plan_volume_choice){ .why = NOOK_PLAN_UNUSED, .volume = whole };
    free(j.groups);
    free(j.group_of_part);
    return made ? NOOK_OK : NOOK_E_MEMORY;
}
