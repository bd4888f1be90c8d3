#include "game/view/viewer.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/compare/camera.h"
#include "game/live/scene_reload.h"
#include "game/live/shader_reload.h"
#include "game/view/orbit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const double still_after_ms = 200.0; /* from the last movement to the full picture */
static const double turn_per_pixel = 0.005; /* radians */
static const double fly_per_second = 0.25;  /* of the scene's diagonal */
static const double rays_max = 64.0;        /* of the reference: a picture in seconds, not minutes */
enum { SCALE_WHILE_MOVING = 2 /* quarter, modules/ao/params.def */ };

typedef struct viewer {
    nook_stage *stage;
    const char *scene_name;
    const nook_compare_choice *choice;
    nook_shader_reload *shaders; /* NULL: they cannot be watched */
    nook_scene_reload *scenes;   /* the same of the scene's files */
    nook_orbit orbit;
    double diagonal, scale;             /* metres; ao.scale when nothing moves */
    const nook_ao_technique *technique; /* NULL: none */
    int key;                            /* that chose it */
    nook_view view;
    uint32_t camera; /* the next one that C goes to */
    bool changed;    /* what is seen, or what darkens it, is not what was drawn */
    bool reshade;    /* only what of it is shown has changed */
    bool coarse;     /* the picture was made while moving */
    bool occluded;   /* the picture has the technique in it */
    double ms;       /* that the technique took */
    double moved_ms, polled_ms;
} viewer;

/* What that number key chooses, or NULL: what is measured first, then what it is measured against. */
static const nook_ao_technique *technique_of_key(const nook_compare_choice *choice, int key)
{
    for (uint32_t exact = 0; exact < 2; exact++) {
        for (uint32_t i = 0; i < choice->count; i++) {
            if (choice->techniques[i]->exact == exact && --key == 0)
                return choice->techniques[i];
        }
    }
    return NULL;
}

static void choose_technique(viewer *v, int key)
{
    const nook_ao_technique *technique = technique_of_key(v->choice, key);
    if (key > 0 && !technique)
        return;
    v->technique = technique;
    v->key = key;
    v->changed = true;
    nook_log_info("view: technique %s", technique ? technique->name : "none");
}

/* The views in the order of V: the picture, visibility, then the others as they are declared. */
static nook_view step_view(nook_view view, int step)
{
    const int second = NOOK_VIEW_VISIBILITY;
    int place = (int)view;
    if (place == second)
        place = 1;
    else if (place > NOOK_VIEW_LIT && place < second)
        place++;
    place = (place + step + NOOK_VIEW_COUNT) % NOOK_VIEW_COUNT;
    if (place == 1)
        return NOOK_VIEW_VISIBILITY;
    return (nook_view)(place > 1 && place <= second ? place - 1 : place);
}

static void read_keys(viewer *v, const nook_input *input)
{
    for (int key = 0; key <= 9; key++) {
        if (input->pressed[NOOK_KEY_0 + key])
            choose_technique(v, key);
    }
    if (input->pressed[NOOK_KEY_V] || input->pressed[NOOK_KEY_F]) {
        v->view = step_view(v->view, input->down[NOOK_KEY_SHIFT] ? -1 : 1);
        v->reshade = true;
    }
}

/* In a room the hand turns the head; from outside it turns the scene. */
static nook_orbit orbit_from(const viewer *v, const nook_camera *camera)
{
    const nook_scene *scene = v->stage->scene;
    const double origin[3] = { 0.0, 0.0, 0.0 };
    nook_matrix world_from_view;
    double centre[3], eye[3];
    bool inside = true;
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    for (int i = 0; i < 3; i++) {
        centre[i] = 0.5 * (scene->bounds_min[i] + scene->bounds_max[i]);
        inside = inside && eye[i] > scene->bounds_min[i] && eye[i] < scene->bounds_max[i];
    }
    return nook_orbit_from_camera(camera, centre, 0.05 * v->diagonal, (inside ? 0.08 : 2.0) * v->diagonal);
}

static void next_camera(viewer *v)
{
    const nook_scene *scene = v->stage->scene;
    const nook_scene_camera *found = nook_camera_at(scene, v->camera);
    if (!found)
        found = nook_camera_at(scene, v->camera = 0);
    if (!found)
        return;
    v->camera++;
    nook_camera camera = nook_camera_from_scene(found);
    v->orbit = orbit_from(v, &camera);
    v->changed = true;
    nook_log_info("view: camera %s", found->name);
}

/* The place in the scene's list after the camera that is `camera`; 0 when none of them is. */
static uint32_t camera_after(const nook_scene *scene, const nook_camera *camera)
{
    const nook_scene_camera *listed;
    for (uint32_t i = 0; (listed = nook_camera_at(scene, i)); i++) {
        nook_camera other = nook_camera_from_scene(listed);
        if (memcmp(&other.view_from_world, &camera->view_from_world, sizeof other.view_from_world) == 0)
            return i + 1;
    }
    return 0;
}

static bool drag(viewer *v, const nook_input *input)
{
    bool dragged = input->mouse_dx != 0.0 || input->mouse_dy != 0.0;
    /* A pixel's width in metres at the target, so that what is grabbed stays under the pointer. */
    double metres = 2.0 * v->orbit.distance * tan(0.5 * v->orbit.fov_y_radians) / v->stage->height;
    if (dragged && input->mouse_down[0])
        nook_orbit_turn(&v->orbit, -turn_per_pixel * input->mouse_dx, -turn_per_pixel * input->mouse_dy);
    if (dragged && (input->mouse_down[1] || input->mouse_down[2]))
        nook_orbit_pan(&v->orbit, -metres * input->mouse_dx, metres * input->mouse_dy);
    if (input->scroll != 0.0)
        nook_orbit_zoom(&v->orbit, input->scroll);
    return (dragged && (input->mouse_down[0] || input->mouse_down[1] || input->mouse_down[2])) || input->scroll != 0.0;
}

static bool fly(viewer *v, const nook_input *input, double seconds)
{
    const bool *down = input->down;
    double forward = (down[NOOK_KEY_W] || down[NOOK_KEY_UP]) - (down[NOOK_KEY_S] || down[NOOK_KEY_DOWN]);
    double right = (down[NOOK_KEY_D] || down[NOOK_KEY_RIGHT]) - (down[NOOK_KEY_A] || down[NOOK_KEY_LEFT]);
    double up = down[NOOK_KEY_E] - down[NOOK_KEY_Q];
    double metres = fly_per_second * v->diagonal * seconds;
    nook_orbit_fly(&v->orbit, forward * metres, right * metres, up * metres);
    return forward != 0.0 || right != 0.0 || up != 0.0;
}

static void move(viewer *v, const nook_input *input)
{
    double now = nook_clock_ms();
    double seconds = fmin(now - v->polled_ms, 250.0) / 1000.0;
    v->polled_ms = now;
    bool dragged = drag(v, input);
    if (fly(v, input, seconds) || dragged) {
        v->changed = true;
        v->moved_ms = now;
    }
    if (input->pressed[NOOK_KEY_C])
        next_camera(v);
    if (v->coarse && now - v->moved_ms > still_after_ms)
        v->changed = true;
}

/* Records the technique. While something moves the trace is coarse. */
static nook_result occlude(viewer *v, bool moving)
{
    nook_ao *ao = v->stage->ao;
    double scale = moving ? fmax(v->scale, SCALE_WHILE_MOVING) : v->scale;
    nook_result result = nook_ao_set_param(ao, "ao.scale", scale);
    if (result == NOOK_OK)
        result = nook_ao_set_technique(ao, v->technique->name);
    if (result != NOOK_OK)
        return result;
    nook_gpu_finish(v->stage->gpu);
    double start = nook_clock_ms();
    result = nook_stage_occlude(v->stage);
    nook_gpu_finish(v->stage->gpu);
    v->ms = nook_clock_ms() - start;
    return result;
}

/* Whether what failed is a shader that was never good: saving a better one is seen, so the picture goes on without it. */
static bool can_be_mended(const viewer *v)
{
    nook_shader_report report;
    nook_gpu_shader_report(v->stage->gpu, &report);
    return v->shaders && report.failed > 0;
}

/* Makes everything anew; the reference waits until nothing moves. */
static nook_result redraw(viewer *v)
{
    bool moving = nook_clock_ms() - v->moved_ms < still_after_ms;
    nook_camera camera = nook_orbit_camera(&v->orbit);
    v->occluded = v->technique && !(moving && v->technique->exact);
    v->coarse = moving;
    v->changed = false;
    nook_result result = nook_stage_begin(v->stage, &camera);
    if (result == NOOK_OK && v->occluded && occlude(v, moving) != NOOK_OK) {
        if (!can_be_mended(v))
            return NOOK_E_DEVICE;
        v->occluded = false;
    }
    return result;
}

/* What is wrong with shaders or a scene that were saved; "" when nothing. */
static const char *reload_error(const viewer *v)
{
    const char *shaders = v->shaders ? nook_shader_reload_status(v->shaders)->error : "";
    return shaders[0] || !v->scenes ? shaders : nook_scene_reload_status_of(v->scenes)->error;
}

static void show_title(const viewer *v)
{
    char title[512], cost[64] = "";
    const char *error = reload_error(v), *keys = "0-9 technique, V view, C camera, Esc quits";
    if (v->occluded)
        snprintf(cost, sizeof cost, " %.1f ms", v->ms);
    snprintf(title, sizeof title, "Nook - %s - %d %s%s - %s - %.*s", v->scene_name, v->key,
             v->technique ? v->technique->name : "none", cost, nook_view_name(v->view),
             error[0] ? (int)strcspn(error, "\n") : (int)strlen(keys), error[0] ? error : keys);
    nook_context_set_title(v->stage->context, title);
}

static nook_result draw(viewer *v, const nook_input *input)
{
    nook_result result = v->changed ? redraw(v) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    result = nook_stage_finish(v->stage, v->occluded, v->view);
    if (result != NOOK_OK)
        return result;
    nook_renderer_present(v->stage->renderer, input->width, input->height);
    nook_context_present(v->stage->context);
    show_title(v);
    v->reshade = false;
    return NOOK_OK;
}

/* Takes what was saved of shaders and of the scene. */
static void reload(viewer *v)
{
    if (v->shaders && nook_shader_reload_poll(v->shaders))
        v->changed = true;
    if (!v->scenes)
        return;
    uint32_t failures = nook_scene_reload_status_of(v->scenes)->failures;
    if (nook_scene_reload_poll(v->scenes)) {
        nook_scene_reload_swap(v->scenes, NULL);
        v->changed = true;
    }
    v->changed = v->changed || nook_scene_reload_status_of(v->scenes)->failures != failures;
}

static void rest(void)
{
    const struct timespec pause = { 0, 8 * 1000 * 1000 };
    nanosleep(&pause, NULL);
}

static nook_result loop(viewer *v)
{
    for (;;) {
        nook_input input;
        nook_context_poll(v->stage->context, &input);
        if (input.close_requested || input.pressed[NOOK_KEY_ESCAPE])
            return NOOK_OK;
        read_keys(v, &input);
        move(v, &input);
        reload(v);
        nook_result result = NOOK_OK;
        bool visible = input.width > 0 && input.height > 0;
        if (visible && (input.width != v->stage->width || input.height != v->stage->height)) {
            result = nook_stage_set_size(v->stage, input.width, input.height);
            v->changed = true;
        }
        if (result == NOOK_OK && visible && (v->changed || v->reshade))
            result = draw(v, &input);
        else
            rest();
        if (result != NOOK_OK)
            return result;
    }
}

nook_result nook_view_run(nook_stage *stage, const nook_camera *camera, const nook_compare_choice *choice,
                          const char *scene_name)
{
    viewer v = {
        .stage = stage, .scene_name = scene_name, .choice = choice, .changed = true, .polled_ms = nook_clock_ms()
    };
    double rays;
    v.diagonal = nook_scene_diagonal(stage->scene);
    v.moved_ms = v.polled_ms - still_after_ms;
    v.orbit = orbit_from(&v, camera);
    v.camera = camera_after(stage->scene, camera);
    nook_result result = nook_ao_get_param(stage->ao, "ao.scale", &v.scale);
    if (result == NOOK_OK)
        result = nook_ao_get_param(stage->ao, "reference.rays", &rays);
    if (result == NOOK_OK)
        result = nook_ao_set_param(stage->ao, "reference.rays", fmin(rays, rays_max));
    if (result != NOOK_OK)
        return result;
    if (nook_shader_reload_create(stage->gpu, &v.shaders) != NOOK_OK)
        nook_log_warning("view: shaders that change are not seen until the next start");
    if (nook_scene_reload_create(stage, NULL, &v.scenes) != NOOK_OK)
        nook_log_warning("view: a scene that changes is not seen until the next start");
    choose_technique(&v, 1);
    nook_context_show(stage->context);
    result = loop(&v);
    nook_scene_reload_destroy(v.scenes);
    nook_shader_reload_destroy(v.shaders);
    nook_ao_set_param(stage->ao, "reference.rays", rays);
    nook_ao_set_param(stage->ao, "ao.scale", v.scale);
    return result;
}
