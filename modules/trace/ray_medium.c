#include "modules/trace/ray_medium.h"
#include "modules/trace/ray_chance.h"
#include <math.h>
#include <stdlib.h>

struct nook_ray_medium {
    const nook_medium *medium;
    uint32_t id;
};

/* ---- A walk from cell to cell ------------------------------------------------------------------------------------ */

/* The part of [near, far) inside of the medium. */
static void clip(const nook_medium *m, const double origin[3], const double direction[3], double *near, double *far)
{
    for (int axis = 0; axis < 3; axis++) {
        double side = m->spacing[axis] * m->size[axis];
        if (direction[axis] == 0.0) {
            if (!(origin[axis] >= 0.0 && origin[axis] < side))
                *far = -INFINITY;
            continue;
        }
        double a = -origin[axis] / direction[axis], b = (side - origin[axis]) / direction[axis];
        *near = fmax(*near, fmin(a, b));
        *far = fmin(*far, fmax(a, b));
    }
}

static int64_t cell_at(const nook_medium *m, int axis, double position)
{
    double cell = floor(position / m->spacing[axis]), last = (double)m->size[axis] - 1.0;
    return (int64_t)fmin(fmax(cell, 0.0), last);
}

double nook_medium_stop(const nook_medium *m, const double origin[3], const double direction[3], double near,
                        double far, double left)
{
    double metre = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    double depth = -log(left);
    int64_t cell[3];
    clip(m, origin, direction, &near, &far);
    if (!(near < far))
        return INFINITY;
    for (int axis = 0; axis < 3; axis++)
        cell[axis] = cell_at(m, axis, origin[axis] + near * direction[axis]);
    for (double t = near; t < far;) {
        int nearest = 0;
        double exits[3];
        for (int axis = 0; axis < 3; axis++) {
            double face = m->spacing[axis] * (double)(cell[axis] + (direction[axis] > 0.0));
            exits[axis] = direction[axis] == 0.0 ? HUGE_VAL : (face - origin[axis]) / direction[axis];
            nearest = exits[axis] < exits[nearest] ? axis : nearest;
        }
        double leave = fmax(exits[nearest], t);
        size_t index = ((size_t)cell[2] * m->size[1] + (size_t)cell[1]) * m->size[0] + (size_t)cell[0];
        double extinction = (double)m->extinction[index] * metre, taken = extinction * (fmin(leave, far) - t);
        if (taken > depth) {
            double stop = t + depth / extinction;
            return stop < far ? stop : HUGE_VAL;
        }
        depth -= taken;
        t = leave;
        cell[nearest] += direction[nearest] > 0.0 ? 1 : -1;
        if (cell[nearest] < 0 || cell[nearest] >= (int64_t)m->size[nearest])
            break;
    }
    return INFINITY;
}

/* ---- Embree's questions ------------------------------------------------------------------------------------------ */

static void find_box(const struct RTCBoundsFunctionArguments *asked)
{
    const nook_medium *m = ((const nook_ray_medium *)asked->geometryUserPtr)->medium;
    asked->bounds_o->lower_x = asked->bounds_o->lower_y = asked->bounds_o->lower_z = 0.0f;
    asked->bounds_o->upper_x = nextafterf((float)(m->spacing[0] * m->size[0]), INFINITY);
    asked->bounds_o->upper_y = nextafterf((float)(m->spacing[1] * m->size[1]), INFINITY);
    asked->bounds_o->upper_z = nextafterf((float)(m->spacing[2] * m->size[2]), INFINITY);
}

static double stop_of(const nook_ray_medium *m, const void *rays, unsigned n, unsigned i)
{
    double origin[3], direction[3];
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = (double)number_of(rays, n, i, RAY_ORIGIN + axis);
        direction[axis] = (double)number_of(rays, n, i, RAY_DIRECTION + axis);
    }
    double near = fmax((double)number_of(rays, n, i, RAY_NEAR), 0.0);
    return nook_medium_stop(m->medium, origin, direction, near, (double)number_of(rays, n, i, RAY_FAR),
                            1.0 - chance(rays, n, i, ~m->id)); /* triangles count from 0: no bits in common */
}

static void put(void *packet, unsigned n, unsigned i, int which, const void *bits)
{
    memcpy((char *)packet + ((size_t)which * n + i) * sizeof(uint32_t), bits, sizeof(uint32_t));
}

static void intersect(const struct RTCIntersectFunctionNArguments *asked)
{
    unsigned n = asked->N;
    for (unsigned i = 0; i < n; i++) {
        if (asked->valid[i] != -1)
            continue;
        float stop = (float)stop_of(asked->geometryUserPtr, asked->rayhit, n, i);
        if (!(stop < number_of(asked->rayhit, n, i, RAY_FAR)))
            continue;
        void *hits = (char *)asked->rayhit + (size_t)RAY_NUMBERS * n * sizeof(uint32_t);
        const uint32_t zero = 0;
        put(asked->rayhit, n, i, RAY_FAR, &stop);
        for (int number = HIT_NORMAL; number <= HIT_V; number++)
            put(hits, n, i, number, &zero);
        put(hits, n, i, HIT_TRIANGLE, &asked->primID);
        put(hits, n, i, HIT_GEOMETRY, &asked->geomID);
        put(hits, n, i, HIT_INSTANCE, &asked->context->instID[0]);
    }
}

static void occlude(const struct RTCOccludedFunctionNArguments *asked)
{
    const float hit = -INFINITY;
    for (unsigned i = 0; i < asked->N; i++)
        if (asked->valid[i] == -1 && isfinite(stop_of(asked->geometryUserPtr, asked->ray, asked->N, i)))
            put(asked->ray, asked->N, i, RAY_FAR, &hit);
}

nook_ray_medium *nook_ray_medium_create(const nook_medium *medium, uint32_t id)
{
    nook_ray_medium *made = malloc(sizeof *made);
    if (made)
        *made = (nook_ray_medium){ medium, id };
    return made;
}

void nook_ray_medium_destroy(nook_ray_medium *medium)
{
    free(medium);
}

RTCGeometry nook_ray_medium_geometry(RTCDevice device, nook_ray_medium *medium)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (!geometry)
        return NULL;
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, medium);
    rtcSetGeometryBoundsFunction(geometry, find_box, NULL);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occlude);
    return geometry;
}
