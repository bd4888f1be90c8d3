#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include <math.h>

/** Extends a box by that of a mesh. */
static void add_mesh(const nook_box *of_mesh, const nook_matrix *sun_from_mesh, sun_box *box)
{
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (i >> k & 1) ? of_mesh->max[k] : of_mesh->min[k];
        nook_matrix_apply_point(sun_from_mesh, p, p);
        for (int k = 0; k < 3; k++) {
            box->low[k] = fmin(box->low[k], p[k]);
            box->high[k] = fmax(box->high[k], p[k]);
        }
    }
}

static const sun_box empty = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

/** Extends a box by that of a draw. */
static void add_draw(const nook_scene *scene, const nook_draw *draw, const nook_matrix *sun_from_world, sun_box *box)
{
    const nook_box of_mesh = nook_draw_box(scene, draw);
    if (!(of_mesh.min[0] <= of_mesh.max[0]))
        return;
    nook_matrix sun_from_mesh = nook_matrix_multiply(sun_from_world, &draw->world_from_local);
    add_mesh(&of_mesh, &sun_from_mesh, box);
}

static bool is_finite(const sun_box *box)
{
    return box->low[0] <= box->high[0] && isfinite(box->high[0] - box->low[0]);
}

/** The box of everything drawn. @return false: nothing is */
static bool box_of_draws(const nook_frame *frame, const nook_matrix *sun_from_world, sun_box *box)
{
    *box = empty;
    for (size_t i = 0; i < frame->draw_count; i++)
        add_draw(frame->scene->scene, &frame->draws[i], sun_from_world, box);
    return is_finite(box);
}

/** The sun's axes: z away from the sun, so that depth grows along its light. */
static nook_matrix sun_axes(const nook_sun *sun)
{
    const double *d = sun->direction;
    const double zero[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 }, side[3] = { 1, 0, 0 };
    bool steep = fabs(d[1]) > 0.99 * nook_vector_length(d);
    nook_matrix view = nook_matrix_look_at(zero, d, steep ? side : up); /* looks along -z */
    nook_matrix flip = nook_matrix_scale(1.0, 1.0, -1.0);
    return nook_matrix_multiply(&flip, &view);
}

/** Fits the map to a box. @return map from sun: [0, 1]^3; *texel is a texel's width in metres */
static nook_matrix fit(const sun_box *box, double *texel)
{
    const double margin = 4.0; /* texels: the filter never reaches past the edge */
    double width = fmax(box->high[0] - box->low[0], box->high[1] - box->low[1]);
    double depth = box->high[2] - box->low[2];
    width = fmax(width, fmax(depth * 1e-3, 1e-6)) * SHADOW_SIZE / (SHADOW_SIZE - 2.0 * margin);
    *texel = width / SHADOW_SIZE;
    double spare = 4.0 * *texel;
    depth += 2.0 * spare;
    nook_matrix scale = nook_matrix_scale(1.0 / width, 1.0 / width, 1.0 / depth);
    nook_matrix move = nook_matrix_translation(0.5 * width - 0.5 * (box->low[0] + box->high[0]),
                                               0.5 * width - 0.5 * (box->low[1] + box->high[1]), spare - box->low[2]);
    return nook_matrix_multiply(&scale, &move);
}

bool nook_shadow_fit(const nook_frame *frame, shadow_fit *out)
{
    out->sun_from_world = sun_axes(&frame->lights->sun);
    if (!box_of_draws(frame, &out->sun_from_world, &out->box))
        return false;
    nook_matrix map_from_sun = fit(&out->box, &out->texel);
    out->map_from_world = nook_matrix_multiply(&map_from_sun, &out->sun_from_world);
    return true;
}

bool nook_shadow_has_room(const shadow_fit *fit, const nook_scene *scene, const nook_draw *draw)
{
    sun_box box = empty;
    add_draw(scene, draw, &fit->sun_from_world, &box);
    for (int k = 0; k < 3 && is_finite(&box); k++) {
        if (!(box.low[k] >= fit->box.low[k] && box.high[k] <= fit->box.high[k]))
            return false;
    }
    return true;
}

bool nook_shadow_rect(const shadow_fit *fit, const nook_scene *scene, const nook_draw *draw, shadow_rect *out)
{
    const double margin = 2.0; /* texels: rounding, and a raster that is a pixel more generous */
    sun_box box = empty;
    add_draw(scene, draw, &fit->map_from_world, &box);
    for (int k = 0; k < 2; k++) {
        out->low[k] = (int32_t)fmax(floor(box.low[k] * SHADOW_SIZE - margin), 0.0);
        out->high[k] = (int32_t)fmin(ceil(box.high[k] * SHADOW_SIZE + margin), SHADOW_SIZE);
    }
    return is_finite(&box) && out->low[0] < out->high[0] && out->low[1] < out->high[1];
}

bool nook_shadow_rects_meet(const shadow_rect *a, const shadow_rect *b)
{
    return a->low[0] < b->high[0] && b->low[0] < a->high[0] && a->low[1] < b->high[1] && b->low[1] < a->high[1];
}

static shadow_rect unite(const shadow_rect *a, const shadow_rect *b)
{
    shadow_rect both;
    for (int k = 0; k < 2; k++) {
        both.low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        both.high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
    }
    return both;
}

static int64_t area(const shadow_rect *rect)
{
    return (int64_t)(rect->high[0] - rect->low[0]) * (rect->high[1] - rect->low[1]);
}

/* The part that grows least, in texels, when `added` joins it. */
static uint32_t best_partner(const shadow_rects *rects, const shadow_rect *added)
{
    uint32_t best = 0;
    int64_t least = INT64_MAX;
    for (uint32_t i = 0; i < rects->count; i++) {
        shadow_rect both = unite(&rects->items[i], added);
        int64_t more = area(&both) - area(&rects->items[i]);
        if (more < least) {
            least = more;
            best = i;
        }
    }
    return best;
}

void nook_shadow_rects_add(shadow_rects *rects, shadow_rect added)
{
    for (uint32_t i = 0; i < rects->count;) { /* a part that grew may meet those that it did not meet before */
        if (!nook_shadow_rects_meet(&rects->items[i], &added)) {
            i++;
            continue;
        }
        added = unite(&rects->items[i], &added);
        rects->items[i] = rects->items[--rects->count];
        i = 0;
    }
    if (rects->count < SHADOW_RECTS) {
        rects->items[rects->count++] = added;
        return;
    }
    uint32_t partner = best_partner(rects, &added);
    added = unite(&rects->items[partner], &added);
    rects->items[partner] = rects->items[--rects->count];
    nook_shadow_rects_add(rects, added);
}
