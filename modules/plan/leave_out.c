#include "modules/plan/plan_internal.h"
#include <math.h>
#include <stdlib.h>

/* How far from a body's triangles a ray may meet its voxels, in voxels: 1.5 sqrt(3) of them that are set and filtered, and the slab of
   the guard, sqrt(3) / 2 + 1, along which lifted rays start (docs/plan.md). */
static const double voxels_around = 4.5;

/* A body as rays meet it. */
typedef struct marched {
    uint32_t index;
    const nook_plan_occluder *occluder;
    nook_plan_box box;
    double radius;
} marched;

static bool is_seen(const nook_plan_view *view, const nook_plan_box *box)
{
    for (int i = 0; view && i < 5; i++) {
        const double *plane = view->planes[i];
        double farthest = plane[3];
        for (int axis = 0; axis < 3; axis++)
            farthest += fmax(plane[axis] * box->min[axis], plane[axis] * box->max[axis]);
        if (farthest < 0.0)
            return false;
    }
    return true;
}

/* The most that a body takes of any point of a surface. */
static double bound_at(const nook_plan_scene *scene, const marched *body, const nook_plan_receiver *receiver)
{
    double gap = nook_plan_box_gap(&body->box, &receiver->box);
    if (gap >= scene->r_max || !is_seen(scene->view, &receiver->box))
        return 0.0;
    if (receiver->occluder == body->index)
        return body->occluder->alone ? 0.0 : 1.0;
    double above = nook_plan_point_gap(&receiver->box, body->occluder->centre) - body->radius;
    if (scene->ray_share)
        return scene->ray_share(scene->user, nook_plan_sphere_sine(body->radius, above));
    return fmin(nook_plan_sphere_bound(body->radius, above), nook_plan_face_bound(&body->box, gap));
}

static marched march(const nook_plan_scene *scene, uint32_t index)
{
    const nook_plan_occluder *occluder = &scene->occluders[index];
    const nook_plan_volume *volume = &scene->volumes[occluder->volume];
    double around = voxels_around * plan_voxel_metres(volume, volume->resolution);
    return (marched){ .index = index,
                      .occluder = occluder,
                      .box = nook_plan_box_grow(&occluder->box, around),
                      .radius = occluder->radius + around };
}

static double largest_bound(const nook_plan_scene *scene, const marched *body)
{
    double bound = 0.0;
    for (uint32_t i = 0; i < scene->receiver_count && bound < 1.0; i++)
        bound = fmax(bound, bound_at(scene, body, &scene->receivers[i]));
    return bound;
}

/* Spends what a body takes at each receiver, unless that is more than is left at one. */
static bool spend(const nook_plan_scene *scene, const marched *body, double error, double *spent)
{
    for (uint32_t i = 0; i < scene->receiver_count; i++)
        if (spent[i] + bound_at(scene, body, &scene->receivers[i]) > error)
            return false;
    for (uint32_t i = 0; i < scene->receiver_count; i++)
        spent[i] += bound_at(scene, body, &scene->receivers[i]);
    return true;
}

/* A body in the order in which they are asked: those that take the least first, so that most are left out. */
typedef struct turn {
    double bound;
    uint32_t index;
} turn;

static int compare_turns(const void *a, const void *b)
{
    const turn *x = a, *y = b;
    if (x->bound != y->bound)
        return x->bound < y->bound ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

static void leave_out(const nook_plan_scene *scene, nook_plan *plan, turn *turns, double *spent)
{
    double error = (double)plan->params.error;
    for (uint32_t i = 0; i < scene->occluder_count; i++) {
        marched body = march(scene, i);
        turns[i] = (turn){ largest_bound(scene, &body), i };
    }
    qsort(turns, scene->occluder_count, sizeof *turns, compare_turns);
    for (uint32_t i = 0; i < scene->occluder_count; i++) {
        nook_plan_occluder_choice *choice = &plan->occluders[turns[i].index];
        marched body = march(scene, turns[i].index);
        choice->bound = turns[i].bound;
        if (choice->bound <= error && spend(scene, &body, error, spent))
            choice->rule = choice->bound > 0.0 ? NOOK_PLAN_TOO_SMALL : NOOK_PLAN_OUT_OF_REACH;
    }
    for (uint32_t i = 0; i < scene->receiver_count; i++)
        plan->bound = fmax(plan->bound, spent[i]);
}

nook_result plan_leave_out(const nook_plan_scene *scene, nook_plan *plan)
{
    for (uint32_t i = 0; i < scene->occluder_count; i++)
        plan->occluders[i] = (nook_plan_occluder_choice){ NOOK_PLAN_KEPT, 1.0 };
    if (scene->moves || scene->receiver_count == 0)
        return NOOK_OK;
    turn *turns = calloc((size_t)scene->occluder_count + 1, sizeof *turns);
    double *spent = calloc(scene->receiver_count, sizeof *spent);
    nook_result result = turns && spent ? NOOK_OK : NOOK_E_MEMORY;
    if (result == NOOK_OK)
        leave_out(scene, plan, turns, spent);
    free(turns);
    free(spent);
    return result;
}
