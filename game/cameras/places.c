#include "game/cameras/places.h"
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/compare/auto_camera.h"
#include "game/compare/camera.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIMENSIONS = 6, DIRECTIONS = 16, OPEN_POINTS = 256, EXPLORING_TRIALS = 8192 };
static const double up[3] = { 0.0, 1.0, 0.0 }, down[3] = { 0.0, -1.0, 0.0 };

/*
 * Roberts' generalised golden ratio: frac(1/2 + n / g^i), g the root of g^(d+1) = g + 1. Additive, so any run of it is as evenly
 * spread as its beginning.
 */
static void sequence(uint32_t n, double out[DIMENSIONS])
{
    const double golden = 1.1127756842787055; /* d = 6 */
    double power = 1.0;
    for (int i = 0; i < DIMENSIONS; i++) {
        power /= golden;
        double value = 0.5 + n * power;
        out[i] = value - floor(value);
    }
}

static double between(double low, double high, double part)
{
    return low + (high - low) * part;
}

static void eye_of(const nook_camera *camera, nook_matrix *out_world_from_view, double out_eye[3])
{
    const double origin[3] = { 0.0, 0.0, 0.0 };
    nook_matrix_inverse_affine(&camera->view_from_world, out_world_from_view);
    nook_matrix_apply_point(out_world_from_view, origin, out_eye);
}

/* From `eye` to where yaw (from -Z to the left) and pitch point. */
static bool look(const double eye[3], double yaw, double pitch, const nook_camera *like, nook_camera *out)
{
    const double target[3] = { eye[0] - sin(yaw) * cos(pitch), eye[1] + sin(pitch), eye[2] - cos(yaw) * cos(pitch) };
    return nook_camera_look(eye, target, like->fov_y_radians, like->z_near, out) == NOOK_OK;
}

/* ---- Around a camera of the scene -------------------------------------------------------------------------------- */

static bool try_camera(const nook_place *place, const double u[DIMENSIONS], nook_camera *out)
{
    const double ahead[3] = { 0.0, 0.0, -1.0 };
    nook_matrix world_from_view;
    double from[3], eye[3], forward[3];
    eye_of(&place->camera, &world_from_view, from);
    nook_matrix_apply_vector(&world_from_view, ahead, forward);
    const double move[3] = { between(-0.04, 0.04, u[1]), between(-0.01, 0.02, u[3]), between(-0.04, 0.04, u[2]) };
    nook_vector_add_scaled(from, place->diagonal, move, eye);
    double towards[3] = { eye[0] - from[0], eye[1] - from[1], eye[2] - from[2] };
    if (nook_vector_length(towards) > 0.0 && nook_rays_cast(place->rays, from, towards).distance < 1.2)
        return false; /* through a wall, or up to one */
    double yaw = atan2(-forward[0], -forward[2]) + between(-55.0, 55.0, u[0]) * NOOK_DEGREE;
    double pitch = asin(fmax(-1.0, fmin(1.0, forward[1]))) + between(-6.0, 6.0, u[4]) * NOOK_DEGREE;
    return look(eye, yaw, fmax(-1.4, fmin(1.4, pitch)), &place->camera, out);
}

/* ---- In a room --------------------------------------------------------------------------------------------------- */

/* Whether walls show their fronts all around: not outside, not inside of something solid, not in the open. */
static bool is_inside(const nook_place *place, const double point[3])
{
    int walls = 0, backs = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        double angle = 2.0 * NOOK_PI * i / DIRECTIONS;
        const double direction[3] = { cos(angle), 0.0, sin(angle) };
        nook_view_hit hit = nook_rays_cast(place->rays, point, direction);
        if (hit.distance < 0.008 * place->diagonal)
            return false;
        walls += hit.front && hit.distance < place->diagonal;
        backs += !hit.front && hit.distance < place->diagonal;
    }
    return walls >= 13 && backs <= 1;
}

/* A person's height above the floor below, of which a scene can have several. */
static bool stand(const nook_place *place, double height_part, double point[3])
{
    nook_view_hit floor = nook_rays_cast(place->rays, point, down);
    nook_view_hit ceiling = nook_rays_cast(place->rays, point, up);
    if (!floor.front || !isfinite(floor.distance))
        return false;
    double above = fmin(ceiling.distance, place->scene->bounds_max[1] - point[1]);
    double room = floor.distance + above;
    double height = fmin(0.5 * room, between(0.035, 0.09, height_part) * place->diagonal);
    point[1] += height - floor.distance;
    return room > 0.02 * place->diagonal;
}

static bool stand_somewhere(const nook_place *place, const double u[DIMENSIONS], double out[3])
{
    const nook_scene *scene = place->scene;
    out[0] = between(scene->bounds_min[0], scene->bounds_max[0], u[0]);
    out[1] = between(scene->bounds_min[1], scene->bounds_max[1], u[3]);
    out[2] = between(scene->bounds_min[2], scene->bounds_max[2], u[1]);
    return stand(place, u[4], out) && is_inside(place, out);
}

static bool sees_any(const nook_place *place, const double point[3])
{
    for (uint32_t i = 0; i < place->open_count; i++) {
        if (nook_rays_see(place->rays, place->open[i], point))
            return true;
    }
    return false;
}

/*
 * Buildings have hollows that nobody sees: attics, the inside of double walls. What can be walked to from the camera is what is seen
 * from it, what is seen from there, and so on.
 */
static nook_result explore(nook_place *place)
{
    nook_matrix world_from_view;
    double u[DIMENSIONS];
    place->open = calloc(OPEN_POINTS + 1, sizeof *place->open);
    double(*unseen)[3] = calloc(OPEN_POINTS, sizeof *unseen);
    if (!place->open || !unseen) {
        free(unseen);
        return nook_fail(NOOK_E_MEMORY, "no memory for %d places", OPEN_POINTS);
    }
    eye_of(&place->camera, &world_from_view, place->open[0]);
    place->open_count = 1;
    uint32_t unseen_count = 0;
    for (uint32_t trial = 0; trial < EXPLORING_TRIALS && unseen_count < OPEN_POINTS; trial++) {
        sequence(trial + 1, u);
        unseen_count += stand_somewhere(place, u, unseen[unseen_count]);
    }
    for (uint32_t from = 0; from < place->open_count; from++) {
        for (uint32_t i = unseen_count; i-- > 0;) {
            if (!nook_rays_see(place->rays, place->open[from], unseen[i]))
                continue;
            memcpy(place->open[place->open_count++], unseen[i], sizeof unseen[i]);
            memcpy(unseen[i], unseen[--unseen_count], sizeof unseen[i]);
        }
    }
    free(unseen);
    return NOOK_OK;
}

static bool try_room(const nook_place *place, const double u[DIMENSIONS], nook_camera *out)
{
    double eye[3];
    if (!stand_somewhere(place, u, eye) || !sees_any(place, eye))
        return false;
    return look(eye, 2.0 * NOOK_PI * u[2], between(-12.0, 8.0, u[5]) * NOOK_DEGREE, &place->camera, out);
}

/* ---- Around an object -------------------------------------------------------------------------------------------- */

static bool try_around(const nook_place *place, const double u[DIMENSIONS], nook_camera *out)
{
    const nook_scene *scene = place->scene;
    nook_matrix world_from_view;
    double framed[3], centre[3], aim[3], eye[3];
    eye_of(&place->camera, &world_from_view, framed);
    for (int i = 0; i < 3; i++) {
        double half = 0.5 * (scene->bounds_max[i] - scene->bounds_min[i]);
        centre[i] = scene->bounds_min[i] + half;
        aim[i] = centre[i] + half * between(-0.3, 0.3, u[3 + i]);
    }
    nook_vector_add_scaled(framed, -1.0, centre, framed);
    double distance = nook_vector_length(framed) * between(0.6, 1.0, u[2]);
    double elevation = between(4.0, 50.0, u[1]) * NOOK_DEGREE, azimuth = 2.0 * NOOK_PI * u[0];
    const double away[3] = { sin(azimuth) * cos(elevation), sin(elevation), cos(azimuth) * cos(elevation) };
    nook_vector_add_scaled(centre, distance, away, eye);
    return nook_camera_look(eye, aim, place->camera.fov_y_radians, place->camera.z_near, out) == NOOK_OK;
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

uint32_t nook_places_count(const nook_scene *scene)
{
    uint32_t count = 0;
    while (nook_camera_at(scene, count))
        count++;
    return count > 0 ? count : 1;
}

/* A camera in the scene turns its head; one that looks at it from outside goes around it. */
static bool is_within(const nook_scene *scene, const nook_camera *camera)
{
    nook_matrix world_from_view;
    double eye[3];
    bool within = true;
    eye_of(camera, &world_from_view, eye);
    for (int i = 0; i < 3; i++)
        within = within && eye[i] > scene->bounds_min[i] && eye[i] < scene->bounds_max[i];
    return within;
}

nook_result nook_place_find(const nook_scene *scene, const nook_rays *rays, uint32_t index, double aspect,
                            nook_place *out_place)
{
    nook_place place = {
        .scene = scene, .rays = rays, .diagonal = nook_scene_diagonal(scene), .shift = 1 + 97 * index
    };
    const nook_scene_camera *own = nook_camera_at(scene, index);
    nook_result result = NOOK_OK;
    if (own) {
        place.camera = nook_camera_from_scene(own);
        place.kind = is_within(scene, &place.camera) ? NOOK_PLACE_CAMERA : NOOK_PLACE_AROUND;
    } else {
        const nook_camera outside = nook_camera_outside(scene, aspect);
        bool inside = nook_camera_inside(scene, &outside, &place.camera);
        place.kind = inside ? NOOK_PLACE_ROOM : NOOK_PLACE_AROUND;
        if (inside)
            result = explore(&place);
        else
            place.camera = outside;
    }
    if (result != NOOK_OK)
        nook_place_free(&place);
    *out_place = place;
    return result;
}

void nook_place_free(nook_place *place)
{
    free(place->open);
    *place = (nook_place){ 0 };
}

bool nook_place_try(const nook_place *place, uint32_t trial, nook_camera *out_camera)
{
    double u[DIMENSIONS];
    sequence(place->shift + trial, u);
    switch (place->kind) {
    case NOOK_PLACE_CAMERA:
        return try_camera(place, u, out_camera);
    case NOOK_PLACE_ROOM:
        return try_room(place, u, out_camera);
    case NOOK_PLACE_AROUND:
        return try_around(place, u, out_camera);
    }
    return false;
}
