#include "modules/bake/alpha_area.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stdlib.h>

static const double farthest = 1e9; /* texels: beyond, where a point lies on a texture is rounding */

/* sum[y * (width + 1) + x] is that of the texels left of x and above y. */
typedef struct sums {
    const nook_alpha_part *part; /* the first with this texture, seen in this way */
    int64_t width, height;
    uint64_t *sum;
} sums;

struct nook_alpha_areas {
    const nook_alpha_part *parts;
    uint32_t *sums_of_part;
    sums *sums;
    uint32_t sums_count;
};

/* ---- Sums ------------------------------------------------------------------------------------------------------- */

static bool sees_alike(const nook_alpha_part *a, const nook_alpha_part *b)
{
    return a->texels == b->texels && a->width == b->width && a->height == b->height && a->texel_size == b->texel_size &&
           a->alpha == b->alpha && a->masked == b->masked && (!a->masked || a->cutoff == b->cutoff);
}

static bool make_sums(const nook_alpha_part *part, sums *out)
{
    const size_t width = part->width, height = part->height;
    uint8_t seen[UINT8_MAX + 1];
    *out = (sums){ .part = part, .width = part->width, .height = part->height };
    out->sum = calloc((width + 1) * (height + 1), sizeof *out->sum);
    if (!out->sum)
        return false;
    for (uint32_t texel = 0; texel <= UINT8_MAX; texel++)
        seen[texel] = (uint8_t)lround(nook_alpha_of_texel(part, (uint8_t)texel) * UINT8_MAX);
    for (uint32_t y = 0; y < height; y++) {
        const uint64_t *above = out->sum + y * (width + 1);
        uint64_t *row = out->sum + (y + 1) * (width + 1), line = 0;
        for (uint32_t x = 0; x < width; x++) {
            line += seen[nook_alpha_texel(part, x, y)];
            row[x + 1] = above[x + 1] + line;
        }
    }
    return true;
}

/* @return false when there is no memory */
static bool find_sums(nook_alpha_areas *areas, uint32_t part)
{
    uint32_t i = 0;
    while (i < areas->sums_count && !sees_alike(areas->sums[i].part, &areas->parts[part]))
        i++;
    areas->sums_of_part[part] = i;
    return i < areas->sums_count || make_sums(&areas->parts[part], &areas->sums[areas->sums_count++]);
}

nook_alpha_areas *nook_alpha_areas_create(const nook_alphas *alphas)
{
    size_t count = alphas ? alphas->part_count : 0;
    nook_alpha_areas *areas = calloc(1, sizeof *areas);
    if (!areas)
        return NULL;
    areas->parts = count ? alphas->parts : NULL;
    areas->sums_of_part = malloc((count + 1) * sizeof *areas->sums_of_part);
    areas->sums = calloc(count + 1, sizeof *areas->sums);
    bool made = areas->sums_of_part && areas->sums;
    for (uint32_t i = 0; i < count && made; i++)
        made = !areas->parts[i].texels || find_sums(areas, i);
    if (!made) {
        nook_alpha_areas_destroy(areas);
        return NULL;
    }
    return areas;
}

void nook_alpha_areas_destroy(nook_alpha_areas *areas)
{
    if (!areas)
        return;
    for (uint32_t i = 0; i < areas->sums_count; i++)
        free(areas->sums[i].sum);
    free(areas->sums);
    free(areas->sums_of_part);
    free(areas);
}

/* Of the texels left of x and above y, the texture being repeated. Both at least 0. */
static uint64_t sum_to(const sums *s, int64_t x, int64_t y)
{
    uint64_t across = (uint64_t)(x / s->width), down = (uint64_t)(y / s->height);
    const size_t row = (size_t)s->width + 1, right = (size_t)(x % s->width), low = (size_t)(y % s->height);
    const uint64_t *last = s->sum + row * (size_t)s->height;
    return across * down * last[s->width] + across * s->sum[row * low + (size_t)s->width] + down * last[right] +
           s->sum[row * low + right];
}

/* The mean alpha of the texels [x, end_x) x [y, end_y). */
static double mean_of(const sums *s, int64_t x, int64_t y, int64_t end_x, int64_t end_y)
{
    uint64_t sum = sum_to(s, end_x, end_y) - sum_to(s, x, end_y) - sum_to(s, end_x, y) + sum_to(s, x, y);
    return (double)sum / ((double)(end_x - x) * (double)(end_y - y) * UINT8_MAX);
}

/* ---- Where a piece lies on its texture -------------------------------------------------------------------------- */

nook_alpha_map nook_alpha_map_make(const double corners[3][3], const double uvs[3][2], const nook_alpha_part *part)
{
    const double size[2] = { part->width, part->height };
    double edge[2][3], across[3], gradient[2][3];
    for (int i = 0; i < 3; i++) {
        edge[0][i] = corners[1][i] - corners[0][i];
        edge[1][i] = corners[2][i] - corners[0][i];
    }
    nook_vector_cross(edge[0], edge[1], across);
    double squared = nook_vector_dot(across, across);
    nook_vector_cross(edge[1], across, gradient[0]);
    nook_vector_cross(across, edge[0], gradient[1]);
    nook_alpha_map map;
    for (int k = 0; k < 2; k++) {
        double first = (uvs[1][k] - uvs[0][k]) * size[k] / squared,
               second = (uvs[2][k] - uvs[0][k]) * size[k] / squared;
        for (int i = 0; i < 3; i++)
            map.normal[k][i] = first * gradient[0][i] + second * gradient[1][i];
        map.offset[k] = uvs[0][k] * size[k] - nook_vector_dot(map.normal[k], corners[0]);
    }
    return map;
}

/* Blocks of the texture along one side: from `first` on, of `step` texels, `count` of them. */
typedef struct blocks {
    int64_t first, step, count;
    double offset; /* of the map, so that coordinates begin in the texture and not in one of its repetitions */
} blocks;

/* @return false: too large or too far off to look at places on the texture */
static bool find_blocks(const nook_polygon *polygon, const nook_alpha_map *map, int k, int64_t size, blocks *out)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < polygon->count; i++) {
        double at = nook_vector_dot(map->normal[k], polygon->corner[i]) + map->offset[k];
        if (!(fabs(at) < farthest))
            return false;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    double repetition = floor(low / (double)size) * (double)size;
    low -= repetition;
    high -= repetition;
    out->offset = map->offset[k] - repetition;
    out->step = (int64_t)fmax(ceil((high - low) / NOOK_ALPHA_BLOCKS), 1.0);
    out->first = (int64_t)floor(low / (double)out->step);
    out->count = (int64_t)fmax(ceil(high / (double)out->step), (double)out->first + 1.0) - out->first;
    return out->step <= size;
}

/* ---- Cutting ---------------------------------------------------------------------------------------------------- */

typedef struct cutter {
    const sums *sums;
    const nook_alpha_map *map;
    blocks u, v;
    nook_alpha_visit visit;
    void *user;
} cutter;

/* The parts before and after the block boundary `at`. */
static void split(const cutter *c, const nook_polygon *polygon, int k, const blocks *b, int64_t at,
                  nook_polygon *out_before, nook_polygon *out_after)
{
    const double *n = c->map->normal[k], back[3] = { -n[0], -n[1], -n[2] };
    double height = (double)(at * b->step) - b->offset;
    nook_polygon_clip(polygon, back, -height, out_before);
    nook_polygon_clip(polygon, n, height, out_after);
}

static void give(const cutter *c, const nook_polygon *polygon, double alpha)
{
    if (polygon->count > 0 && alpha > 0.0)
        c->visit(c->user, polygon, alpha);
}

/* Neighbours of one alpha stay together. */
static void cut_row(const cutter *c, const nook_polygon *row, int64_t v)
{
    const blocks *u = &c->u;
    int64_t top = v * c->v.step, low = top + c->v.step, end = u->first + u->count;
    nook_polygon rest = *row;
    for (int64_t at = u->first; at < end && rest.count > 0;) {
        double alpha = mean_of(c->sums, at * u->step, top, (at + 1) * u->step, low);
        for (at++; at < end; at++)
            if (mean_of(c->sums, at * u->step, top, (at + 1) * u->step, low) != alpha)
                break;
        nook_polygon here = rest, after = { .count = 0 };
        if (at < end)
            split(c, &rest, 0, u, at, &here, &after);
        give(c, &here, alpha);
        rest = after;
    }
}

static void cut_blocks(const cutter *c, const nook_polygon *polygon)
{
    int64_t end = c->v.first + c->v.count;
    nook_polygon rest = *polygon;
    for (int64_t v = c->v.first; v < end && rest.count > 0; v++) {
        nook_polygon here = rest, after = { .count = 0 };
        if (v + 1 < end)
            split(c, &rest, 1, &c->v, v + 1, &here, &after);
        if (here.count > 0)
            cut_row(c, &here, v);
        rest = after;
    }
}

/* Of coordinates that are not finite nothing can be looked up: engine/core/alpha.h. */
static bool is_finite(const nook_alpha_map *map)
{
    return isfinite(map->offset[0]) && isfinite(map->offset[1]);
}

void nook_alpha_cut(const nook_alpha_areas *areas, const nook_alpha_part *part, const nook_alpha_map *map,
                    const nook_polygon *polygon, nook_alpha_visit visit, void *user)
{
    cutter c = { .map = map, .visit = visit, .user = user };
    if (!part->texels || !is_finite(map)) {
        give(&c, polygon, nook_alpha_of_texel(part, UINT8_MAX));
        return;
    }
    c.sums = &areas->sums[areas->sums_of_part[part - areas->parts]];
    bool near = find_blocks(polygon, map, 0, c.sums->width, &c.u) && find_blocks(polygon, map, 1, c.sums->height, &c.v);
    double whole = near ? mean_of(c.sums, c.u.first * c.u.step, c.v.first * c.v.step,
                                  (c.u.first + c.u.count) * c.u.step, (c.v.first + c.v.count) * c.v.step)
                        : mean_of(c.sums, 0, 0, c.sums->width, c.sums->height);
    if (!near || whole == 0.0 || whole == 1.0)
        give(&c, polygon, whole);
    else
        cut_blocks(&c, polygon);
}
