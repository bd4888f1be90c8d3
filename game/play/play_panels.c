#include "game/play/play_panels.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const nook_overlay_colour white = { 255, 255, 255, 255 }, gold = { 255, 214, 120, 255 };
static const nook_overlay_colour soft = { 255, 255, 255, 150 };

/* A label whose middle is at (x, y). */
static void label_around(nook_overlay *overlay, double x, double y, nook_overlay_colour colour, const char *text)
{
    double size[2];
    nook_overlay_label_size(overlay, text, size);
    nook_overlay_label(overlay, (double[]){ x - 0.5 * size[0], y - 0.5 * size[1] }, colour, text);
}

/* The longest start of a text, cut at a space, that is no wider than `width`; the whole first word where none is. @return its bytes */
static size_t line_length(nook_overlay *overlay, const char *text, double width)
{
    char line[512];
    size_t best = 0;
    for (size_t at = 0; at <= strlen(text); at++) {
        double size[2];
        if (text[at] != ' ' && text[at] != '\0')
            continue;
        snprintf(line, sizeof line, "%.*s", (int)at, text);
        nook_overlay_label_size(overlay, line, size);
        if (best > 0 && size[0] > width)
            break;
        best = at;
    }
    return best;
}

/* Lines whose middles lie on x, the first at y: no wider than the picture. */
static void label_lines(nook_overlay *overlay, double x, double y, nook_overlay_colour colour, const char *text)
{
    double step = 1.6 * nook_overlay_letter_height(overlay);
    for (; *text; y += step) {
        char line[512];
        size_t length = line_length(overlay, text, 1.8 * x);
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        label_around(overlay, x, y, colour, line);
        text += length + (text[length] == ' ');
    }
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

static void draw_hint(nook_overlay *overlay, const nook_session_view *view, double x, double y)
{
    char text[160];
    if (*view->carried)
        snprintf(text, sizeof text, "E let go   Q throw   R turn");
    else if (*view->looked_at)
        snprintf(text, sizeof text, "E take %s", view->looked_at);
    else
        return;
    put_blanks(text);
    label_around(overlay, x, y, white, text);
}

static void draw_state(const nook_play_window *window, nook_overlay *overlay, const nook_session_view *view)
{
    double line = 1.6 * nook_overlay_letter_height(overlay), y = 0.5 * line;
    char text[160];
    if (view->locks > 0) {
        snprintf(text, sizeof text, "%u of %u locks open", view->open, view->locks);
        nook_overlay_label(overlay, (double[]){ 0.5 * line, y }, white, text);
        y += line;
    }
    if (view->seconds_left > 0.0) {
        int seconds = (int)ceil(view->seconds_left);
        snprintf(text, sizeof text, "%d:%02d", seconds / 60, seconds % 60);
        nook_overlay_label(overlay, (double[]){ 0.5 * line, y }, seconds < 30 ? gold : white, text);
        y += line;
    }
    if (window->preferences.frame_times) {
        double median = nook_frame_pacing_quantile(&window->pacing, 0.5);
        snprintf(text, sizeof text, "%.1f ms a frame (%.0f a second), 99 %% within %.1f ms", median,
                 median > 0.0 ? 1000.0 / median : 0.0, nook_frame_pacing_quantile(&window->pacing, 0.99));
        nook_overlay_label(overlay, (double[]){ 0.5 * line, y }, white, text);
    }
}

void nook_play_draw_hud(nook_play_window *window, nook_overlay *overlay)
{
    const nook_session_view view = nook_session_look(window->play.session);
    double middle[2] = { 0.5 * window->width, 0.5 * window->height };
    double line = nook_overlay_letter_height(overlay);
    draw_cross(overlay, middle[0], middle[1], *view.looked_at || *view.carried);
    draw_hint(overlay, &view, middle[0], middle[1] + 3.0 * line);
    draw_state(window, overlay, &view);
    if (*view.message)
        label_lines(overlay, middle[0], window->height - 4.5 * line, view.status == NOOK_SESSION_PLAYING ? white : gold,
                    view.message);
    if (view.status != NOOK_SESSION_PLAYING)
        label_around(overlay, middle[0], window->height - 6.5 * line, white, "Backspace: from the start again");
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
    } else {
        changed =
            nook_overlay_slider(overlay, label, &value, param->lowest, param->highest, nook_unit_name(param->unit));
    }
    nook_overlay_tooltip(overlay, param->help);
    if (changed)
        nook_param_set(param, "preferences", &window->preferences, value);
}

void nook_play_draw_menu(nook_play_window *window, nook_overlay *overlay)
{
    double letter = nook_overlay_letter_height(overlay), width = 26.0;
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
        if (nook_overlay_button(overlay, "From the start"))
            window->restart = true;
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

void nook_play_draw_help(nook_overlay *overlay)
{
    static const char *const lines[][3] = {
        { "W A S D, arrows", "walk", "left stick" },
        { "mouse", "look", "right stick" },
        { "Shift", "run", "left trigger" },
        { "Space", "jump", "A" },
        { "Ctrl, C", "crouch", "B" },
        { "E, left click", "take, let go", "X" },
        { "Q, right click", "throw", "right trigger" },
        { "R, held", "turn it", "right bumper" },
        { "Backspace", "from the start", "Back" },
        { "Esc", "pause", "Start; cross, A" },
        { "F11", "full screen", "" },
    };
    const nook_overlay_panel panel = { .title = "Playing##help", .x = 10.0, .y = -10.0, .passive = true };
    if (nook_overlay_panel_begin(overlay, &panel)) {
        for (size_t i = 0; i < NOOK_COUNT(lines); i++) {
            nook_overlay_text_coloured(overlay, gold, lines[i][0]);
            nook_overlay_same_line_at(overlay, 8.5);
            nook_overlay_text(overlay, lines[i][1]);
            nook_overlay_same_line_at(overlay, 15.5);
            nook_overlay_text_coloured(overlay, soft, lines[i][2]);
        }
    }
    nook_overlay_panel_end(overlay);
}
