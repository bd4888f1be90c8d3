#include "game/verify/oracle.h"
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "modules/ao/sampling.h"
#include "modules/fixture/draw.h"
#include <math.h>
#include <stdlib.h>

const nook_verify_receiver nook_verify_origin = { .normal = { 0, 0, 1 } };

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

/** From the receiver's own frame to the world. */
static void turn(const double normal[3], double direction[3])
{
    double across[3], along[3], local[3] = { direction[0], direction[1], direction[2] };
    bool upright = fabs(normal[2]) > 0.9;
    nook_vector_cross((double[]){ 0, upright, !upright }, normal, across);
    nook_vector_normalize(across, across);
    nook_vector_cross(normal, across, along);
    for (int axis = 0; axis < 3; axis++)
        direction[axis] = local[0] * across[axis] + local[1] * along[axis] + local[2] * normal[axis];
}

static void direction_of(const nook_verify_receiver *receiver, nook_form_weight weight, uint32_t index, double out[3])
{
    float u[2];
    nook_sobol_point(index, 0, u);
    double z = weight == NOOK_FORM_COSINE ? sqrt((double)u[0]) : u[0], flat = sqrt(1.0 - z * z),
           azimuth = 2.0 * NOOK_PI * u[1];
    out[0] = flat * cos(azimuth), out[1] = flat * sin(azimuth), out[2] = z;
    turn(receiver->normal, out);
}

static double fade(const nook_verify_scene *scene, double distance)
{
    if (!(distance < scene->r_max))
        return 0.0;
    return nook_falloff_evaluate(scene->falloff, distance, scene->r_max, scene->tau);
}

double nook_verify_cast_occlusion(const nook_verify_scene *scene, nook_form_weight weight,
                                  const nook_verify_receiver *receiver, uint32_t rays)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < rays; i++) {
        double ray[3];
        direction_of(receiver, weight, i, ray);
        sum += fade(scene, cast(scene, receiver->point, ray, false).distance);
    }
    return sum / rays;
}

/** The rays whose first hits fall into one pixel. */
typedef struct pixel_hits {
    uint32_t count;
    double least, most; /* rho */
} pixel_hits;

static void add_hit(pixel_hits *pixels, const nook_verify_camera *camera, const nook_matrix *view_from_world,
                    const double point[3], double rho)
{
    double at[3];
    nook_matrix_apply_point(view_from_world, point, at);
    double limit = -at[2] * tan(camera->angle / 2.0);
    int x = (int)((at[0] / limit + 1.0) / 2.0 * NOOK_VERIFY_PICTURE_SIDE),
        y = (int)((at[1] / limit + 1.0) / 2.0 * NOOK_VERIFY_PICTURE_SIDE);
    pixel_hits *pixel = &pixels[y * NOOK_VERIFY_PICTURE_SIDE + x];
    pixel->least = pixel->count ? fmin(pixel->least, rho) : rho;
    pixel->most = pixel->count ? fmax(pixel->most, rho) : rho;
    pixel->count++;
}

nook_result nook_verify_look_through(const nook_verify_scene *scene, nook_form_weight weight,
                                     const nook_verify_camera *camera, uint32_t rays, nook_verify_sight *out_sight)
{
    const size_t pixel_count = (size_t)NOOK_VERIFY_PICTURE_SIDE * NOOK_VERIFY_PICTURE_SIDE;
    pixel_hits *pixels = calloc(pixel_count, sizeof *pixels);
    if (!pixels)
        return nook_fail(NOOK_E_MEMORY, "verify: no room for the hits in a picture");
    nook_matrix view_from_world = nook_verify_camera_matrix(camera);
    nook_verify_sight sight = { 0 };
    for (uint32_t i = 0; i < rays; i++) {
        double ray[3], point[3];
        direction_of(&nook_verify_origin, weight, i, ray);
        double distance = cast(scene, nook_verify_origin.point, ray, false).distance, rho = fade(scene, distance);
        if (!isfinite(distance))
            continue;
        nook_vector_add_scaled(nook_verify_origin.point, distance, ray, point);
        if (nook_verify_sees(scene, camera, point))
            add_hit(pixels, camera, &view_from_world, point, rho);
        else
            sight.missing += rho / rays;
    }
    for (size_t i = 0; i < pixel_count; i++)
        sight.unresolved += pixels[i].count * (pixels[i].most - pixels[i].least) / rays;
    free(pixels);
    *out_sight = sight;
    return NOOK_OK;
}

nook_verify_receiver nook_verify_receiver_of(const nook_verify_scene *scene, const nook_verify_camera *camera,
                                             uint32_t x, uint32_t y)
{
    nook_matrix view = nook_verify_camera_matrix(camera);
    const double scale = tan(camera->angle / 2.0);
    const double local[3] = { (2.0 * (x + 0.5) / NOOK_VERIFY_PICTURE_SIDE - 1.0) * scale,
                              (2.0 * (y + 0.5) / NOOK_VERIFY_PICTURE_SIDE - 1.0) * scale, -1.0 };
    double ray[3];
    for (int axis = 0; axis < 3; axis++) /* by the transposed rotation */
        ray[axis] = view.m[4 * axis] * local[0] + view.m[4 * axis + 1] * local[1] + view.m[4 * axis + 2] * local[2];
    nook_fixture_hit hit = cast(scene, camera->eye, ray, true);
    nook_verify_receiver receiver = { .normal = { hit.normal[0], hit.normal[1], hit.normal[2] } };
    nook_vector_add_scaled(camera->eye, hit.distance, ray, receiver.point);
    nook_vector_add_scaled(receiver.point, 1e-6 * scene->r_max, hit.normal, receiver.point);
    return receiver;
}

/** rho at what hides a point, 0 when nothing does. */
static double hidden_part(const nook_verify_scene *scene, const nook_verify_camera *camera,
                          const nook_matrix *view_from_world, const nook_verify_receiver *receiver,
                          const double point[3], double bias)
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
    nook_vector_add_scaled(hider, -1.0, receiver->point, hider);
    return fade(scene, nook_vector_length(hider));
}

double nook_verify_cast_half_ball(const nook_verify_scene *scene, const nook_verify_camera *camera,
                                  const nook_verify_receiver *receiver, double bias, uint32_t points)
{
    nook_matrix view_from_world = nook_verify_camera_matrix(camera);
    double sum = 0.0;
    for (uint32_t i = 0; i < points; i++) {
        double point[3], direction[3];
        direction_of(receiver, NOOK_FORM_SOLID_ANGLE, i, direction);
        double radius = scene->r_max * cbrt((i * 0.7548776662466927) - floor(i * 0.7548776662466927)); /* Kronecker */
        nook_vector_add_scaled(receiver->point, radius, direction, point);
        sum += hidden_part(scene, camera, &view_from_world, receiver, point, bias);
    }
    return sum / points;
}
