#include "game/cameras/glance.h"
#include "engine/core/order.h"
#include <math.h>

enum { SIDE = 32 }; /* rays across and up */

/* A ray through the middle of a cell of the picture; its distances are along the view. */
static nook_view_hit cast_cell(const nook_rays *rays, const nook_camera *camera, const nook_matrix *world_from_view,
                               double aspect, int x, int y)
{
    const double origin[3] = { 0.0, 0.0, 0.0 };
    double tangent = tan(0.5 * camera->fov_y_radians), eye[3], direction[3];
    const double along[3] = { (2.0 * (x + 0.5) / SIDE - 1.0) * tangent * aspect,
                              (2.0 * (y + 0.5) / SIDE - 1.0) * tangent, -1.0 };
    nook_matrix_apply_point(world_from_view, origin, eye);
    nook_matrix_apply_vector(world_from_view, along, direction);
    return nook_rays_cast(rays, eye, direction);
}

nook_glance nook_glance_at(const nook_rays *rays, const nook_camera *camera, double aspect, double near)
{
    nook_glance glance = { .spread = 1.0 };
    nook_matrix world_from_view;
    double distances[SIDE * SIDE];
    int count = 0, backs = 0, close = 0;
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    for (int i = 0; i < SIDE * SIDE; i++) {
        nook_view_hit hit = cast_cell(rays, camera, &world_from_view, aspect, i % SIDE, i / SIDE);
        if (!isfinite(hit.distance))
            continue;
        backs += !hit.front;
        close += hit.distance < near;
        distances[count++] = hit.distance;
    }
    if (count == 0)
        return glance;
    nook_order_numbers(distances, (size_t)count);
    glance.geometry = count / (double)(SIDE * SIDE);
    glance.near = close / (double)count;
    glance.backs = backs / (double)count;
    glance.median = distances[count / 2];
    glance.spread = distances[count * 9 / 10] / distances[count / 10];
    return glance;
}
