#include "game/live/live_views.h"
#include "engine/render/renderer.h"
#include "modules/measure/colour_map.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double nearest = 0.05;        /* of the picture: what is left of a view when a border is pushed */
static const double counts_at_first = 8.0; /* occluders: a crowded place of the hall */
static const double fetches_at_first = 400.0, steps_at_first = 300.0;

static const char *const mode_names[NOOK_LIVE_BUFFERS] = { "lit",   "visibility", "error",  "occluders", "fetches",
                                                           "steps", "divergence", "slices", "voxels" };

/* ---- Modes ------------------------------------------------------------------------------------------------------ */

uint32_t nook_live_mode_count(void)
{
    return NOOK_LIVE_BUFFERS + NOOK_VIEW_COUNT - 2; /* lit and visibility stand at the front */
}

int nook_live_mode_buffer(uint32_t mode)
{
    assert(mode < nook_live_mode_count());
    if (mode == NOOK_LIVE_LIT)
        return NOOK_VIEW_LIT;
    if (mode < NOOK_LIVE_BUFFERS)
        return NOOK_VIEW_VISIBILITY;
    int view = NOOK_VIEW_LIT + 1 + (int)(mode - NOOK_LIVE_BUFFERS);
    return view < NOOK_VIEW_VISIBILITY ? view : view + 1;
}

const char *nook_live_mode_name(uint32_t mode)
{
    return mode < NOOK_LIVE_BUFFERS ? mode_names[mode] : nook_view_name((nook_view)nook_live_mode_buffer(mode));
}

bool nook_live_mode_parse(const char *name, uint32_t *out_mode)
{
    for (uint32_t mode = 0; mode < nook_live_mode_count(); mode++) {
        if (strcmp(nook_live_mode_name(mode), name) == 0) {
            *out_mode = mode;
            return true;
        }
    }
    return false;
}

bool nook_live_mode_counts(uint32_t mode)
{
    return mode >= NOOK_LIVE_FETCHES && mode <= NOOK_LIVE_DIVERGENCE;
}

bool nook_live_mode_occludes(uint32_t mode)
{
    return mode <= NOOK_LIVE_ERROR || nook_live_mode_counts(mode) ||
           (mode >= NOOK_LIVE_BUFFERS && nook_live_mode_buffer(mode) == NOOK_VIEW_LIGHT);
}

/* ---- How many ----------------------------------------------------------------------------------------------------- */

static void put_borders(nook_live_views *views)
{
    bool thirds = views->count == 3 && views->columns;
    views->splits[0] = thirds ? 1.0 / 3.0 : 0.5;
    views->splits[1] = thirds ? 2.0 / 3.0 : 0.5;
}

void nook_live_views_reset(nook_live_views *views, const char *setting)
{
    memset(views, 0, sizeof *views);
    views->count = 1;
    views->columns = true;
    views->r_max = 1.0;
    views->error_range = (double)NOOK_ERROR_RANGE_DEFAULT;
    views->counts_range = counts_at_first;
    views->fetches_range = fetches_at_first;
    views->steps_range = steps_at_first;
    for (int i = 0; i < 3; i++)
        views->slice[i] = 0.5;
    snprintf(views->views[0].setting, sizeof views->views[0].setting, "%s", setting);
    put_borders(views);
}

void nook_live_views_set_count(nook_live_views *views, uint32_t count)
{
    assert(count >= 1 && count <= NOOK_LIVE_VIEWS_MAX);
    const nook_live_view shown = views->views[views->active];
    for (uint32_t i = views->count; i < count; i++)
        views->views[i] = shown;
    for (uint32_t i = count; i < views->count; i++)
        memset(&views->views[i], 0, sizeof views->views[i]);
    views->count = count;
    if (views->active >= count)
        views->active = count - 1;
    put_borders(views);
}

void nook_live_views_turn(nook_live_views *views)
{
    views->columns = !views->columns;
    put_borders(views);
}

/* ---- Where -------------------------------------------------------------------------------------------------------- */

/* Left, top, right, bottom in parts of the picture. */
typedef struct place_parts {
    double left, top, right, bottom;
} place_parts;

static void parts_of(const nook_live_views *views, place_parts out[NOOK_LIVE_VIEWS_MAX])
{
    const double a = views->splits[0], b = views->splits[1];
    const place_parts all = { 0.0, 0.0, 1.0, 1.0 };
    for (int i = 0; i < NOOK_LIVE_VIEWS_MAX; i++)
        out[i] = all;
    if (views->count == 1)
        return;
    out[0].right = out[1].left = a;
    if (views->count == 3 && views->columns) {
        out[1].right = out[2].left = b;
    } else if (views->count == 3) {
        out[2].left = a;
        out[1].bottom = out[2].top = b;
    } else if (views->count == 4) {
        out[2].right = out[3].left = a;
        out[0].bottom = out[1].bottom = out[2].top = out[3].top = b;
    }
}

/* Borders fall between pixels; no view is without any. */
static uint32_t pixel_of(double part, uint32_t size, uint32_t low, uint32_t high)
{
    double at = floor(part * size + 0.5);
    return at < low ? low : at > high ? high : (uint32_t)at;
}

/* Where an edge of a view lies, from the left or the top. */
static uint32_t edge_of(double part, uint32_t size, const double splits[2], const uint32_t cuts[2])
{
    if (part <= 0.0)
        return 0;
    if (part >= 1.0)
        return size;
    return part == splits[0] ? cuts[0] : cuts[1];
}

void nook_live_views_place(const nook_live_views *views, uint32_t width, uint32_t height,
                           nook_rectangle out_places[NOOK_LIVE_VIEWS_MAX])
{
    assert(width > 0 && height > 0);
    if (width < NOOK_LIVE_VIEWS_MAX || height < NOOK_LIVE_VIEWS_MAX) { /* a window that was made a slit */
        for (uint32_t i = 0; i < views->count; i++)
            out_places[i] = (nook_rectangle){ 0, 0, width, height };
        return;
    }
    place_parts parts[NOOK_LIVE_VIEWS_MAX];
    const double *splits = views->splits;
    bool thirds = views->count == 3 && views->columns;
    uint32_t first = pixel_of(splits[0], width, 1, width - (thirds ? 2 : 1));
    const uint32_t upright[2] = { first, pixel_of(splits[1], width, first + 1, width - 1) };
    const uint32_t level = pixel_of(splits[1], height, 1, height - 1), across[2] = { level, level };
    parts_of(views, parts);
    for (uint32_t i = 0; i < views->count; i++) {
        const place_parts *p = &parts[i];
        uint32_t left = edge_of(p->left, width, splits, upright), right = edge_of(p->right, width, splits, upright);
        uint32_t top = edge_of(p->top, height, splits, across), bottom = edge_of(p->bottom, height, splits, across);
        out_places[i] = (nook_rectangle){ left, height - bottom, right - left, bottom - top };
    }
}

uint32_t nook_live_views_at(const nook_live_views *views, double x, double y)
{
    place_parts parts[NOOK_LIVE_VIEWS_MAX];
    parts_of(views, parts);
    for (uint32_t i = 0; i < views->count; i++) {
        const place_parts *p = &parts[i];
        if (x >= p->left && x < p->right && y >= p->top && y < p->bottom)
            return i;
    }
    return views->active; /* beside the picture */
}

/* ---- Borders ------------------------------------------------------------------------------------------------------ */

uint32_t nook_live_views_borders(const nook_live_views *views, nook_live_border out[NOOK_LIVE_SPLITS_MAX])
{
    const double a = views->splits[0], b = views->splits[1];
    if (views->count == 1)
        return 0;
    out[0] = (nook_live_border){ true, a, 0.0, 1.0 };
    if (views->count == 2)
        return 1;
    if (views->count == 3)
        out[1] = views->columns ? (nook_live_border){ true, b, 0.0, 1.0 } : (nook_live_border){ false, b, a, 1.0 };
    else
        out[1] = (nook_live_border){ false, b, 0.0, 1.0 };
    return 2;
}

uint32_t nook_live_views_border_at(const nook_live_views *views, double x, double y, const double reach[2])
{
    nook_live_border borders[NOOK_LIVE_SPLITS_MAX];
    uint32_t count = nook_live_views_borders(views, borders);
    for (uint32_t i = 0; i < count; i++) {
        double across = borders[i].upright ? x : y, along = borders[i].upright ? y : x;
        if (fabs(across - borders[i].at) <= reach[borders[i].upright ? 0 : 1] && along >= borders[i].from &&
            along <= borders[i].to)
            return i;
    }
    return NOOK_LIVE_SPLITS_MAX;
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

void nook_live_views_drag(nook_live_views *views, uint32_t border, double x, double y)
{
    nook_live_border borders[NOOK_LIVE_SPLITS_MAX];
    uint32_t count = nook_live_views_borders(views, borders);
    if (border >= count)
        return;
    double low = nearest, high = 1.0 - nearest;
    if (views->count == 3 && views->columns && border == 0)
        high = views->splits[1] - nearest;
    if (views->count == 3 && views->columns && border == 1)
        low = views->splits[0] + nearest;
    views->splits[border] = clamp(borders[border].upright ? x : y, low, high);
}
