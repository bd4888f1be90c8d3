#include "engine/core/surface.h"
#include "engine/core/vector.h"

bool nook_surface_joins(const nook_surface_point *a, const nook_surface_point *b)
{
    double near_a = -a->position[2], near_b = -b->position[2], between[3];
    double step_x = b->position[0] / near_b - a->position[0] / near_a;
    double step_y = b->position[1] / near_b - a->position[1] / near_a;
    double step = fmax(sqrt(step_x * step_x + step_y * step_y), NOOK_SURFACE_ROUNDING);
    nook_vector_add_scaled(b->position, -1.0, a->position, between);
    return fabs(nook_vector_dot(between, a->normal)) <= step * near_b ||
           fabs(nook_vector_dot(between, b->normal)) <= step * near_a;
}
