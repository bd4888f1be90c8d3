#include "game/play/play_window.h"
#include "engine/core/angle.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/exposure.h"
#include "game/play/play_panels.h"
#include "game/play/play_picture.h"
#include "game/play/play_reload.h"
#include "game/stage_settings.h"
#include "game/stream_volumes.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double captured_rate = 30.0; /* pictures a second */
static const double rest_ms = 8.0;        /* of a frame in which nothing is to be done */

/* ---- Opening and closing ----------------------------------------------------------------------------------------- */

/* What draws the light's shadow: the command line's, else the level's, else volume as it comes. */
static nook_result read_settings(nook_play_window *w, const char *given)
{
    w->settings_given = given != NULL;
    snprintf(w->settings_path, sizeof w->settings_path, "%s", given ? given : w->play.level->settings);
    return nook_stage_settings_read(w->settings_path, &w->settings);
}

static nook_result open_stage(nook_play_window *w, const char *root, const nook_play_window_desc *desc)
{
    const nook_stage_desc stage = { .root = root,
                                    .scene_path = w->play.level->path,
                                    .scene = nook_play_take_scene(&w->play),
                                    .backend = desc->backend,
                                    .want_window = !desc->no_window,
                                    .plays = true,
                                    .width = desc->width,
                                    .height = desc->height };
    nook_result result = nook_stage_open(&stage, &w->stage);
    if (result != NOOK_OK)
        return result;
    w->stage.quick = true;
    w->has_window = w->stage.shows;
    if (!w->has_window && !w->driven && nook_play_is_free(&w->play))
        return nook_fail(NOOK_E_DEVICE, "play: %s; give --replay or --pilot",
                         desc->no_window ? "nobody plays without a window" : "there is no display to play on");
    w->width = desc->width;
    w->height = desc->height;
    return NOOK_OK;
}

static nook_camera camera_of(const nook_play_window *w, double alpha)
{
    return nook_session_camera(w->play.session, alpha, (double)w->preferences.field_of_view * NOOK_DEGREE);
}

static nook_result make_live(nook_play_window *w, const char *pictures)
{
    char notes[1024 + 64];
    snprintf(notes, sizeof notes, "level = %s\nseed = %u", w->play.recording.level, w->play.seed);
    const nook_live_desc live = { .stage = &w->stage,
                                  .shaders_reload = w->has_window,
                                  .setting = &w->settings.setting,
                                  .settings_path = *w->settings_path ? w->settings_path : NULL,
                                  .pictures = pictures,
                                  .notes = notes };
    return nook_live_create(&live, &w->live);
}

/* Plays without pictures, as fast as it goes, while something but the player drives it. */
static nook_result pass_time(nook_play_window *w, double seconds)
{
    const nook_play_input nothing = { 0 };
    nook_result result = NOOK_OK;
    for (double t = 0.0; t < seconds && result == NOOK_OK && !nook_play_is_free(&w->play); t += NOOK_PHYSICS_STEP)
        result = nook_play_tick(&w->play, &nothing);
    return result;
}

static nook_result begin(nook_play_window *w, const nook_play_window_desc *desc)
{
    w->stage.stream_params = w->settings.stream;
    nook_result result = nook_stage_fill_as_set(&w->stage, &w->settings, desc->cache);
    if (result == NOOK_OK)
        result = nook_play_begin(&w->play, w->stage.scene, w->stage.world);
    if (result == NOOK_OK)
        result = make_live(w, desc->pictures);
    if (result != NOOK_OK)
        return result;
    result = pass_time(w, desc->from_seconds);
    if (result == NOOK_OK && desc->capture)
        result =
            nook_live_capture(w->live, &(nook_capture_desc){ desc->capture, desc->width, desc->height, captured_rate });
    if (result != NOOK_OK)
        return result;
    nook_session_place(w->play.session, 1.0);
    nook_camera camera = camera_of(w, 1.0);
    result = nook_stage_expose(&w->stage, &camera);
    if (w->has_window) {
        nook_play_watch(w);
        nook_context_show(w->stage.context);
        nook_context_set_fullscreen(w->stage.context, w->preferences.full_screen);
    }
    w->clock_ms = nook_clock_ms();
    return result;
}

nook_result nook_play_window_open(const char *root, const nook_play_window_desc *desc, nook_play_window *out_window)
{
    nook_play_window *w = out_window;
    memset(w, 0, sizeof *w);
    w->frame_seconds = desc->capture ? 1.0 / captured_rate : desc->frame_seconds;
    w->frame_rate = desc->frame_rate;
    w->driven = desc->driven;
    w->captures = desc->capture != NULL;
    w->frames_left = desc->frames;
    nook_path_join(w->preferences_path, sizeof w->preferences_path, desc->cache, "preferences.txt");
    nook_preferences_read(w->preferences_path, &w->preferences);
    w->kept = w->preferences;
    nook_result result = desc->capture ? nook_capture_check(desc->capture) : NOOK_OK;
    if (result == NOOK_OK)
        result = nook_play_open(&desc->play, &w->play);
    if (result == NOOK_OK)
        result = read_settings(w, desc->settings);
    if (result == NOOK_OK)
        result = open_stage(w, root, desc);
    if (result == NOOK_OK)
        result = begin(w, desc);
    if (result != NOOK_OK) {
        w->play.record_path[0] = '\0'; /* nothing was played */
        nook_play_window_close(w);
    }
    return result;
}

nook_result nook_play_window_renew(nook_play_window *w)
{
    nook_setting_renew(&w->settings.setting);
    return nook_stage_renew(&w->stage);
}

static void tell_volumes(const nook_stream *stream)
{
    char line[160];
    nook_log_info("play: %s", nook_stream_print(stream, line, sizeof line));
}

/* On disk as soon as they are chosen: not every game ends in order. */
static void keep_preferences(nook_play_window *w)
{
    if (memcmp(&w->preferences, &w->kept, sizeof w->kept) == 0)
        return;
    nook_preferences_write(w->preferences_path, &w->preferences);
    w->kept = w->preferences; /* also when they cannot be written, which is said once */
}

nook_result nook_play_window_close(nook_play_window *w)
{
    if (w->stage.stream)
        tell_volumes(w->stage.stream);
    nook_result result = nook_play_close(&w->play); /* before the world that it stands in */
    keep_preferences(w);
    nook_play_unwatch(w);
    if (w->live) {
        nook_result captured = nook_live_capture_end(w->live);
        result = result == NOOK_OK ? captured : result;
    }
    nook_live_destroy(w->live);
    if (w->stage.gpu)
        nook_picture_time_release(&w->picture_time, w->stage.gpu);
    nook_stage_close(&w->stage);
    memset(w, 0, sizeof *w);
    return result;
}

/* ---- Input ------------------------------------------------------------------------------------------------------- */

/* Keys that are the window's own. */
static void read_keys(nook_play_window *w, const nook_input *input)
{
    bool was_full = w->preferences.full_screen != 0;
    if (input->close_requested)
        w->quit = true;
    if (input->pressed[NOOK_KEY_ESCAPE] || input->pad.pressed[NOOK_PAD_START] || (w->captured && !input->focused))
        w->paused = !w->paused;
    if (input->pressed[NOOK_KEY_F11])
        w->preferences.full_screen = !was_full;
    if ((w->preferences.full_screen != 0) != was_full)
        nook_context_set_fullscreen(w->stage.context, !was_full);
}

/* The mouse looks around while one plays, and is a pointer otherwise. */
static void capture_mouse(nook_play_window *w, const nook_input *input)
{
    bool wanted = !w->paused && input->focused && !nook_live_wants_pointer(w->live);
    if (wanted != w->captured)
        nook_context_capture_mouse(w->stage.context, wanted);
    w->captured = wanted;
}

/* ---- Time -------------------------------------------------------------------------------------------------------- */

/* Seconds since the last frame. */
static double take_time(nook_play_window *w)
{
    double now = nook_clock_ms(), ms = now - w->clock_ms;
    w->clock_ms = now;
    nook_frame_pacing_add(&w->pacing, ms);
    nook_play_picture_learn(w, ms, w->went_on);
    return w->frame_seconds > 0.0 ? w->frame_seconds : ms / 1000.0;
}

/* What has no window ends with what drives it, to the tick: its last state is that of a game without pictures. */
static bool has_run_out(const nook_play_window *w)
{
    return !w->has_window && !w->driven && (nook_play_is_free(&w->play) || nook_play_is_beyond_end(&w->play));
}

/* Long frames are cut, so that what follows a halt is no fit of ticks. */
static nook_result run_ticks(nook_play_window *w, double seconds)
{
    const double step = NOOK_PHYSICS_STEP;
    w->left = fmin(w->left + seconds, NOOK_PLAY_TICKS_PER_FRAME * step);
    nook_result result = NOOK_OK;
    while (w->left >= step && result == NOOK_OK && !has_run_out(w)) {
        nook_play_input input = nook_controls_take(&w->controls);
        if (w->restart)
            input.buttons |= NOOK_PLAY_RESTART;
        w->restart = false;
        result = nook_play_tick(&w->play, &input);
        w->left -= step;
    }
    return result;
}

/* ---- Picture ----------------------------------------------------------------------------------------------------- */

static nook_result draw_scene(nook_play_window *w)
{
    double alpha = w->left / NOOK_PHYSICS_STEP;
    nook_session_place(w->play.session, alpha);
    nook_camera camera = camera_of(w, alpha);
    return nook_live_draw(w->live, &camera);
}

static void draw_panels(nook_play_window *w)
{
    nook_overlay *overlay = nook_live_overlay(w->live);
    nook_play_draw_hud(w, overlay);
    if (w->paused)
        nook_play_draw_menu(w, overlay);
    else
        w->restart_asked = false;
    nook_live_help help = nook_live_help_shown(w->live);
    if (help == NOOK_LIVE_HELP_HOST || help == NOOK_LIVE_HELP_BOTH)
        nook_play_draw_help(w, overlay);
}

/* Without a window nobody sees it, but who asks for a rate wants the same work done for it. */
static nook_result show(nook_play_window *w)
{
    if (w->has_window)
        return nook_live_present(w->live, w->width, w->height);
    return w->frame_rate > 0.0 ? nook_live_present_unseen(w->live, w->width, w->height) : NOOK_OK;
}

/* A pointer on its way to a panel neither looks around nor takes what it clicks at. */
static void forget_mouse(nook_input *input)
{
    input->mouse_dx = input->mouse_dy = 0.0;
    memset(input->mouse_down, 0, sizeof input->mouse_down);
    memset(input->mouse_pressed, 0, sizeof input->mouse_pressed);
}

/* What a frame's keys and mouse do. */
static void use_input(nook_play_window *w, const nook_input *input, double seconds)
{
    nook_input rest;
    read_keys(w, input);
    capture_mouse(w, input);
    nook_live_input(w->live, input, !w->captured, &rest);
    if (!w->captured)
        forget_mouse(&rest);
    w->controls.try_is_over = nook_session_look(w->play.session).status != NOOK_SESSION_PLAYING;
    if (w->paused) {
        nook_controls_skip(&w->controls, input);
    } else {
        keep_preferences(w); /* the menu is closed: no slider is on its way */
        nook_controls_add(&w->controls, &rest, &w->preferences, seconds);
    }
    if (input->width > 0 && input->height > 0) {
        w->width = input->width;
        w->height = input->height;
    }
}

/* Without a window nobody types, but panels want to know how large the picture is. */
static void look_nowhere(nook_play_window *w)
{
    nook_input rest, nothing = { .width = w->width, .height = w->height, .content_scale = 1.0 };
    nook_live_input(w->live, &nothing, false, &rest);
}

/* The stage's frame_index stays as it is: where nothing averages noise over time another one in each frame would boil, and ao.accumulate
   changes rays by itself. */
static nook_result draw(nook_play_window *w)
{
    nook_result result = nook_play_picture_fit(w);
    nook_play_take_changes(w);
    if (w->has_window || w->captures)
        draw_panels(w);
    nook_picture_time_begin(&w->picture_time, w->stage.gpu);
    if (result == NOOK_OK)
        result = draw_scene(w);
    if (result == NOOK_OK)
        result = show(w);
    nook_picture_time_end(&w->picture_time, w->stage.gpu);
    if (result == NOOK_OK && w->has_window)
        nook_context_present(w->stage.context);
    return result;
}

/* While nothing moves the picture is kept, and the processor left to others; what is changed in the menu is seen at once. */
static void keep_picture(nook_play_window *w, bool stands_still)
{
    bool kept = stands_still && w->has_window && memcmp(&w->preferences, &w->drawn, sizeof w->drawn) == 0;
    w->drawn = w->preferences;
    nook_live_hold(w->live, kept);
    if (kept)
        nook_clock_rest(rest_ms);
}

nook_result nook_play_window_frame(nook_play_window *w, bool *out_goes_on)
{
    nook_input input;
    nook_context_poll(w->stage.context, &input);
    double seconds = take_time(w);
    if (w->has_window)
        use_input(w, &input, seconds);
    else if (w->captures)
        look_nowhere(w);
    bool hidden = w->has_window && (input.width == 0 || input.height == 0);
    nook_play_standing standing = nook_play_standing_of(w);
    bool goes_on = standing == NOOK_PLAY_GOES_ON || (standing == NOOK_PLAY_PAUSED && w->restart);
    nook_result result = goes_on ? run_ticks(w, seconds) : NOOK_OK;
    keep_picture(w, !goes_on || hidden);
    w->went_on = goes_on && !hidden;
    if (result == NOOK_OK && !hidden)
        result = draw(w);
    nook_play_tell(w);
    if (!w->has_window && nook_live_capture_failed(w->live))
        w->quit = true; /* nobody would see what comes */
    if (w->frames_left > 0 && --w->frames_left == 0)
        w->quit = true;
    *out_goes_on = result == NOOK_OK && !w->quit && !has_run_out(w);
    return result;
}
