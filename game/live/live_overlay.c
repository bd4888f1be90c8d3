/* What lies over the picture beside the panels: borders, names of the views, messages, help. */
#include "engine/core/clock.h"
#include "game/live/live_internal.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const nook_overlay_colour white = { 255, 255, 255, 255 }, grey = { 190, 190, 190, 255 };
static const nook_overlay_colour red = { 255, 110, 100, 255 }, accent = { 255, 180, 60, 255 };
static const nook_overlay_colour border_colour = { 20, 20, 20, 255 };
static const double note_ms = 4000.0;
static const double message_width = 42.0, help_column = 5.0, both_panels = 54.0; /* letters' heights */

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
    const nook_overlay_frame frame = { .width = live->width ? live->width : live->stage->width,
                                       .height = live->height ? live->height : live->stage->height,
                                       .scale = live->scale,
                                       .seconds = live->seconds,
                                       .input = live->pointer ? &live->input : NULL };
    live->taken = nook_overlay_begin(live->overlay, &frame);
    live->overlay_begun = true;
}

/* ---- Borders and names -------------------------------------------------------------------------------------------- */

static void show_borders(nook_live *live, double width, double height)
{
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

/* "volume, error: RMSE 0.0213, bias +0.0040" */
static void describe_view(const nook_live *live, uint32_t view, char *out, size_t capacity)
{
    const nook_live_view *v = &live->views.views[view];
    const live_error *error = &live->truth.errors[view];
    const char *mode = nook_live_mode_name(v->mode), *technique = v->open ? "none" : v->setting;
    if (!nook_live_mode_occludes(v->mode)) {
        snprintf(out, capacity, "%s", mode);
        return;
    }
    int used = snprintf(out, capacity, "%.*s, %s", (int)strcspn(technique, " "), technique, mode);
    if (error->pixels > 0 && used > 0 && (size_t)used < capacity)
        snprintf(out + used, capacity - (size_t)used, ": RMSE %.4f, bias %+.4f", error->rmse, error->bias);
}

static void show_names(nook_live *live, double width, double height)
{
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_rectangle *place = &live->places[i];
        char text[128];
        double size[2], right = (place->x + place->width) * width / live->stage->width;
        double top = (live->stage->height - place->y - place->height) * height / live->stage->height;
        describe_view(live, i, text, sizeof text);
        nook_overlay_label_size(live->overlay, text, size);
        const double at[2] = { right - size[0] - 4.0 * live->scale,
                               top + 4.0 * live->scale }; /* games write at the left */
        bool active = i == live->views.active && live->views.count > 1;
        nook_overlay_label(live->overlay, at, active ? accent : white, text);
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
    const double letter = nook_overlay_letter_height(live->overlay);
    const nook_overlay_panel panel = { .title = "##messages",
                                       .x = width > 2.0 * message_width * letter ? 0.25 * width : 8.0 * live->scale,
                                       .y = 28.0 * live->scale, /* below the views' names */
                                       .bare = true,
                                       .passive = true };
    nook_overlay_panel_begin(live->overlay, &panel);
    for (uint32_t i = 0; i < NOOK_LIVE_MESSAGES_MAX; i++) {
        const live_message *message = &live->messages[i];
        if (!message->text[0])
            continue;
        nook_overlay_text_coloured(live->overlay, red, message->from);
        nook_overlay_text_wrapped(live->overlay, message_width, message->text);
    }
    nook_overlay_panel_end(live->overlay);
}

static void show_help(nook_live *live)
{
    const nook_overlay_panel panel = {
        .title = "##help", .x = -8.0 * live->scale, .y = -8.0 * live->scale, .bare = true, .passive = true
    };
    size_t count;
    const nook_live_key *keys = nook_live_help(&count);
    nook_overlay_panel_begin(live->overlay, &panel);
    for (size_t i = 0; i < count; i++) {
        nook_overlay_text_coloured(live->overlay, accent, keys[i].key);
        nook_overlay_same_line_at(live->overlay, help_column);
        nook_overlay_text(live->overlay, keys[i].what);
    }
    nook_overlay_panel_end(live->overlay);
}

/* "frozen (T): truth by 248 rays, noise 0.0031" */
static void show_frozen(nook_live *live, double height)
{
    char text[128];
    double size[2];
    const char *frozen = live->freeze ? "frozen (T): " : "";
    if (live->truth.rays > 0)
        snprintf(text, sizeof text, "%struth by %u rays, noise %.4f", frozen, live->truth.rays, live->truth.noise);
    else
        snprintf(text, sizeof text, "%s%s", frozen,
                 live->truth.started ? "the first rays are on their way" : "no truth");
    nook_overlay_label_size(live->overlay, text, size);
    const double at[2] = { 8.0 * live->scale, height - 2.2 * size[1] - 8.0 * live->scale };
    nook_overlay_label(live->overlay, at, white, text);
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
    now.help = live->help;
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

static void show_note(nook_live *live, double height)
{
    double size[2];
    nook_overlay_label_size(live->overlay, live->note, size);
    const double at[2] = { 8.0 * live->scale, height - size[1] - 8.0 * live->scale };
    nook_overlay_label(live->overlay, at, grey, live->note);
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
    bool views = live->views.count > 1 || live->panels || truth || live->views.views[0].mode != NOOK_LIVE_LIT;
    live->times_shown = false;
    live->seen = seen_now(live);
    if (!(views || live->help || has_messages(live) || has_note(live) || live->overlay_used)) {
        if (live->overlay_begun)
            nook_overlay_end(live->overlay);
        live->overlay_begun = false;
        return;
    }
    live_overlay_begin(live);
    live->overlay_used = true;
    double width = live->width ? live->width : live->stage->width;
    double height = live->height ? live->height : live->stage->height;
    nook_live_views_place(&live->views, live->stage->width, live->stage->height, live->places);
    if (views) {
        show_borders(live, width, height);
        show_names(live, width, height);
    }
    if (truth)
        show_frozen(live, height);
    if (has_note(live))
        show_note(live, height);
    if (live->panels)
        show_panels(live, width);
    live_probe(live);
    if (live->help)
        show_help(live);
    if (has_messages(live))
        show_messages(live, width);
    nook_overlay_end(live->overlay);
    live->overlay_begun = false;
}
