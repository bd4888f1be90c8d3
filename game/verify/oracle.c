#include "game/verify/oracle.h"
#include "engine/core/vector.h"
#include "modules/ao/sampling.h"
#include "modules/fixture/draw.h"
#include <math.h>

static const double PI = 3.14159265358979323846;
static const double TAU = 3.0; /* of the exponential: the initial ao.falloff_tau */

static nook_fixture_hit cast(const nook_verify_scene *scene, const double from[3], const double ray[3],
                             bool with_ground)
{
    nook_fixture_hit hit = { .distance = INFINITY };
    for (uint32_t i = 0; i < scene->object_count; i++)
        nook_fixture_cast(&scene->objects[i], from, ray, &hit);
    if (with_ground)
        nook_fixture_cast(&scene->ground, from, ray, &hit);
    return hit;
}

/** Whether a point in view space lies in the square picture. */
static bool in_picture(const nook_verify_camera *camera, const double at[3])
{
    double limit = -at[2] * tan(camera->angle / 2.0);
    return fabs(at[0]) < limit && fabs(at[1]) < limit;
}

/** Where the line of sight to a point ends, in parts of the way; over 1 when nothing is before or at it. */
static double sight_ends(const nook_verify_scene *scene, const nook_verify_camera *camera, const double point[3])
{
    double ray[3];
    nook_vector_add_scaled(point, -1.0, camera->eye, ray);
    return cast(scene, camera->eye, ray, true).distance;
}

bool nook_verify_sees(const nook_verify_scene *scene, const nook_verify_camera *camera, const double point[3])
{
    double at[3];
    nook_matrix view_from_world = nook_verify_camera_matrix(camera);
    nook_matrix_apply_point(&view_from_world, point, at);
    return in_picture(camera, at) && sight_ends(scene, camera, point) > 1.0 - 1e-6;
}

static void direction_of(nook_form_weight weight, uint32_t index, double out[3])
{
    float u[2];
    nook_sobol_point(index, 0, u);
    double z = weight == NOOK_FORM_COSINE ? sqrt((double)u[0]) : u[0], flat = sqrt(1.0 - z * z), turn = 2.0 * PI * u[1];
    out[0] = flat * cos(turn), out[1] = flat * sin(turn), out[2] = z;
}

double nook_verify_cast_occlusion(const nook_verify_scene *scene, nook_form_weight weight,
                                  const nook_verify_camera *camera, uint32_t rays)
{
    static const double receiver[3] = { 0, 0, 0 };
    double sum = 0.0;
    for (uint32_t i = 0; i < rays; i++) {
        double ray[3], point[3];
        direction_of(weight, i, ray);
        double distance = cast(scene, receiver, ray, false).distance;
        if (!(distance < scene->r_max))
            continue;
        nook_vector_add_scaled(receiver, distance, ray, point);
        if (!camera || nook_verify_sees(scene, camera, point))
            sum += nook_falloff_evaluate(scene->falloff, distance, scene->r_max, TAU);
    }
    return sum / rays;
}

/** rho at what hides a point, 0 when nothing does. */
static double hidden_part(const nook_verify_scene *scene, const nook_verify_camera *camera,
                          const nook_matrix *view_from_world, const double point[3], double bias)
{
    double hider[3], ray[3], at[3];
    nook_matrix_apply_point(view_from_world, point, at);
    if (!in_picture(camera, at))
        return 0.0;
    double t = sight_ends(scene, camera, point), depth = -at[2];
    if (!(t * depth < depth - bias * scene->r_max))
        return 0.0;
    nook_vector_add_scaled(point, -1.0, camera->eye, ray);
    nook_vector_add_scaled(camera->eye, t, ray, hider);
    return nook_falloff_evaluate(scene->falloff, nook_vector_length(hider), scene->r_max, TAU);
}

double nook_verify_cast_half_ball(const nook_verify_scene *scene, const nook_verify_camera *camera, double bias,
                                  uint32_t points)
{
    nook_matrix view_from_world = nook_verify_camera_matrix(camera);
    double sum = 0.0;
    for (uint32_t i = 0; i < points; i++) {
        double point[3];
        direction_of(NOOK_FORM_SOLID_ANGLE, i, point);
        double radius = scene->r_max * cbrt((i * 0.7548776662466927) - floor(i * 0.7548776662466927)); /* Kronecker */
        for (int axis = 0; axis < 3; axis++)
            point[axis] *= radius;
        sum += hidden_part(scene, camera, &view_from_world, point, bias);
    }
    return sum / points;
}
