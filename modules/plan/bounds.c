#include "modules/plan/bounds.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;

double nook_plan_box_gap(const nook_plan_box *a, const nook_plan_box *b)
{
    double between[3];
    for (int axis = 0; axis < 3; axis++)
        between[axis] = fmax(0.0, fmax(a->min[axis] - b->max[axis], b->min[axis] - a->max[axis]));
    return nook_vector_length(between);
}

double nook_plan_point_gap(const nook_plan_box *box, const double point[3])
{
    nook_plan_box at;
    for (int axis = 0; axis < 3; axis++)
        at.min[axis] = at.max[axis] = point[axis];
    return nook_plan_box_gap(box, &at);
}

nook_plan_box nook_plan_box_grow(const nook_plan_box *box, double by)
{
    nook_plan_box grown = *box;
    for (int axis = 0; axis < 3; axis++) {
        grown.min[axis] -= by;
        grown.max[axis] += by;
    }
    return grown;
}

double nook_plan_sphere_sine(double radius, double gap)
{
    return gap > 0.0 ? radius / (radius + gap) : 1.0;
}

double nook_plan_sphere_bound(double radius, double gap)
{
    double sine = nook_plan_sphere_sine(radius, gap);
    return sine * sine;
}

double nook_plan_face_bound(const nook_plan_box *box, double gap)
{
    double a = box->max[0] - box->min[0], b = box->max[1] - box->min[1], c = box->max[2] - box->min[2];
    double faces = a * b + b * c + c * a;
    return gap > 0.0 ? fmin(1.0, faces / (pi * gap * gap)) : 1.0;
}

/* Rays of one pixel within an angle of one of them. */
static uint32_t count_around(const float *directions, uint32_t rays, const float *middle, double cosine)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < rays; i++) {
        const float *d = directions + (size_t)i * 4;
        double dot = (double)d[0] * middle[0] + (double)d[1] * middle[1] + (double)d[2] * middle[2];
        count += dot >= cosine;
    }
    return count;
}

double nook_plan_ray_share(const float *directions, uint32_t blocks, uint32_t rays, double sine)
{
    static const double rounding = 1e-6; /* of the floats' directions */
    if (sine >= sqrt(0.5))
        return 1.0; /* twice the angle is a right one or more */
    double cosine = 1.0 - 2.0 * sine * sine - rounding;
    uint32_t most = 0;
    for (uint32_t block = 0; block < blocks; block++) {
        const float *own = directions + (size_t)block * rays * 4;
        for (uint32_t i = 0; i < rays; i++) {
            uint32_t count = count_around(own, rays, own + (size_t)i * 4, cosine);
            most = count > most ? count : most;
        }
    }
    return (double)most / rays;
}
