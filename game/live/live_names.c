/* What stands over each view: its technique, what it shows, and how far off it is. At its top right, as games write at the left. */
#include "game/live/live_internal.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_LINES = 4, NAME_SIZE = 128 };

static const nook_overlay_colour white = { 255, 255, 255, 255 }, accent = { 255, 180, 60, 255 };
static const double gap = 4.0; /* pixels at scale 1: to the edges of the view */

typedef struct name_lines {
    char text[NAME_LINES][NAME_SIZE];
    uint32_t count;
} name_lines;

/* ---- Words -------------------------------------------------------------------------------------------------------- */

/* Behind what stands in the last line, when there is room for it there, else below. */
static void append(nook_overlay *overlay, name_lines *lines, double width, const char *part)
{
    char joined[2 * NAME_SIZE];
    double size[2] = { INFINITY, 0.0 };
    if (lines->count > 0) {
        snprintf(joined, sizeof joined, "%s %s", lines->text[lines->count - 1], part);
        nook_overlay_label_size(overlay, joined, size);
    }
    if (size[0] <= width)
        snprintf(lines->text[lines->count - 1], NAME_SIZE, "%.*s", NAME_SIZE - 1, joined);
    else
        snprintf(lines->text[lines->count++], NAME_SIZE, "%s", part);
}

/* "volume, error: RMSE 0.0213, bias +0.0040", in as few lines as the width allows. */
static name_lines describe(nook_live *live, uint32_t view, double width)
{
    const nook_live_view *v = &live->views.views[view];
    const live_error *error = &live->truth.errors[view];
    const char *technique = v->open ? "none" : v->setting;
    bool occludes = nook_live_mode_occludes(v->mode), known = occludes && error->pixels > 0;
    name_lines lines = { .count = 0 };
    char part[NAME_SIZE];
    if (occludes) {
        snprintf(part, sizeof part, "%.*s,", (int)strcspn(technique, " "), technique);
        append(live->overlay, &lines, width, part);
    }
    snprintf(part, sizeof part, "%s%s", nook_live_mode_name(v->mode), known ? ":" : "");
    append(live->overlay, &lines, width, part);
    if (!known)
        return lines;
    snprintf(part, sizeof part, "RMSE %.4f,", error->rmse);
    append(live->overlay, &lines, width, part);
    snprintf(part, sizeof part, "bias %+.4f", error->bias);
    append(live->overlay, &lines, width, part);
    return lines;
}

/* ---- Places ------------------------------------------------------------------------------------------------------- */

bool live_names_shown(const nook_live *live)
{
    return live->views.count > 1 || live->panels || live->freeze || live->truth.started ||
           live->views.views[0].mode != NOOK_LIVE_LIT;
}

/* Pixels of the window per pixel of the picture. */
static void get_stretch(const nook_live *live, double out[2])
{
    out[0] = live->width ? (double)live->width / live->stage->width : 1.0;
    out[1] = live->height ? (double)live->height / live->stage->height : 1.0;
}

/* Calls for each line of each name. */
static void visit(nook_live *live,
                  void (*line)(nook_live *live, void *user, uint32_t view, const char *text, const double place[4]),
                  void *user)
{
    double stretch[2];
    get_stretch(live, stretch);
    nook_live_views_place(&live->views, live->stage->width, live->stage->height, live->places);
    for (uint32_t i = 0; i < live->views.count; i++) {
        const nook_rectangle *view = &live->places[i];
        const double room = view->width * stretch[0] - 2.0 * gap * live->scale;
        const double right = (view->x + view->width) * stretch[0] - gap * live->scale;
        double y = (live->stage->height - view->y - view->height) * stretch[1] + gap * live->scale;
        const name_lines lines = describe(live, i, room);
        for (uint32_t k = 0; k < lines.count; k++) {
            double size[2];
            nook_overlay_label_size(live->overlay, lines.text[k], size);
            line(live, user, i, lines.text[k], (double[]){ right - size[0], y, size[0], size[1] });
            y += size[1];
        }
    }
}

static void draw_line(nook_live *live, void *user, uint32_t view, const char *text, const double place[4])
{
    (void)user;
    bool active = view == live->views.active && live->views.count > 1;
    nook_overlay_label(live->overlay, place, active ? accent : white, text);
}

void live_names_show(nook_live *live)
{
    visit(live, draw_line, NULL);
}

/* How far down names reach into the top left corner. */
typedef struct corner {
    double width, bottom;
} corner;

static void reach_into(nook_live *live, void *user, uint32_t view, const char *text, const double place[4])
{
    (void)text;
    corner *c = user;
    const nook_rectangle *v = &live->places[view];
    if (v->y + v->height == live->stage->height && place[0] < c->width)
        c->bottom = fmax(c->bottom, place[1] + place[3]);
}

double nook_live_names_bottom(nook_live *live, double width)
{
    corner c = { width, 0.0 };
    if (live_names_shown(live))
        visit(live, reach_into, &c);
    return c.bottom;
}
