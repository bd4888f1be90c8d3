#include "game/view/orbit.h"
#include "engine/core/angle.h"
#include "engine/core/vector.h"
#include <math.h>

static const double pitch_limit = 1.55; /* just short of straight up, where yaw would mean nothing */

/* Unit axes in the world: right, up, forward. */
static void axes(const nook_orbit *orbit, double right[3], double up[3], double forward[3])
{
    double sy = sin(orbit->yaw), cy = cos(orbit->yaw), sp = sin(orbit->pitch), cp = cos(orbit->pitch);
    right[0] = cy, right[1] = 0.0, right[2] = -sy;
    up[0] = sy * sp, up[1] = cp, up[2] = cy * sp;
    forward[0] = -sy * cp, forward[1] = sp, forward[2] = -cy * cp;
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

nook_orbit nook_orbit_from_camera(const nook_camera *camera, const double centre[3], double shortest, double longest)
{
    nook_orbit orbit = { .fov_y_radians = camera->fov_y_radians, .z_near = camera->z_near };
    nook_matrix world_from_view;
    const double origin[3] = { 0.0, 0.0, 0.0 }, ahead[3] = { 0.0, 0.0, -1.0 };
    double eye[3], forward[3], towards[3];
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    nook_matrix_apply_vector(&world_from_view, ahead, forward);
    orbit.pitch = clamp(asin(clamp(forward[1], -1.0, 1.0)), -pitch_limit, pitch_limit);
    orbit.yaw = atan2(-forward[0], -forward[2]);
    nook_vector_add_scaled(centre, -1.0, eye, towards);
    orbit.distance = clamp(nook_vector_dot(towards, forward), shortest, longest);
    nook_vector_add_scaled(eye, orbit.distance, forward, orbit.target);
    return orbit;
}

nook_camera nook_orbit_camera(const nook_orbit *orbit)
{
    double right[3], up[3], forward[3], eye[3];
    axes(orbit, right, up, forward);
    nook_vector_add_scaled(orbit->target, -orbit->distance, forward, eye);
    return (nook_camera){ nook_matrix_look_at(eye, orbit->target, up), orbit->fov_y_radians, orbit->z_near };
}

void nook_orbit_turn(nook_orbit *orbit, double yaw_radians, double pitch_radians)
{
    orbit->yaw = remainder(orbit->yaw + yaw_radians, 2.0 * NOOK_PI);
    orbit->pitch = clamp(orbit->pitch + pitch_radians, -pitch_limit, pitch_limit);
}

void nook_orbit_pan(nook_orbit *orbit, double right, double up)
{
    double x[3], y[3], forward[3];
    axes(orbit, x, y, forward);
    nook_vector_add_scaled(orbit->target, right, x, orbit->target);
    nook_vector_add_scaled(orbit->target, up, y, orbit->target);
}

void nook_orbit_zoom(nook_orbit *orbit, double steps)
{
    orbit->distance = clamp(orbit->distance * pow(0.9, steps), 1e-9, 1e12);
}

void nook_orbit_fly(nook_orbit *orbit, double forward, double right, double up)
{
    double x[3], y[3], z[3];
    axes(orbit, x, y, z);
    nook_vector_add_scaled(orbit->target, forward, z, orbit->target);
    nook_vector_add_scaled(orbit->target, right, x, orbit->target);
    orbit->target[1] += up;
}
