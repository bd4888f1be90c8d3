/* Files that are saved while one plays: shaders, level and models, settings. What is wrong with them stands on the screen; what ran goes on. */
#include "game/play/play_reload.h"
#include "engine/core/log.h"
#include <stdio.h>
#include <string.h>

static void watch_settings(nook_play_window *w)
{
    if (*w->settings_path && nook_settings_reload_create(w->settings_path, &w->settings_watch) != NOOK_OK)
        nook_log_warning("play: %s is not read again before the next start", w->settings_path);
}

void nook_play_watch(nook_play_window *w)
{
    if (nook_shader_reload_create(w->stage.gpu, &w->shaders) != NOOK_OK)
        nook_log_warning("play: shaders that are saved are not seen before the next start");
    if (nook_scene_reload_create(&w->stage, w->play.level->path, &w->scenes) != NOOK_OK)
        nook_log_warning("play: a level or model that is saved is not seen before the next start");
    watch_settings(w);
}

void nook_play_unwatch(nook_play_window *w)
{
    nook_settings_reload_destroy(w->settings_watch);
    nook_scene_reload_destroy(w->scenes);
    nook_shader_reload_destroy(w->shaders);
    w->settings_watch = NULL;
    w->scenes = NULL;
    w->shaders = NULL;
}

/* Where nothing is planned, how does not matter. */
static bool is_planned_alike(const nook_plan_params *a, const nook_plan_params *b)
{
    return a->mode == b->mode && (a->mode == NOOK_PLAN_OFF || memcmp(a, b, sizeof *a) == 0);
}

/* The active view shows the setting; reach and falloff are of all views. Volumes keep their resolution until the next start, and are
   baked, planned or live as they were. */
static void use_settings(nook_play_window *w, const nook_settings_file *file)
{
    if (file->live != w->stage.live_scene || !is_planned_alike(&file->plan, &w->stage.plan))
        nook_log_warning("play: %s: plan and volumes are taken over with the next start", w->settings_path);
    nook_live_views *views = nook_live_state(w->live);
    char text[NOOK_SETTING_TEXT_MAX] = "";
    double falloff;
    nook_setting_print(&file->setting, text);
    memcpy(views->views[views->active].setting, text, sizeof text);
    views->views[views->active].open = false;
    if (file->r_max > 0.0)
        views->r_max = file->r_max;
    if (file->falloff[0] && nook_ao_parse_param(w->stage.ao, "ao.falloff", file->falloff) == NOOK_OK &&
        nook_ao_get_param(w->stage.ao, "ao.falloff", &falloff) == NOOK_OK)
        views->falloff = falloff;
    if (w->stage.stream)
        (void)nook_stream_set_params(w->stage.stream, &file->stream); /* in their ranges, or the file was refused */
    else if (file->stream.budget > 0.0f && !file->live)
        nook_log_info("play: a first volumes.budget comes with the next start");
    w->settings = *file;
    nook_log_info("play: settings taken over: %s", text);
}

static nook_result go_on(void *game, nook_level *level, const nook_scene *scene, nook_game_world *world)
{
    return nook_play_go_on(game, level, scene, world);
}

/* A level that was saved may name other settings. */
static void follow_settings(nook_play_window *w)
{
    const char *named = w->play.level->settings;
    if (w->settings_given || strcmp(named, w->settings_path) == 0)
        return;
    if (!*named) {
        nook_log_info("play: the level names no settings any more; %s stays until the next start", w->settings_path);
        return;
    }
    nook_settings_reload_destroy(w->settings_watch);
    w->settings_watch = NULL;
    snprintf(w->settings_path, sizeof w->settings_path, "%s", named);
    watch_settings(w);
    if (w->settings_watch)
        nook_settings_reload_ask(w->settings_watch);
    nook_live_save_to(w->live, named);
}

static void take_scene(nook_play_window *w)
{
    /* A game that goes on in other volumes is another session: what is recorded or replayed would end there. */
    if (!*w->play.record_path && nook_play_is_free(&w->play))
        nook_scene_reload_plan_for(w->scenes, nook_live_multiplies(w->live));
    if (nook_scene_reload_poll(w->scenes)) {
        nook_live_suspend(w->live); /* its truth reads the triangles of the old one */
        if (nook_scene_reload_swap(w->scenes, go_on, &w->play) == NOOK_OK)
            follow_settings(w);
    }
    nook_live_message(w->live, "scene", nook_scene_reload_status_of(w->scenes)->error);
}

void nook_play_take_changes(nook_play_window *w)
{
    nook_settings_file settings;
    if (w->settings_watch) {
        if (nook_settings_reload_poll(w->settings_watch, &settings))
            use_settings(w, &settings);
        nook_live_message(w->live, "settings", nook_settings_reload_error(w->settings_watch));
    }
    if (w->shaders) {
        if (nook_shader_reload_poll(w->shaders))
            nook_live_suspend(w->live); /* what it has frozen was drawn by the old ones */
        nook_live_message(w->live, "shaders", nook_shader_reload_status(w->shaders)->error);
    }
    if (w->scenes)
        take_scene(w);
    nook_live_message(w->live, "code", w->trouble);
}
