#include "game/compare/camera.h"
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/suggestion.h"
#include "engine/core/vector.h"
#include "game/compare/auto_camera.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the scene's diagonal. Reversed float depth keeps its precision whatever the near plane, so it may be tiny. */
static const double near_fraction = 1e-4;

double nook_scene_diagonal(const nook_scene *scene)
{
    double diagonal[3];
    nook_vector_add_scaled(scene->bounds_max, -1.0, scene->bounds_min, diagonal);
    if (diagonal[0] < 0.0 || diagonal[1] < 0.0 || diagonal[2] < 0.0)
        return 1.0;
    double length = nook_vector_length(diagonal);
    return length > 0.0 ? length : 1.0;
}

const nook_scene_camera *nook_camera_at(const nook_scene *scene, uint32_t index)
{
    for (uint32_t i = 0; i < scene->camera_count; i++) {
        if (scene->cameras[i].perspective && index-- == 0)
            return &scene->cameras[i];
    }
    return NULL;
}

nook_result nook_camera_look(const double eye[3], const double target[3], double fov_y_radians, double z_near,
                             nook_camera *out_camera)
{
    double forward[3];
    nook_vector_add_scaled(target, -1.0, eye, forward);
    double length = nook_vector_length(forward);
    if (!(length > 0.0) || !isfinite(length))
        return nook_fail(NOOK_E_RANGE, "camera: eye and target must be two points a finite distance apart");
    double sideways = hypot(forward[0], forward[2]) / length;
    const double up[3] = { 0.0, sideways > 1e-6 ? 1.0 : 0.0, sideways > 1e-6 ? 0.0 : -1.0 };
    *out_camera = (nook_camera){ nook_matrix_look_at(eye, target, up), fov_y_radians, z_near };
    return NOOK_OK;
}

/* @return how many numbers stand in `text`, separated by commas and nothing else; 0 when it is something else */
static int parse_numbers(const char *text, double numbers[7])
{
    int count = 0;
    while (count < 7) {
        char *end = NULL;
        double value = strtod(text, &end);
        if (end == text || !isfinite(value))
            return 0;
        numbers[count++] = value;
        if (*end == '\0')
            return count;
        if (*end != ',')
            return 0;
        text = end + 1;
    }
    return 8; /* more than seven */
}

static nook_result camera_from_numbers(const double numbers[7], double z_near, nook_camera *out_camera)
{
    double fov = numbers[6];
    if (!(fov >= 1.0 && fov <= 170.0))
        return nook_fail(NOOK_E_RANGE, "camera: a field of view of %g degrees; give 1 to 170", fov);
    return nook_camera_look(numbers, numbers + 3, fov * NOOK_DEGREE, z_near, out_camera);
}

nook_result nook_camera_check(const char *text)
{
    double numbers[7];
    nook_camera camera;
    int count = parse_numbers(text, numbers);
    if (count == 7)
        return camera_from_numbers(numbers, near_fraction, &camera);
    if (count > 1) /* a single number may well be a name */
        return nook_fail(NOOK_E_RANGE, "camera %s: give seven numbers, px,py,pz,tx,ty,tz,fov, or a camera's name",
                         text);
    return NOOK_OK;
}

static nook_result refuse_name(const nook_scene *scene, const char *text)
{
    char names[1024] = "";
    size_t used = 0;
    nook_suggestion suggestion = nook_suggestion_for(text);
    const nook_scene_camera *camera;
    for (uint32_t i = 0; (camera = nook_camera_at(scene, i)); i++) {
        nook_suggestion_offer(&suggestion, camera->name);
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s'%s'", i ? ", " : "", camera->name);
    }
    if (used == 0)
        return nook_fail(NOOK_E_NOT_FOUND, "camera '%s': %s has no cameras; give px,py,pz,tx,ty,tz,fov", text,
                         scene->path);
    if (suggestion.nearest)
        return nook_fail(NOOK_E_NOT_FOUND, "camera '%s': did you mean '%s'? Give px,py,pz,tx,ty,tz,fov or one of %s",
                         text, suggestion.nearest, names);
    return nook_fail(NOOK_E_NOT_FOUND, "camera '%s': give px,py,pz,tx,ty,tz,fov or one of %s", text, names);
}

nook_result nook_camera_choose(const nook_scene *scene, const char *text, double aspect, nook_camera *out_camera,
                               char *out_label, size_t label_capacity)
{
    const nook_scene_camera *found = text ? NULL : nook_camera_at(scene, 0);
    for (uint32_t i = 0; text && i < scene->camera_count; i++) {
        if (scene->cameras[i].perspective && strcmp(scene->cameras[i].name, text) == 0)
            found = &scene->cameras[i];
    }
    if (found) {
        *out_camera = nook_camera_from_scene(found);
        snprintf(out_label, label_capacity, "%s", *found->name ? found->name : "without a name");
        return NOOK_OK;
    }
    if (!text) {
        nook_camera outside = nook_camera_outside(scene, aspect);
        bool inside = nook_camera_inside(scene, &outside, out_camera);
        if (!inside)
            *out_camera = outside;
        snprintf(out_label, label_capacity, inside ? "automatic, inside" : "automatic");
        return NOOK_OK;
    }
    double numbers[7];
    if (parse_numbers(text, numbers) != 7)
        return refuse_name(scene, text);
    nook_result result = camera_from_numbers(numbers, near_fraction * nook_scene_diagonal(scene), out_camera);
    if (result == NOOK_OK)
        snprintf(out_label, label_capacity, "%s", text);
    return result;
}
