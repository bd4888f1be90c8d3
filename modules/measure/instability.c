#include "modules/measure/instability.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>

static const double steps_per_pixel = 256.0; /* as fine as graphics hardware filters */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double nook_seen_footprint(const nook_seen *seen)
{
    return 2.0 * tan(0.5 * seen->fov_y_radians) / seen->height;
}

static size_t pixel_index(const nook_seen *seen, uint32_t x, uint32_t y)
{
    return (size_t)y * seen->width + x;
}

nook_surface_point nook_seen_point(const nook_seen *seen, double footprint, uint32_t x, uint32_t y)
{
    size_t i = pixel_index(seen, x, y);
    double distance = seen->distances[i];
    nook_surface_point p = { .position = { (x + 0.5 - 0.5 * seen->width) * footprint * distance,
                                           (y + 0.5 - 0.5 * seen->height) * footprint * distance, -distance } };
    for (size_t axis = 0; axis < 3; axis++)
        p.normal[axis] = (double)seen->normals[3 * i + axis];
    nook_matrix_apply_vector(&seen->view_from_world, p.normal, p.normal);
    return p;
}

typedef struct two_views {
    const nook_seen *first, *second;
    nook_matrix second_from_first;
    double first_pixel, second_pixel; /* footprints */
} two_views;

/* A point of the first camera's picture as the second has it. */
static nook_surface_point seen_by_second(const two_views *views, uint32_t x, uint32_t y)
{
    nook_surface_point p = nook_seen_point(views->first, views->first_pixel, x, y);
    nook_matrix_apply_point(&views->second_from_first, p.position, p.position);
    nook_matrix_apply_vector(&views->second_from_first, p.normal, p.normal);
    return p;
}

static bool same_surface(const two_views *views, const nook_surface_point *p, uint32_t x, uint32_t y)
{
    const nook_seen *second = views->second;
    if (!(second->distances[pixel_index(second, x, y)] > 0.0f))
        return false;
    nook_surface_point there = nook_seen_point(second, views->second_pixel, x, y);
    double between[3];
    for (int i = 0; i < 3; i++)
        between[i] = p->position[i] - there.position[i];
    double tolerance = NOOK_MATCH_PLANE_FOOTPRINTS * views->second_pixel * -p->position[2];
    return dot(p->normal, there.normal) >= NOOK_MATCH_NORMAL_COSINE && fabs(dot(between, there.normal)) <= tolerance &&
           fabs(dot(between, p->normal)) <= tolerance;
}

/* The pixels that bilinear reading at a place takes from, and their weights: 1, 2 or 4 of them, never one of weight 0. */
typedef struct taps {
    uint32_t x[4], y[4];
    double weight[4];
    int count;
} taps;

static taps taps_at(double x, double y)
{
    double left = floor(x), bottom = floor(y), right_part = x - left, top_part = y - bottom;
    taps t = { .count = 0 };
    for (uint32_t i = 0; i < 4; i++) {
        double weight = (i & 1 ? right_part : 1.0 - right_part) * (i & 2 ? top_part : 1.0 - top_part);
        if (weight > 0.0) {
            t.x[t.count] = (uint32_t)left + (i & 1);
            t.y[t.count] = (uint32_t)bottom + (i >> 1);
            t.weight[t.count++] = weight;
        }
    }
    return t;
}

static double to_step(double x)
{
    return floor(x * steps_per_pixel + 0.5) / steps_per_pixel;
}

/* @return false when the second camera does not see the point; *out_x and *out_y are untouched then */
static bool find_place(const two_views *views, const nook_surface_point *p, float *out_x, float *out_y)
{
    const nook_seen *second = views->second;
    double distance = -p->position[2];
    if (!(distance > 0.0))
        return false;
    double x = to_step(p->position[0] / (distance * views->second_pixel) + 0.5 * second->width - 0.5);
    double y = to_step(p->position[1] / (distance * views->second_pixel) + 0.5 * second->height - 0.5);
    if (!(x >= 0.0 && y >= 0.0 && x <= second->width - 1.0 && y <= second->height - 1.0))
        return false;
    taps t = taps_at(x, y);
    for (int i = 0; i < t.count; i++) {
        if (!same_surface(views, p, t.x[i], t.y[i]))
            return false;
    }
    *out_x = (float)x;
    *out_y = (float)y;
    return true;
}

static two_views make_views(const nook_seen *first, const nook_seen *second)
{
    nook_matrix world_from_first;
    nook_matrix_inverse_affine(&first->view_from_world, &world_from_first);
    return (two_views){ first, second, nook_matrix_multiply(&second->view_from_world, &world_from_first),
                        nook_seen_footprint(first), nook_seen_footprint(second) };
}

nook_result nook_match_create(const nook_seen *first, const nook_seen *second, nook_match *out_match)
{
    *out_match = (nook_match){ 0 };
    size_t pixels = (size_t)first->width * first->height;
    float *places = malloc(pixels * 2 * sizeof *places);
    if (!places)
        return nook_fail(NOOK_E_MEMORY, "instability: no memory to match %zu pixels", pixels);
    two_views views = make_views(first, second);
    uint64_t geometry = 0, shared = 0;
    for (size_t i = 0; i < pixels; i++) {
        places[2 * i] = places[2 * i + 1] = -1.0f;
        if (!(first->distances[i] > 0.0f))
            continue;
        nook_surface_point p = seen_by_second(&views, (uint32_t)(i % first->width), (uint32_t)(i / first->width));
        geometry++;
        shared += find_place(&views, &p, &places[2 * i], &places[2 * i + 1]);
    }
    *out_match = (nook_match){ .places = places,
                               .width = first->width,
                               .height = first->height,
                               .second_width = second->width,
                               .second_height = second->height,
                               .geometry = geometry,
                               .shared = shared };
    return NOOK_OK;
}

void nook_match_free(nook_match *match)
{
    if (!match)
        return;
    free(match->places);
    *match = (nook_match){ 0 };
}

static double read_between(const nook_match *match, const float *values, const float place[2])
{
    taps t = taps_at((double)place[0], (double)place[1]);
    double value = 0.0;
    for (int i = 0; i < t.count; i++)
        value += t.weight[i] * (double)values[(size_t)t.y[i] * match->second_width + t.x[i]];
    return value;
}

/* Sums over the shared points; of values in [0, 1], which a double adds without harm. */
typedef struct sums {
    double change_squared, value, value_squared;
} sums;

static void finish(const sums *s, nook_instability *out)
{
    double n = (double)out->pixels, mean = s->value / (2.0 * n);
    out->valid = true;
    out->rms = sqrt(s->change_squared / n);
    out->contrast = sqrt(fmax(s->value_squared / (2.0 * n) - mean * mean, 0.0));
    if (out->contrast > 1e-6) /* below a float's own steps */
        out->relative = out->rms / (sqrt(2.0) * out->contrast);
}

nook_instability nook_instability_measure(const nook_match *match, const float *first, const float *second)
{
    nook_instability out = { .rms = NAN, .contrast = NAN, .relative = NAN };
    sums s = { 0 };
    for (size_t i = 0; i < (size_t)match->width * match->height; i++) {
        const float *place = &match->places[2 * i];
        if (place[0] < 0.0f)
            continue;
        double a = (double)first[i], b = read_between(match, second, place);
        out.pixels++;
        if (!isfinite(a) || !isfinite(b)) {
            out.non_finite++;
            continue;
        }
        s.change_squared += (a - b) * (a - b);
        s.value += a + b;
        s.value_squared += a * a + b * b;
    }
    if (out.pixels > 0 && out.non_finite == 0)
        finish(&s, &out);
    return out;
}
