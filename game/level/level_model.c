/* A level made of a glTF file: where to stand in it, whether it needs a floor, and what of it can be moved. */
#include "engine/animation/scene_stand.h"
#include "engine/core/angle.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/cameras/places.h"
#include "game/level/level_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TRIALS = 256, SIDES = 12 };
static const double down[3] = { 0, -1, 0 }, up[3] = { 0, 1, 0 };

/* Room that someone needs to stand, metres; above, and around at the height of the hips. */
static const double head_room = 1.9, side_room = 0.5, hips = 0.9;

/* The file, and rays through it. */
typedef struct probed {
    nook_scene *scene;
    nook_rays *rays;
} probed;

/* @return the failure: nobody loads the file after us, so its warnings, which may be the reason, are said here */
static nook_result refuse_empty(const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->warning_count; i++)
        nook_log_warning("%s", scene->warnings[i]);
    return nook_fail(NOOK_E_FORMAT, "%s: holds no triangles, so there is nothing to play in", scene->path);
}

static nook_result open_model(const char *path, probed *out)
{
    const nook_scene_options geometry = { .skip_images = true, .silent = true };
    *out = (probed){ NULL, NULL };
    nook_result result = nook_scene_load(path, &geometry, &out->scene);
    if (result == NOOK_OK)
        result = nook_scene_stand_still(out->scene, NOOK_NONE, 0.0);
    if (result != NOOK_OK)
        return result;
    if (out->scene->triangle_count == 0)
        return refuse_empty(out->scene);
    return nook_rays_create(out->scene, &out->rays);
}

static void close_model(probed *model)
{
    nook_rays_destroy(model->rays);
    nook_scene_destroy(model->scene);
}

/* ---- Where to stand ---------------------------------------------------------------------------------------------- */

static bool has_room(const probed *model, const double feet[3])
{
    double eye[3] = { feet[0], feet[1] + hips, feet[2] };
    if (nook_rays_cast(model->rays, eye, up).distance < head_room - hips)
        return false;
    for (int i = 0; i < SIDES; i++) {
        const double direction[3] = { cos(2.0 * NOOK_PI * i / SIDES), 0.0, sin(2.0 * NOOK_PI * i / SIDES) };
        if (nook_rays_cast(model->rays, eye, direction).distance < side_room)
            return false;
    }
    return true;
}

/* On the floor below a view, looking along it. */
static bool stand_below(const probed *model, const nook_camera *camera, nook_level *level)
{
    const double origin[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1 };
    double eye[3], forward[3];
    nook_matrix world_from_view;
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    nook_matrix_apply_vector(&world_from_view, ahead, forward);
    nook_view_hit floor = nook_rays_cast(model->rays, eye, down);
    if (!isfinite(floor.distance) || !floor.front)
        return false;
    const double feet[3] = { eye[0], eye[1] - floor.distance, eye[2] };
    if (!has_room(model, feet))
        return false;
    for (int i = 0; i < 3; i++)
        level->start[i] = feet[i];
    level->yaw = atan2(-forward[0], -forward[2]) / NOOK_DEGREE;
    return true;
}

/* @param out_found  false: nobody can stand in it, it is a thing to look at */
static nook_result find_inside(const probed *model, nook_level *level, bool *out_found)
{
    *out_found = false;
    for (uint32_t i = 0; i < nook_places_count(model->scene) && !*out_found; i++) {
        nook_place place;
        nook_result result = nook_place_find(model->scene, model->rays, i, 16.0 / 9.0, &place);
        if (result != NOOK_OK)
            return result;
        *out_found = place.kind != NOOK_PLACE_AROUND && stand_below(model, &place.camera, level);
        for (uint32_t trial = 0; trial < TRIALS && !*out_found && place.kind != NOOK_PLACE_AROUND; trial++) {
            nook_camera camera;
            *out_found = nook_place_try(&place, trial, &camera) && stand_below(model, &camera, level);
        }
        nook_place_free(&place);
    }
    return NOOK_OK;
}

/* In front of it, on a ground as low as it is. */
static void stand_outside(const nook_scene *scene, nook_level *level)
{
    double height = scene->bounds_max[1] - scene->bounds_min[1];
    level->start[0] = 0.5 * (scene->bounds_min[0] + scene->bounds_max[0]);
    level->start[1] = scene->bounds_min[1];
    level->start[2] = scene->bounds_max[2] + fmax(2.0, 0.75 * height);
    level->yaw = 0.0;
}

/* ---- What carries it --------------------------------------------------------------------------------------------- */

/* Whether something that stands still lies below the middle of a node. Through others that could fall as well. */
static bool is_carried(const probed *model, const nook_node *node)
{
    const nook_mesh *mesh = &model->scene->meshes[node->mesh];
    double middle[3];
    for (int k = 0; k < 3; k++)
        middle[k] = 0.5 * ((double)mesh->bounds_min[k] + (double)mesh->bounds_max[k]);
    nook_matrix_apply_point(&node->world_from_local, middle, middle);
    middle[1] = fmax(middle[1], model->scene->bounds_min[1]);
    for (uint32_t i = 0; i < model->scene->node_count; i++) {
        const nook_node *other = &model->scene->nodes[i];
        if (other->mesh == NOOK_NONE || other->moving)
            continue;
        const nook_mesh *still = &model->scene->meshes[other->mesh];
        double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
        for (int corner = 0; corner < 8; corner++) {
            double p[3];
            for (int k = 0; k < 3; k++)
                p[k] = (double)(corner >> k & 1 ? still->bounds_max[k] : still->bounds_min[k]);
            nook_matrix_apply_point(&other->world_from_local, p, p);
            for (int k = 0; k < 3; k++) {
                low[k] = fmin(low[k], p[k]);
                high[k] = fmax(high[k], p[k]);
            }
        }
        if (middle[0] > low[0] && middle[0] < high[0] && middle[2] > low[2] && middle[2] < high[2] &&
            low[1] < middle[1])
            return true;
    }
    return false;
}

static bool all_are_carried(const probed *model)
{
    for (uint32_t i = 0; i < model->scene->node_count; i++) {
        const nook_node *node = &model->scene->nodes[i];
        if (node->mesh != NOOK_NONE && node->moving && !is_carried(model, node))
            return false;
    }
    return true;
}

/* Whether the file itself has bodies. */
static bool has_bodies(const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->node_count; i++) {
        if (scene->nodes[i].mesh != NOOK_NONE && scene->nodes[i].moving)
            return true;
    }
    return false;
}

static void add_ground(const nook_scene *scene, nook_level *level)
{
    double diagonal = 0.0;
    for (int k = 0; k < 3; k++) {
        level->ground[k] = 0.5 * (scene->bounds_min[k] + scene->bounds_max[k]);
        diagonal = hypot(diagonal, scene->bounds_max[k] - scene->bounds_min[k]);
    }
    level->ground[1] = scene->bounds_min[1];
    level->ground_half = 10.0 + diagonal;
    nook_log_info("%s: nothing lies below it, so a ground was put there, %.3g m wide at a height of %.3g m",
                  level->path, 2.0 * level->ground_half, level->ground[1]);
}

static nook_result describe(const probed *model, nook_level *level)
{
    bool inside;
    nook_result result = find_inside(model, level, &inside);
    if (result != NOOK_OK)
        return result;
    if (!inside)
        stand_outside(model->scene, level);
    if (!has_bodies(model->scene))
        level->loose_longest = (double)nook_body_defaults_initial().longest;
    if (!inside || !all_are_carried(model))
        add_ground(model->scene, level);
    return NOOK_OK;
}

nook_result nook_level_make_of_model(const char *path, nook_level *level)
{
    probed model;
    nook_result result = open_model(path, &model);
    if (result == NOOK_OK)
        result = describe(&model, level);
    close_model(&model);
    snprintf(level->title, sizeof level->title, "%s", nook_path_name(path));
    snprintf(level->files[0].path, sizeof level->files[0].path, "%s", path);
    level->file_count = 1;
    return result;
}
