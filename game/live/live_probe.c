/* What a pixel of a frozen frame is made of, beside the mouse. */
#include "game/live/live_internal.h"
#include <stdio.h>
#include <string.h>

static const double value_column = 6.0, name_column = 3.8; /* letters' heights */
static const double least_share = 0.005;                   /* of what is hidden: less is 0 % */

/* The pixel under the mouse. @return false: there is none */
static bool pixel_of_mouse(const nook_live *live, uint32_t out[2])
{
    if (!live->pointer || live->taken.mouse || live->hovered < NOOK_LIVE_SPLITS_MAX)
        return false;
    double x = live->mouse[0] * live->stage->width, y = (1.0 - live->mouse[1]) * live->stage->height;
    if (!(x >= 0.0 && x < live->stage->width && y > 0.0 && y <= live->stage->height))
        return false;
    out[0] = (uint32_t)x;
    out[1] = y < 1.0 ? 0 : (uint32_t)(y < live->stage->height ? y : live->stage->height - 1.0);
    return true;
}

static void row(nook_live *live, const char *name, const char *text)
{
    nook_overlay_text(live->overlay, name);
    nook_overlay_same_line_at(live->overlay, value_column);
    nook_overlay_text(live->overlay, text);
}

static void show_values(nook_live *live, const uint32_t pixel[2])
{
    const live_truth *t = &live->truth;
    uint32_t width, height, view = nook_live_views_at(&live->views, live->mouse[0], live->mouse[1]);
    size_t at = (size_t)pixel[1] * t->texture.width + pixel[0];
    char text[96];
    snprintf(text, sizeof text, "%.3f m", (double)nook_refine_depth(t->refine, &width, &height)[at]);
    row(live, "distance", text);
    snprintf(text, sizeof text, "%.3f by %u rays", t->probe.visibility, t->probe.rays);
    row(live, "truth", text);
    if (t->errors[view].pixels == 0)
        return;
    snprintf(text, sizeof text, "%.3f, error %+.3f", (double)t->visibility[at],
             (double)t->visibility[at] - t->probe.visibility);
    row(live, "estimate", text);
}

static void show_shares(nook_live *live)
{
    const nook_refine_probe_result *probe = &live->truth.probe;
    uint32_t count;
    const nook_ao_occluder *occluders = nook_game_world_occluders(live->stage->world, &count);
    double hidden = 1.0 - probe->visibility;
    for (uint32_t i = 0; i < probe->count && probe->shares[i] >= least_share * hidden; i++) {
        char name[96], text[32];
        const nook_ao_occluder *o = probe->occluders[i] < count ? &occluders[probe->occluders[i]] : NULL;
        snprintf(name, sizeof name, "%s", o ? live_body_name(live, o->volume, o->mesh) : "?");
        snprintf(text, sizeof text, "%.0f %%", 100.0 * probe->shares[i] / hidden);
        nook_overlay_text(live->overlay, text);
        nook_overlay_same_line_at(live->overlay, name_column);
        nook_overlay_text(live->overlay, name);
    }
}

/* Beside the mouse, on the side where there is room. */
static nook_overlay_panel panel_at(const nook_live *live)
{
    double gap = 16.0 * live->scale, x = live->mouse[0] * live->width, y = live->mouse[1] * live->height;
    return (nook_overlay_panel){ .title = "##probe",
                                 .x = live->mouse[0] < 0.5 ? x + gap : x - gap - live->width,
                                 .y = live->mouse[1] < 0.5 ? y + gap : y - gap - live->height,
                                 .bare = true,
                                 .passive = true };
}

void live_probe(nook_live *live)
{
    live_truth *t = &live->truth;
    uint32_t pixel[2];
    if (!t->started || !pixel_of_mouse(live, pixel))
        return;
    if (!t->probed || pixel[0] != t->pixel[0] || pixel[1] != t->pixel[1])
        t->probed = nook_refine_probe(t->refine, pixel[0], pixel[1], &t->probe);
    memcpy(t->pixel, pixel, sizeof t->pixel);
    if (!t->probed)
        return;
    const nook_overlay_panel panel = panel_at(live);
    nook_overlay_panel_begin(live->overlay, &panel);
    show_values(live, pixel);
    show_shares(live);
    nook_overlay_panel_end(live->overlay);
}
