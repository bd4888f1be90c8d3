#include "game/live/live.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/live/live_internal.h"
#include "modules/ao/technique.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void copy_text(char *out, size_t capacity, const char *text, const char *otherwise)
{
    snprintf(out, capacity, "%s", text ? text : otherwise);
}

static void set_up(nook_live *live, const nook_live_desc *desc)
{
    live->stage = desc->stage;
    live->shaders_reload = desc->shaders_reload;
    live->hovered = live->held = NOOK_LIVE_SPLITS_MAX;
    live->scale = 1.0;
    live->multiplies = nook_game_world_multiplies(desc->stage->ao);
    copy_text(live->settings_path, sizeof live->settings_path, desc->settings_path, "nook.settings");
    copy_text(live->pictures, sizeof live->pictures, desc->pictures, ".");
    copy_text(live->notes, sizeof live->notes, desc->notes, "");
    nook_live_views_reset(&live->views, "");
    live_list_techniques(live, desc->techniques, desc->technique_count);
    live_take_over(live);
    memcpy(live->views.views[0].setting, live->remembered[0], sizeof live->remembered[0]);
    if (desc->setting)
        live_set_setting(live, 0, desc->setting);
    live->first = live->views;
    nook_live_history_push(&live->history, &live->views);
}

nook_result nook_live_create(const nook_live_desc *desc, nook_live **out_live)
{
    *out_live = NULL;
    nook_live *live = calloc(1, sizeof *live);
    if (!live)
        return nook_fail(NOOK_E_MEMORY, "live views: no memory");
    set_up(live, desc);
    nook_result result = live_targets_create(live);
    if (result == NOOK_OK)
        result = nook_overlay_create(desc->stage->gpu, &live->overlay);
    if (result != NOOK_OK) {
        nook_live_destroy(live);
        return result;
    }
    *out_live = live;
    return NOOK_OK;
}

void nook_live_destroy(nook_live *live)
{
    if (!live)
        return;
    nook_overlay_destroy(live->overlay);
    nook_live_capture_end(live);
    live_truth_release(live);
    live_times_release(live);
    live_targets_destroy(live);
    free(live);
}

nook_live_views *nook_live_state(nook_live *live)
{
    return &live->views;
}

bool nook_live_wants_pointer(const nook_live *live)
{
    return live->panels || live->freeze;
}

void nook_live_freeze(nook_live *live, bool frozen)
{
    live->freeze = frozen;
}

bool nook_live_frozen(const nook_live *live)
{
    return live->freeze;
}

void nook_live_hold(nook_live *live, bool held)
{
    live->hold = held;
}

void nook_live_set_coarse(nook_live *live, bool coarse)
{
    live->stale = live->stale || live->coarse != coarse;
    live->coarse = coarse;
}

void nook_live_set_timing(nook_live *live, bool timing)
{
    live->timing = timing;
}

double nook_live_ao_ms(const nook_live *live)
{
    return live->times.ms[LIVE_PASS_AO + live->views.active];
}

const char *nook_live_active_setting(const nook_live *live)
{
    const nook_live_view *view = &live->views.views[live->views.active];
    return view->open ? "none" : view->setting;
}

uint32_t nook_live_active_technique(const nook_live *live)
{
    const nook_live_view *view = &live->views.views[live->views.active];
    uint32_t number = view->open ? LIVE_TECHNIQUES : live_technique_number(live, view->setting);
    return number < LIVE_TECHNIQUES ? number + 1 : 0;
}

void nook_live_redraw(nook_live *live)
{
    live->stale = true;
}

void nook_live_suspend(nook_live *live)
{
    live_truth_stop(live);
    live->frozen = false;
    live->stale = true;
}

uint32_t live_shown_width(const nook_live *live)
{
    return live->width ? live->width : live->stage->width;
}

uint32_t live_shown_height(const nook_live *live)
{
    return live->height ? live->height : live->stage->height;
}

nook_overlay *nook_live_overlay(nook_live *live)
{
    live_overlay_begin(live);
    live_borders_show(live); /* below what the host puts there */
    live->overlay_used = true;
    return live->overlay;
}

void nook_live_message(nook_live *live, const char *from, const char *text)
{
    live_message *place = NULL;
    for (uint32_t i = NOOK_LIVE_MESSAGES_MAX; i-- > 0;) {
        live_message *message = &live->messages[i];
        if (strcmp(message->from, from) == 0) {
            place = message;
            break;
        }
        if (message->text[0] == '\0')
            place = message;
    }
    if (!place || (strcmp(place->text, text) == 0 && strcmp(place->from, from) == 0))
        return;
    live->message_count++;
    snprintf(place->from, sizeof place->from, "%s", from);
    snprintf(place->text, sizeof place->text, "%s", text);
}
