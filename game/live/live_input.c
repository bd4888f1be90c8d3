/* Keys and mouse: what the panels take, then the borders, then the keys of the views; the host gets the rest. */
#include "engine/core/clock.h"
#include "game/live/live_internal.h"
#include "modules/ao/technique.h"
#include <string.h>

static const double border_reach = 6.0; /* pixels at scale 1, to either side */

static const nook_live_key help[] = {
    { "F1", "this list" },
    { "F2", "panels: parameters, times, memory" },
    { "1 - 9", "technique of the active view; 0: none" },
    { "M", "what it shows; Shift: back" },
    { "+ -", "more views, fewer" },
    { "L", "three: columns, or one beside two" },
    { "Tab", "the next view; Shift: back" },
    { "T", "freezes the camera, traces the truth" },
    { "F12", "a picture, and a text of what made it" },
    { "Ctrl Z, Y", "takes changes back, does them again" },
    { "mouse", "drags borders; tells of a frozen pixel" },
};

const nook_live_key *nook_live_keys(size_t *out_count)
{
    *out_count = NOOK_COUNT(help);
    return help;
}

/* ---- Keys --------------------------------------------------------------------------------------------------------- */

/* The key is ours: it is used up. */
static bool take(nook_input *rest, nook_key key)
{
    bool pressed = rest->pressed[key];
    rest->pressed[key] = rest->down[key] = false;
    return pressed;
}

static uint32_t turn(uint32_t value, uint32_t count, bool back)
{
    return (value + (back ? count - 1 : 1)) % count;
}

static void choose_by_number(nook_live *live, nook_input *rest)
{
    for (int digit = 0; digit <= 9; digit++) {
        if (!take(rest, (nook_key)(NOOK_KEY_0 + digit)))
            continue;
        if (digit > 0)
            live_choose_technique(live, (uint32_t)digit - 1);
        else
            live->views.views[live->views.active].open = true;
    }
}

static void change_views(nook_live *live, nook_input *rest, bool back)
{
    nook_live_views *views = &live->views;
    nook_live_view *active = &views->views[views->active];
    if (take(rest, NOOK_KEY_M))
        active->mode = turn(active->mode, nook_live_mode_count(), back);
    if (take(rest, NOOK_KEY_PLUS) && views->count < NOOK_LIVE_VIEWS_MAX)
        nook_live_views_set_count(views, views->count + 1);
    if (take(rest, NOOK_KEY_MINUS) && views->count > 1)
        nook_live_views_set_count(views, views->count - 1);
    if (take(rest, NOOK_KEY_L))
        nook_live_views_turn(views);
    if (take(rest, NOOK_KEY_TAB))
        views->active = turn(views->active, views->count, back);
}

static void undo_and_redo(nook_live *live, nook_input *rest)
{
    if (!nook_input_held(rest, NOOK_KEY_CONTROL))
        return;
    uint32_t active = live->views.active;
    bool done = (take(rest, NOOK_KEY_Z) && nook_live_history_undo(&live->history, &live->views)) ||
                (take(rest, NOOK_KEY_Y) && nook_live_history_redo(&live->history, &live->views));
    if (done && active < live->views.count)
        live->views.active = active; /* where one looks is no change to take back */
}

static void use_keys(nook_live *live, nook_input *rest)
{
    bool back = nook_input_held(rest, NOOK_KEY_SHIFT);
    undo_and_redo(live, rest);
    choose_by_number(live, rest);
    change_views(live, rest, back);
    if (take(rest, NOOK_KEY_F1))
        live_help_turn(live);
    if (take(rest, NOOK_KEY_F2))
        live->panels = !live->panels;
    if (take(rest, NOOK_KEY_T))
        live->freeze = !live->freeze;
    if (take(rest, NOOK_KEY_F12))
        live->picture_asked = true;
}

/* ---- Mouse -------------------------------------------------------------------------------------------------------- */

static void take_mouse(nook_input *rest)
{
    memset(rest->mouse_down, 0, sizeof rest->mouse_down);
    memset(rest->mouse_pressed, 0, sizeof rest->mouse_pressed);
    rest->mouse_dx = rest->mouse_dy = rest->scroll = 0.0;
}

static void use_borders(nook_live *live, nook_input *rest)
{
    const double reach[2] = { border_reach * live->scale / live->width, border_reach * live->scale / live->height };
    if (!rest->mouse_down[0] && !rest->mouse_pressed[0])
        live->held = NOOK_LIVE_SPLITS_MAX;
    live->hovered = live->held < NOOK_LIVE_SPLITS_MAX
                        ? live->held
                        : nook_live_views_border_at(&live->views, live->mouse[0], live->mouse[1], reach);
    if (live->hovered < NOOK_LIVE_SPLITS_MAX && rest->mouse_pressed[0])
        live->held = live->hovered;
    if (live->held == NOOK_LIVE_SPLITS_MAX)
        return;
    nook_live_views_drag(&live->views, live->held, live->mouse[0], live->mouse[1]);
    take_mouse(rest);
}

static void use_mouse(nook_live *live, nook_input *rest)
{
    bool moved = rest->mouse_dx != 0.0 || rest->mouse_dy != 0.0 || rest->mouse_pressed[0];
    live->mouse[0] = rest->mouse_x / live->width;
    live->mouse[1] = rest->mouse_y / live->height;
    use_borders(live, rest);
    if (moved && live->held == NOOK_LIVE_SPLITS_MAX)
        live->views.active = nook_live_views_at(&live->views, live->mouse[0], live->mouse[1]);
}

/* ---- A frame ------------------------------------------------------------------------------------------------------ */

static void use_overlay(nook_live *live, nook_input *rest)
{
    live_overlay_begin(live);
    if (live->taken.mouse && live->held == NOOK_LIVE_SPLITS_MAX) {
        take_mouse(rest);
        live->hovered = NOOK_LIVE_SPLITS_MAX;
    }
    if (live->taken.keys) {
        memset(rest->down, 0, sizeof rest->down);
        memset(rest->pressed, 0, sizeof rest->pressed);
        memset(rest->typed, 0, sizeof rest->typed);
    }
}

void nook_live_input(nook_live *live, const nook_input *input, bool pointer, nook_input *out_rest)
{
    nook_input rest = *input;
    live->input = *input;
    live->seconds = live->input_ms > 0.0 ? (nook_clock_ms() - live->input_ms) / 1000.0 : 1.0 / 60.0;
    live->input_ms = nook_clock_ms();
    live->pointer = pointer;
    bool shown = live->panels || live->overlay_used; /* in the last frame: something may be pointed at */
    live->overlay_begun = live->overlay_used = false;
    live->taken = (nook_overlay_taken){ 0 };
    if (input->width > 0 && input->height > 0) {
        live->width = input->width, live->height = input->height;
        live->scale = input->content_scale > 0.0 ? input->content_scale : 1.0;
    }
    if (shown && pointer && live->width > 0)
        use_overlay(live, &rest);
    if (!live->taken.keys)
        use_keys(live, &rest);
    live->hovered = NOOK_LIVE_SPLITS_MAX;
    if (pointer && live->width > 0 && (!live->taken.mouse || live->held < NOOK_LIVE_SPLITS_MAX))
        use_mouse(live, &rest);
    else if (!rest.mouse_down[0])
        live->held = NOOK_LIVE_SPLITS_MAX;
    *out_rest = rest;
}
