#include "game/view/viewer.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/compare/camera.h"
#include "game/live/live.h"
#include "game/live/scene_reload.h"
#include "game/live/shader_reload.h"
#include "game/view/orbit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double still_after_ms = 200.0; /* from the last movement to the full picture */
static const double rest_ms = 8.0;          /* of a frame in which nothing is to be done */
static const double turn_per_pixel = 0.005; /* radians */
static const double fly_per_second = 0.25;  /* of the scene's diagonal */

typedef struct viewer {
    nook_stage *stage;
    const char *scene_name;
    nook_shader_reload *shaders; /* NULL: they cannot be watched */
    nook_scene_reload *scenes;   /* the same of the scene's files */
    nook_live *live;
    nook_orbit orbit;
    double diagonal;   /* metres */
    uint32_t camera;   /* the next one that C goes to */
    bool moving;       /* the picture is coarse */
    bool jumped;       /* to another camera */
    char setting[128]; /* technique of the active view when it was last logged */
    double moved_ms, polled_ms;
} viewer;

/* Those of a choice in the order of the number keys: what is measured first, then what it is measured against. */
static uint32_t list_techniques(const nook_compare_choice *choice, const char *out[NOOK_COMPARE_TECHNIQUES_MAX])
{
    uint32_t count = 0;
    for (uint32_t exact = 0; exact < 2; exact++) {
        for (uint32_t i = 0; i < choice->count; i++) {
            if (choice->techniques[i]->exact == exact)
                out[count++] = choice->techniques[i]->name;
        }
    }
    return count;
}

/* ---- Keys -------------------------------------------------------------------------------------------------------- */

/* V walks through the buffers only: the picture, visibility, then the others as they are declared; M goes everywhere. */
static void step_buffer(viewer *v, bool back)
{
    nook_live_views *views = nook_live_state(v->live);
    uint32_t *mode = &views->views[views->active].mode, count = nook_live_mode_count();
    do
        *mode = (*mode + (back ? count - 1 : 1)) % count;
    while (*mode > NOOK_LIVE_VISIBILITY && *mode < NOOK_LIVE_BUFFERS);
}

static void tell_technique(viewer *v)
{
    char name[sizeof v->setting];
    const char *setting = nook_live_active_setting(v->live);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(setting, " "), setting);
    if (strcmp(name, v->setting) == 0)
        return;
    memcpy(v->setting, name, sizeof name);
    nook_log_info("view: technique %s", name);
}

/* The keys and drags that are the window's own, beside those that nook_live lists at F1. */
static void draw_help(const nook_live *live, nook_overlay *overlay)
{
    static const nook_overlay_colour gold = { 255, 214, 120, 255 };
    static const char *const lines[][2] = {
        { "drag left", "orbit" },
        { "drag right", "pan" },
        { "scroll", "zoom" },
        { "W A S D Q E, arrows", "fly" },
        { "V", "the next buffer; Shift: back" },
        { "C", "the next camera of the file" },
        { "Esc", "quit" },
        { "F1", "the keys of the views" },
    };
    bool alone = nook_live_help_shown(live) == NOOK_LIVE_HELP_HOST;
    const size_t count = NOOK_COUNT(lines) - (alone ? 0 : 1); /* beside or above them nobody asks */
    const nook_overlay_panel panel = {
        .title = "Looking##help", .x = 8.0, .y = -nook_live_help_bottom(live), .passive = true
    };
    if (nook_overlay_panel_begin(overlay, &panel)) {
        for (size_t i = 0; i < count; i++) {
            nook_overlay_text_coloured(overlay, gold, lines[i][0]);
            nook_overlay_same_line_at(overlay, 9.5);
            nook_overlay_text(overlay, lines[i][1]);
        }
    }
    nook_overlay_panel_end(overlay);
}

static void read_keys(viewer *v, const nook_input *input)
{
    if (input->pressed[NOOK_KEY_V] || input->pressed[NOOK_KEY_F])
        step_buffer(v, nook_input_held(input, NOOK_KEY_SHIFT));
    tell_technique(v);
}

/* ---- Camera ------------------------------------------------------------------------------------------------------ */

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
    v->jumped = true;
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
    if (fly(v, input, seconds) || dragged)
        v->moved_ms = now;
    if (input->pressed[NOOK_KEY_C])
        next_camera(v);
    v->moving = now - v->moved_ms < still_after_ms;
    if (v->moved_ms == now || v->jumped) { /* what was frozen is not what is to be seen */
        nook_live_freeze(v->live, false);
        nook_live_hold(v->live, false);
    }
    v->jumped = false;
}

/* ---- Picture ----------------------------------------------------------------------------------------------------- */

/* What is wrong with shaders or a scene that were saved; "" when nothing. */
static const char *reload_error(const viewer *v)
{
    const char *shaders = v->shaders ? nook_shader_reload_status(v->shaders)->error : "";
    return shaders[0] || !v->scenes ? shaders : nook_scene_reload_status_of(v->scenes)->error;
}

static void show_title(const viewer *v)
{
    char title[512], cost[64] = "";
    const nook_live_views *views = nook_live_state(v->live);
    const char *error = reload_error(v), *keys = "0-9 technique, V view, C camera, F1 all keys, Esc quits";
    if (nook_live_ao_ms(v->live) > 0.0)
        snprintf(cost, sizeof cost, " %.1f ms", nook_live_ao_ms(v->live));
    snprintf(title, sizeof title, "Nook - %s - %u %s%s - %s - %.*s", v->scene_name, nook_live_active_technique(v->live),
             v->setting, cost, nook_live_mode_name(views->views[views->active].mode),
             error[0] ? (int)strcspn(error, "\n") : (int)strlen(keys), error[0] ? error : keys);
    nook_context_set_title(v->stage->context, title);
}

/* While something moves the trace is coarse; what stands still is held, and the truth of it traced where a view shows some. */
static nook_result draw(viewer *v, const nook_input *input)
{
    nook_camera camera = nook_orbit_camera(&v->orbit);
    nook_live_help help = nook_live_help_shown(v->live);
    if (help == NOOK_LIVE_HELP_HOST || help == NOOK_LIVE_HELP_BOTH)
        draw_help(v->live, nook_live_overlay(v->live));
    nook_live_set_coarse(v->live, v->moving);
    nook_live_hold(v->live, !v->moving);
    nook_result result = nook_live_draw(v->live, &camera);
    if (result == NOOK_OK)
        result = nook_live_present(v->live, input->width, input->height);
    nook_context_present(v->stage->context);
    show_title(v);
    return result;
}

/* Takes what was saved of shaders and of the scene. */
static void reload(viewer *v)
{
    if (v->shaders && nook_shader_reload_poll(v->shaders))
        nook_live_suspend(v->live); /* what it holds was drawn by the old ones */
    if (v->scenes)
        nook_scene_reload_plan_for(v->scenes, nook_live_multiplies(v->live));
    if (v->scenes && nook_scene_reload_poll(v->scenes)) {
        nook_live_suspend(v->live); /* the truth reads its meshes */
        nook_scene_reload_swap(v->scenes, NULL, NULL);
    }
    nook_live_message(v->live, "reload", reload_error(v));
}

static nook_result frame(viewer *v, const nook_input *input)
{
    if (input->width == 0 || input->height == 0) { /* minimised */
        nook_clock_rest(rest_ms);
        return NOOK_OK;
    }
    nook_result result = NOOK_OK;
    if (input->width != v->stage->width || input->height != v->stage->height)
        result = nook_stage_set_size(v->stage, input->width, input->height);
    reload(v);
    if (result == NOOK_OK && (v->moving || nook_live_is_stale(v->live)))
        return draw(v, input);
    nook_clock_rest(rest_ms);
    return result;
}

static nook_result loop(viewer *v)
{
    for (;;) {
        nook_input input, left;
        nook_context_poll(v->stage->context, &input);
        if (input.close_requested || input.pressed[NOOK_KEY_ESCAPE])
            return NOOK_OK;
        nook_live_input(v->live, &input, true, &left);
        read_keys(v, &left);
        move(v, &left);
        nook_result result = frame(v, &input);
        if (result != NOOK_OK)
            return result;
    }
}

static nook_result open_live(viewer *v, const nook_compare_choice *choice)
{
    const char *techniques[NOOK_COMPARE_TECHNIQUES_MAX];
    const nook_live_desc desc = { .stage = v->stage,
                                  .shaders_reload = true,
                                  .techniques = techniques,
                                  .technique_count = list_techniques(choice, techniques) };
    nook_result result = nook_live_create(&desc, &v->live);
    if (result == NOOK_OK)
        nook_live_set_timing(v->live, true);
    return result;
}

nook_result nook_view_run(nook_stage *stage, const nook_camera *camera, const nook_compare_choice *choice,
                          const char *scene_name)
{
    viewer v = { .stage = stage, .scene_name = scene_name, .polled_ms = nook_clock_ms() };
    v.diagonal = nook_scene_diagonal(stage->scene);
    v.moved_ms = v.polled_ms - still_after_ms;
    v.orbit = orbit_from(&v, camera);
    v.camera = camera_after(stage->scene, camera);
    nook_result result = open_live(&v, choice);
    if (result != NOOK_OK)
        return result;
    if (nook_shader_reload_create(stage->gpu, &v.shaders) != NOOK_OK)
        nook_log_warning("view: shaders that change are not seen until the next start");
    if (nook_scene_reload_create(stage, NULL, &v.scenes) != NOOK_OK)
        nook_log_warning("view: a scene that changes is not seen until the next start");
    tell_technique(&v);
    nook_context_show(stage->context);
    result = loop(&v);
    nook_scene_reload_destroy(v.scenes);
    nook_shader_reload_destroy(v.shaders);
    nook_live_destroy(v.live);
    return result;
}
