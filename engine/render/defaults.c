/* Cameras and lights for scenes that name none, and those of scenes that do. */
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include <math.h>

/* No light bounces here, so the ambient also stands for what walls and floor would give back: about a third of the sun. */
static const float sky_top[3] = { 0.74f, 0.82f, 0.95f };
static const float sky_bottom[3] = { 0.56f, 0.52f, 0.47f };

nook_lights nook_lights_default(void)
{
    nook_lights lights = {
        .sun = { .direction = { 0.35, -1.0, -0.4 }, .colour = { 5.2f, 4.8f, 4.1f } },
        .exposure = 1.0f,
    };
    for (int i = 0; i < 3; i++) {
        lights.ambient_top[i] = sky_top[i];
        lights.ambient_bottom[i] = sky_bottom[i];
    }
    return lights;
}

static float brightest(const float colour[3])
{
    return fmaxf(colour[0], fmaxf(colour[1], colour[2]));
}

/** Irradiance of a surface at the place that sets the exposure. */
static float key_of(const nook_light *light, double distance)
{
    float intensity = brightest(light->colour) * light->intensity;
    return light->kind == NOOK_LIGHT_DIRECTIONAL ? intensity : intensity / (float)(distance * distance);
}

static void set_sun(const nook_light *light, nook_sun *out)
{
    for (int i = 0; i < 3; i++) {
        out->direction[i] = -light->world_from_light.m[8 + i];
        out->colour[i] = light->colour[i] * light->intensity;
    }
}

static nook_point_light point_from(const nook_light *light)
{
    nook_point_light point = { .range = light->range };
    const double *m = light->world_from_light.m;
    double length = nook_vector_length(m + 8);
    for (int i = 0; i < 3; i++) {
        point.position[i] = m[12 + i];
        point.colour[i] = light->colour[i] * light->intensity;
        if (light->kind == NOOK_LIGHT_SPOT && length > 0.0)
            point.direction[i] = -m[8 + i] / length;
    }
    point.cos_inner = cosf(light->inner_cone);
    point.cos_outer = cosf(light->outer_cone);
    return point;
}

static double quarter_of_size(const nook_scene *scene)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
        square += pow(fmax(scene->bounds_max[i] - scene->bounds_min[i], 0.0), 2.0);
    return square > 0.0 ? sqrt(square) / 4.0 : 1.0;
}

nook_lights nook_lights_from_scene(const nook_scene *scene)
{
    nook_lights lights = { .exposure = 1.0f };
    float key = 0.0f, sun_key = 0.0f;
    double distance = quarter_of_size(scene);
    uint32_t left_out = 0;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const nook_light *light = &scene->lights[i];
        float light_key = key_of(light, distance);
        if (!(light_key > 0.0f) || !isfinite(light_key))
            continue;
        key = fmaxf(key, light_key);
        if (light->kind != NOOK_LIGHT_DIRECTIONAL) {
            if (lights.point_count < NOOK_MAX_POINT_LIGHTS)
                lights.points[lights.point_count++] = point_from(light);
            else
                left_out++;
            continue;
        }
        left_out += sun_key > 0.0f;
        if (light_key > sun_key) {
            set_sun(light, &lights.sun);
            sun_key = light_key;
        }
    }
    if (key == 0.0f)
        return nook_lights_default();
    if (left_out > 0)
        nook_log_warning("%s: %u lights left out; a frame takes one directional and %u others", scene->path, left_out,
                         NOOK_MAX_POINT_LIGHTS);
    lights.exposure = (float)NOOK_PI / key;
    for (int i = 0; i < 3; i++) {
        lights.ambient_top[i] = 0.5f * sky_top[i] / lights.exposure;
        lights.ambient_bottom[i] = 0.5f * sky_bottom[i] / lights.exposure;
    }
    return lights;
}

/** Corners of a box around the origin, in a camera's axes. */
static void turned_corners(const nook_matrix *turn, const double half[3], double out[8][3])
{
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (i >> k & 1) ? half[k] : -half[k];
        nook_matrix_apply_vector(turn, p, out[i]);
    }
}

/**
 * How far back a camera stands to hold all corners between the sides of its frustum in one axis.
 *
 * A corner (x, z) is seen when |x - eye_x| <= tangent * (eye_z - z): on each side the corner that reaches farthest out
 * decides, and the two sides meet at the eye.
 */
static double distance_to_hold(double corners[8][3], int axis, double tangent)
{
    double high = -INFINITY, low = -INFINITY;
    for (int i = 0; i < 8; i++) {
        high = fmax(high, corners[i][axis] + tangent * corners[i][2]);
        low = fmax(low, -corners[i][axis] + tangent * corners[i][2]);
    }
    return (high + low) / (2.0 * tangent);
}

/** Where the eye stands in one axis so that as much of the picture is left free on either side of the corners. */
static double centre_in_picture(double corners[8][3], int axis, double distance)
{
    double low = corners[0][axis], high = low;
    for (int i = 1; i < 8; i++) {
        low = fmin(low, corners[i][axis]);
        high = fmax(high, corners[i][axis]);
    }
    for (int step = 0; step < 60; step++) { /* bisection: the sum below falls as the eye goes up */
        double eye = 0.5 * (low + high), least = INFINITY, most = -INFINITY;
        for (int i = 0; i < 8; i++) {
            double place = (corners[i][axis] - eye) / (distance - corners[i][2]);
            least = fmin(least, place);
            most = fmax(most, place);
        }
        if (least + most > 0.0)
            low = eye;
        else
            high = eye;
    }
    return 0.5 * (low + high);
}

nook_camera nook_camera_frame(const double bounds_min[3], const double bounds_max[3], double aspect)
{
    const double zero[3] = { 0, 0, 0 }, towards[3] = { -0.52, -0.38, -0.77 }, up[3] = { 0, 1, 0 };
    const double fov_y = 0.7, margin = 0.92; /* of the half picture */
    double centre[3] = { 0, 0, 0 }, half[3] = { 0.5, 0.5, 0.5 }, eye[3];
    bool empty = !(bounds_min[0] <= bounds_max[0]);
    for (int i = 0; i < 3 && !empty; i++) {
        centre[i] = 0.5 * (bounds_min[i] + bounds_max[i]);
        half[i] = 0.5 * (bounds_max[i] - bounds_min[i]);
    }
    double size = nook_vector_length(half);
    if (size == 0.0) /* a point */
        size = half[0] = half[1] = half[2] = 0.5;
    const double tangent = margin * tan(0.5 * fov_y);
    nook_matrix turn = nook_matrix_look_at(zero, towards, up);
    double corners[8][3];
    turned_corners(&turn, half, corners);
    eye[2] = fmax(distance_to_hold(corners, 0, tangent * aspect), distance_to_hold(corners, 1, tangent));
    eye[2] += 0.01 * size; /* a flat box seen from its own plane would touch the eye */
    eye[0] = centre_in_picture(corners, 0, eye[2]);
    eye[1] = centre_in_picture(corners, 1, eye[2]);
    nook_matrix move = nook_matrix_translation(-centre[0], -centre[1], -centre[2]);
    nook_camera camera = { .fov_y_radians = fov_y, .z_near = 2e-3 * size };
    camera.view_from_world = nook_matrix_multiply(&turn, &move);
    for (int i = 0; i < 3; i++)
        camera.view_from_world.m[12 + i] -= eye[i];
    return camera;
}

nook_camera nook_camera_from_scene(const nook_scene_camera *camera)
{
    nook_camera result = { .fov_y_radians = camera->fov_y_radians, .z_near = camera->z_near };
    const double *m = camera->world_from_view.m;
    const double eye[3] = { m[12], m[13], m[14] }, target[3] = { eye[0] - m[8], eye[1] - m[9], eye[2] - m[10] };
    const double up[3] = { m[4], m[5], m[6] }; /* taken anew from its axes: a scaled node must not scale the view */
    result.view_from_world = nook_matrix_look_at(eye, target, up);
    return result;
}
