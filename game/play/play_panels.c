#include "game/play/play_panels.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const nook_overlay_colour white = { 255, 255, 255, 255 }, gold = { 255, 214, 120, 255 };
static const nook_overlay_colour soft = { 255, 255, 255, 150 };
static const double menu_width = 26.0; /* letters' heights */

/* A label whose middle is at (x, y). */
static void label_around(nook_overlay *overlay, double x, double y, nook_overlay_colour colour, const char *text)
{
    double size[2];
    nook_overlay_label_size(overlay, text, size);
    nook_overlay_label(overlay, (double[]){ x - 0.5 * size[0], y - 0.5 * size[1] }, colour, text);
}

/* Lines whose middles lie on x, the last at y: no wider than the picture. @return where a line above them would be */
static double label_lines(nook_overlay *overlay, double x, double y, nook_overlay_colour colour, const char *text)
{
    const double step = 1.6 * nook_overlay_letter_height(overlay), width = 1.8 * x;
    double top = y + step;
    for (const char *at = text; *at; at += strspn(at, " "), top -= step)
        at += nook_overlay_line_length(overlay, at, width);
    for (y = top; *text; text += strspn(text, " "), y += step) {
        char line[512];
        size_t length = nook_overlay_line_length(overlay, text, width);
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        label_around(overlay, x, y, colour, line);
        text += length;
    }
    return top - step;
}

static void draw_cross(nook_overlay *overlay, double x, double y, bool something)
{
    double arm = (something ? 0.6 : 0.35) * nook_overlay_letter_height(overlay);
    nook_overlay_colour colour = something ? gold : soft;
    nook_overlay_line(overlay, (double[]){ x - arm, y }, (double[]){ x + arm, y }, colour, 2.0);
    nook_overlay_line(overlay, (double[]){ x, y - arm }, (double[]){ x, y + arm }, colour, 2.0);
}

/* A name of a file as people write it. */
static void put_blanks(char *name)
{
    for (char *c = name; *c; c++)
        *c = *c == '_' ? ' ' : *c;
}

static void draw_hint(const nook_play_window *window, nook_overlay *overlay, const nook_session_view *view, double x,
                      double y)
{
    char text[160];
    if (window->controls.asks_for > 0.0) {
        label_lines(overlay, x, y, gold, "Backspace (gamepad: Back) again: from the start");
        return;
    }
    if (*view->carried)
        snprintf(text, sizeof text, "E let go   Q throw   R turn");
    else if (*view->looked_at)
        snprintf(text, sizeof text, "E take %s", view->looked_at);
    else
        return;
    put_blanks(text);
    label_around(overlay, x, y, white, text);
}

enum { STATE_LINES = 3, STATE_SIZE = 160 };

typedef struct state_line {
    char text[STATE_SIZE];
    nook_overlay_colour colour;
} state_line;

/* What stands in the corner. @return how many lines */
static uint32_t tell_state(const nook_play_window *window, const nook_session_view *view, state_line out[STATE_LINES])
{
    uint32_t count = 0;
    if (view->locks > 0) {
        out[count].colour = white;
        snprintf(out[count++].text, STATE_SIZE, "%u of %u locks open", view->open, view->locks);
    }
    if (view->seconds_left > 0.0) {
        int seconds = (int)ceil(view->seconds_left);
        out[count].colour = seconds < 30 ? gold : white;
        snprintf(out[count++].text, STATE_SIZE, "%d:%02d", seconds / 60, seconds % 60);
    }
    if (window->preferences.frame_times) {
        double median = nook_frame_pacing_quantile(&window->pacing, 0.5);
        out[count].colour = white;
        snprintf(out[count++].text, STATE_SIZE, "%.1f ms a frame (%.0f a second), 99 %% within %.1f ms, %u x %u",
                 median, median > 0.0 ? 1000.0 / median : 0.0, nook_frame_pacing_quantile(&window->pacing, 0.99),
                 window->stage.width, window->stage.height);
    }
    return count;
}

/* Below the names of views that reach into the corner. */
static void draw_state(const nook_play_window *window, nook_overlay *overlay, const nook_session_view *view)
{
    const double step = 1.6 * nook_overlay_letter_height(overlay), x = 0.5 * step;
    state_line lines[STATE_LINES];
    uint32_t count = tell_state(window, view, lines);
    double widest = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double size[2];
        nook_overlay_label_size(overlay, lines[i].text, size);
        widest = fmax(widest, size[0]);
    }
    double y = fmax(0.5 * step, nook_live_names_bottom(window->live, x + widest) + 0.25 * step);
    for (uint32_t i = 0; i < count; i++, y += step)
        nook_overlay_label(overlay, (double[]){ x, y }, lines[i].colour, lines[i].text);
}

/* @return where a line above it would be */
static double draw_message(const nook_play_window *window, nook_overlay *overlay, const nook_session_view *view)
{
    const double line = nook_overlay_letter_height(overlay), x = 0.5 * window->width;
    bool plays = view->status == NOOK_SESSION_PLAYING;
    double y = label_lines(overlay, x, window->height - 4.5 * line, plays ? white : gold, view->message);
    if (plays)
        return *view->message ? y : window->height;
    label_around(overlay, x, y, white, "Backspace: from the start again");
    return y - 1.6 * line;
}

/*
 * While it is paused the menu says what is to be done; the lists of keys lie where the message is. In a low window that reaches up
 * to below the cross: the hint goes above it.
 */
void nook_play_draw_hud(nook_play_window *window, nook_overlay *overlay)
{
    const nook_session_view view = nook_session_look(window->play.session);
    const double x = 0.5 * window->width, y = 0.5 * window->height, gap = 3.0 * nook_overlay_letter_height(overlay);
    double free_down_to = window->height;
    draw_state(window, overlay, &view);
    if (window->paused)
        return;
    draw_cross(overlay, x, y, *view.looked_at || *view.carried);
    if (nook_live_help_shown(window->live) == NOOK_LIVE_HELP_NONE && !(window->controls.asks_for > 0.0))
        free_down_to = draw_message(window, overlay, &view);
    draw_hint(window, overlay, &view, x, y + gap <= free_down_to ? y + gap : y - gap);
}

/* A slider, a choice or a box for each row of preferences.def. */
static void draw_preference(nook_play_window *window, nook_overlay *overlay, const nook_param *param)
{
    char label[64];
    snprintf(label, sizeof label, "%s", param->name);
    put_blanks(label);
    double value = nook_param_get(param, &window->preferences);
    int choice = (int)value;
    bool changed = false;
    if (param->type == NOOK_PARAM_CHOICE) {
        changed = nook_overlay_choice(overlay, label, &choice, param->choices);
        value = choice;
    } else if (param->type == NOOK_PARAM_INT) {
        int whole = (int)value;
        changed = nook_overlay_slider_int(overlay, label, &whole, (int)param->lowest, (int)param->highest,
                                          nook_unit_name(param->unit));
        value = whole;
    } else {
        changed =
            nook_overlay_slider(overlay, label, &value, param->lowest, param->highest, nook_unit_name(param->unit));
    }
    nook_overlay_tooltip(overlay, param->help);
    if (changed)
        nook_param_set(param, "preferences", &window->preferences, value);
}

/* A try is minutes of play: the first press asks, where it is not over. */
static void draw_restart(nook_play_window *window, nook_overlay *overlay)
{
    if (!nook_overlay_button(overlay,
                             window->restart_asked ? "Yes, from the start###restart" : "From the start###restart"))
        return;
    window->restart = window->restart_asked || window->controls.try_is_over;
    window->restart_asked = !window->restart;
}

void nook_play_draw_menu(nook_play_window *window, nook_overlay *overlay)
{
    double letter = nook_overlay_letter_height(overlay), width = menu_width;
    if (nook_live_help_shown(window->live) != NOOK_LIVE_HELP_NONE &&
        window->width < (NOOK_LIVE_HELP_BESIDE + menu_width) * letter)
        return; /* there is no room beside the keys */
    const nook_overlay_panel panel = { .title = "Paused##menu",
                                       .x = fmax(0.5 * (window->width - width * letter), 1.0),
                                       .y = 0.15 * window->height,
                                       .width = width,
                                       .pad = true };
    if (nook_overlay_panel_begin(overlay, &panel)) {
        nook_overlay_text_wrapped(overlay, width - 2.0, window->play.level->title);
        nook_overlay_text_wrapped(overlay, width - 2.0, window->play.level->task);
        nook_overlay_separator(overlay);
        if (nook_overlay_button(overlay, "Go on (Esc)"))
            window->paused = false;
        nook_overlay_same_line(overlay);
        draw_restart(window, overlay);
        nook_overlay_same_line(overlay);
        if (nook_overlay_button(overlay, "Quit"))
            window->quit = true;
        nook_overlay_separator(overlay);
        nook_overlay_text_coloured(overlay, soft, "F1 lists the keys");
        for (size_t i = 0; i < NOOK_COUNT(nook_preferences_table); i++)
            draw_preference(window, overlay, &nook_preferences_table[i]);
    }
    nook_overlay_panel_end(overlay);
}

/* Beside the list of the views' keys, or above it, or before it. */
void nook_play_draw_help(const nook_play_window *window, nook_overlay *overlay)
{
    bool alone = nook_live_help_shown(window->live) == NOOK_LIVE_HELP_HOST;
    static const char *const lines[][3] = {
        { "W A S D, arrows", "walk", "left stick" },
        { "mouse", "look", "right stick" },
        { "Shift", "run", "left trigger" },
        { "Space", "jump", "A" },
        { "Ctrl, C", "crouch", "B" },
        { "E, left click", "take, let go", "X" },
        { "Q, right click", "throw", "right trigger" },
        { "R, held", "turn it", "right bumper" },
        { "Backspace, twice", "from the start", "Back, twice" },
        { "Esc", "pause", "Start; cross, A" },
        { "F11", "full screen", "" },
        { "F1", "the keys of the views", "" },
    };
    const size_t count = NOOK_COUNT(lines) - (alone ? 0 : 1); /* beside or above them nobody asks */
    const nook_overlay_panel panel = {
        .title = "##playing", .x = 8.0, .y = -nook_live_help_bottom(window->live), .bare = true, .passive = true
    };
    if (nook_overlay_panel_begin(overlay, &panel)) {
        for (size_t i = 0; i < count; i++) {
            nook_overlay_text_coloured(overlay, gold, lines[i][0]);
            nook_overlay_same_line_at(overlay, 8.5);
            nook_overlay_text(overlay, lines[i][1]);
            nook_overlay_same_line_at(overlay, 15.5);
            nook_overlay_text_coloured(overlay, soft, lines[i][2]);
        }
    }
    nook_overlay_panel_end(overlay);
}
