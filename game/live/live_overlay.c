/* What lies over the picture beside panels and names: borders, messages, help, notes. */
#include "engine/core/clock.h"
#include "game/live/live_internal.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const nook_overlay_colour white = { 255, 255, 255, 255 }, grey = { 190, 190, 190, 255 };
static const nook_overlay_colour red = { 255, 110, 100, 255 }, accent = { 255, 180, 60, 255 };
static const nook_overlay_colour border_colour = { 20, 20, 20, 255 };
static const double note_ms = 4000.0;
static const double message_width = 42.0, help_column = 5.0, both_panels = 54.0; /* letters' heights */
static const double panels_and_help = 72.0; /* the same: with a list of the host's */
static const double list_height = 16.0,
                    lists_height = 36.0; /* the same: of our list of keys, of both above each other */
static const double margin = 8.0;        /* pixels at scale 1: of what lies in a corner */

void live_note(nook_live *live, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(live->note, sizeof live->note, format, arguments);
    va_end(arguments);
    live->note_ms = nook_clock_ms();
}

void live_overlay_begin(nook_live *live)
{
    if (live->overlay_begun)
        return;
    const nook_overlay_frame frame = { .width = live_shown_width(live),
                                       .height = live_shown_height(live),
                                       .scale = live->scale,
                                       .seconds = live->seconds,
                                       .input = live->pointer ? &live->input : NULL };
    live->taken = nook_overlay_begin(live->overlay, &frame);
    live->letter = nook_overlay_letter_height(live->overlay);
    live->overlay_begun = true;
    live->borders_shown = false;
}

/* ---- Borders ------------------------------------------------------------------------------------------------------ */

void live_borders_show(nook_live *live)
{
    const double width = live_shown_width(live), height = live_shown_height(live);
    if (live->borders_shown)
        return;
    live->borders_shown = true;
    nook_live_border borders[NOOK_LIVE_SPLITS_MAX];
    uint32_t count = nook_live_views_borders(&live->views, borders);
    for (uint32_t i = 0; i < count; i++) {
        const nook_live_border *b = &borders[i];
        bool lit = live->hovered == i;
        const double upright[2][2] = { { b->at * width, b->from * height }, { b->at * width, b->to * height } };
        const double level[2][2] = { { b->from * width, b->at * height }, { b->to * width, b->at * height } };
        const double(*line)[2] = b->upright ? upright : level;
        nook_overlay_line(live->overlay, line[0], line[1], lit ? accent : border_colour,
                          (lit ? 4.0 : 2.0) * live->scale);
    }
}

/* ---- Texts -------------------------------------------------------------------------------------------------------- */

static bool has_messages(const nook_live *live)
{
    for (uint32_t i = 0; i < NOOK_LIVE_MESSAGES_MAX; i++) {
        if (live->messages[i].text[0])
            return true;
    }
    return false;
}

static void show_messages(nook_live *live, double width)
{
    const double letter = nook_overlay_letter_height(live->overlay), side = margin * live->scale;
    const double names = nook_live_names_bottom(live, width);
    const nook_overlay_panel panel = { .title = "##messages",
                                       .x = width > 2.0 * message_width * letter ? 0.25 * width : -side,
                                       .y = fmax(28.0 * live->scale, names + 0.5 * side),
                                       .bare = true,
                                       .passive = true };
    nook_overlay_panel_begin(live->overlay, &panel);
    for (uint32_t i = 0; i < NOOK_LIVE_MESSAGES_MAX; i++) {
        const live_message *message = &live->messages[i];
        if (!message->text[0])
            continue;
        nook_overlay_text_coloured(live->overlay, red, message->from);
        nook_overlay_text_wrapped(live->overlay, fmin(message_width, (width - 4.0 * side) / letter), message->text);
    }
    nook_overlay_panel_end(live->overlay);
}

/* Whether there is room for the host's list of keys and that of the views. */
static bool has_both_lists(const nook_live *live)
{
    return live_shown_width(live) >= NOOK_LIVE_HELP_BESIDE * live->letter ||
           live_shown_height(live) >= lists_height * live->letter;
}

void live_help_turn(nook_live *live)
{
    const uint32_t pages = has_both_lists(live) ? 1 : 2;
    live->help_page = live->help_page >= pages ? 0 : live->help_page + 1;
}

nook_live_help nook_live_help_shown(const nook_live *live)
{
    if (live->help_page == 0)
        return NOOK_LIVE_HELP_NONE;
    if (has_both_lists(live))
        return NOOK_LIVE_HELP_BOTH;
    return live->help_page == 1 ? NOOK_LIVE_HELP_HOST : NOOK_LIVE_HELP_VIEWS;
}

double nook_live_help_bottom(const nook_live *live)
{
    bool above = nook_live_help_shown(live) == NOOK_LIVE_HELP_BOTH &&
                 live_shown_width(live) < NOOK_LIVE_HELP_BESIDE * live->letter;
    return margin * live->scale + (above ? list_height * live->letter : 0.0);
}

/* Whether panels are seen: help lies over them where there is no room beside them, and they wait. */
static bool has_panels(const nook_live *live)
{
    const double letter = nook_overlay_letter_height(live->overlay);
    return live->panels && !(live->help_page > 0 && live_shown_width(live) < panels_and_help * letter);
}

static void show_help(nook_live *live)
{
    const double side = margin * live->scale, letter = nook_overlay_letter_height(live->overlay);
    const double right = has_panels(live) ? 2.0 * side + LIVE_PANEL_WIDTH * letter : side;
    const nook_overlay_panel panel = { .title = "##help", .x = -right, .y = -side, .bare = true, .passive = true };
    size_t count;
    const nook_live_key *keys = nook_live_keys(&count);
    nook_overlay_panel_begin(live->overlay, &panel);
    for (size_t i = 0; i < count; i++) {
        nook_overlay_text_coloured(live->overlay, accent, keys[i].key);
        nook_overlay_same_line_at(live->overlay, help_column);
        nook_overlay_text(live->overlay, keys[i].what);
    }
    nook_overlay_panel_end(live->overlay);
}

/* Lines that end that far down, no wider than the window. @return where they begin */
static double show_lines(nook_live *live, double bottom, nook_overlay_colour colour, const char *text)
{
    const double side = margin * live->scale, room = live_shown_width(live) - 2.0 * side;
    double size[2], top = bottom;
    char line[LIVE_NOTE_SIZE];
    nook_overlay_label_size(live->overlay, text, size);
    for (const char *at = text; *at; at += strspn(at, " "), top -= size[1])
        at += nook_overlay_line_length(live->overlay, at, room);
    for (double y = top; *text; text += strspn(text, " "), y += size[1]) {
        size_t length = nook_overlay_line_length(live->overlay, text, room);
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        nook_overlay_label(live->overlay, (double[]){ side, y }, colour, line);
        text += length;
    }
    return top;
}

/* "frozen (T): truth by 248 rays, noise 0.0031" */
static void show_frozen(nook_live *live, double bottom)
{
    char text[128];
    const char *frozen = live->freeze ? "frozen (T): " : "";
    if (live->truth.rays > 0)
        snprintf(text, sizeof text, "%struth by %u rays, noise %.4f", frozen, live->truth.rays, live->truth.noise);
    else
        snprintf(text, sizeof text, "%s%s", frozen,
                 live->truth.started ? "the first rays are on their way" : "no truth");
    show_lines(live, bottom, white, text);
}

static bool has_note(const nook_live *live)
{
    return live->note[0] && nook_clock_ms() - live->note_ms < note_ms;
}

/* What decides how it looks, beside panels. */
static live_seen seen_now(const nook_live *live)
{
    live_seen now;
    memset(&now, 0, sizeof now);
    now.help_page = live->help_page;
    now.note_ms = has_note(live) ? live->note_ms : 0.0;
    now.hovered = live->hovered;
    now.active = live->views.active;
    now.messages = live->message_count;
    for (int i = 0; i < 2 && live->truth.started; i++)
        now.mouse[i] = live->mouse[i]; /* the probe follows it */
    return now;
}

bool live_overlay_moves(const nook_live *live)
{
    live_seen now = seen_now(live);
    return live->panels || live->overlay_begun || memcmp(&now, &live->seen, sizeof now) != 0;
}

/* What was done last, and above it what is frozen. */
static void show_bottom(nook_live *live, bool truth)
{
    double size[2], bottom = live_shown_height(live) - margin * live->scale;
    nook_overlay_label_size(live->overlay, "", size);
    double top = bottom - size[1]; /* room for one line, so that it does not jump */
    if (has_note(live))
        top = show_lines(live, bottom, grey, live->note);
    if (truth)
        show_frozen(live, top - 0.2 * size[1]);
}

static void show_panels(nook_live *live, double width)
{
    bool narrow = width < both_panels * nook_overlay_letter_height(live->overlay);
    live_panel_views(live, narrow);
    if (!narrow)
        live_panel_times(live);
}

void live_overlay_build(nook_live *live)
{
    bool truth = live->freeze || live->truth.started;
    bool views = live_names_shown(live);
    live->times_shown = false;
    live->seen = seen_now(live);
    if (!(views || live->help_page > 0 || has_messages(live) || has_note(live) || live->overlay_used)) {
        if (live->overlay_begun)
            nook_overlay_end(live->overlay);
        live->overlay_begun = false;
        return;
    }
    live_overlay_begin(live);
    live->overlay_used = true;
    double width = live_shown_width(live);
    live_borders_show(live);
    if (views)
        live_names_show(live);
    show_bottom(live, truth);
    if (has_panels(live))
        show_panels(live, width);
    live_probe(live);
    nook_live_help help = nook_live_help_shown(live);
    if (help == NOOK_LIVE_HELP_VIEWS || help == NOOK_LIVE_HELP_BOTH)
        show_help(live);
    if (has_messages(live))
        show_messages(live, width);
    nook_overlay_end(live->overlay);
    live->overlay_begun = false;
}
