/* The formats of depth and normals that hosts have, and what each costs. */
#include "engine/core/angle.h"
#include "game/extremes/buffer_internal.h"
#include "game/extremes/edge_pictures.h"
#include "game/extremes/groups.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double R_MAX = 0.8, FARTHEST = 6.5; /* of the usual scene: its reach, and where its farthest wall is */

static uint32_t side_of(const nook_extremes *extremes)
{
    return extremes->quick ? 24 : 48;
}

nook_result nook_buffer_take(const nook_extremes *extremes, const nook_edge_scene_desc *desc, nook_extreme_found *found,
                             const char *where, nook_edge_pictures *out_pictures)
{
    nook_edge_scene scene;
    nook_edge_scene_desc sized = *desc;
    sized.width = sized.height = side_of(extremes);
    nook_result result = nook_edge_scene_make(extremes, &sized, &scene);
    if (result != NOOK_OK)
        return result;
    result = nook_edge_pictures_take(&scene, found, where, out_pictures);
    nook_edge_scene_free(&scene);
    return result;
}

/** Says what each technique loses: "volume 0.0003, ssao 0.0001", and keeps the worst. */
static void compare_each(const nook_edge_pictures *best, const nook_edge_pictures *got, nook_extreme_found *found)
{
    size_t used = 0;
    char each[sizeof found->where] = "";
    double worst = 0.0;
    for (size_t i = 0; i < best->count; i++) {
        double rms =
            nook_edge_rms(best->visibility + i * best->pixels, got->visibility + i * got->pixels, best->pixels);
        int size = snprintf(each + used, sizeof each - used, "%s%s %.1e", i ? ", " : "", best->estimators[i].name, rms);
        used += size > 0 && used + (size_t)size < sizeof each ? (size_t)size : 0;
        worst = rms <= worst ? worst : rms; /* NaN is kept */
    }
    nook_extreme_worst(found, worst, "%s", each);
}

/** A G-buffer of this kind against the best: 32 bit float, reversed and infinite; normals of 16 bits. */
static nook_result compare_with_best(const nook_extremes *extremes, const nook_edge_scene_desc *desc,
                                     nook_extreme_found *found)
{
    nook_edge_pictures best, got = { 0 };
    nook_result result = nook_buffer_take(extremes, &(nook_edge_scene_desc){ 0 }, found, "best", &best);
    if (result != NOOK_OK)
        return result;
    result = nook_buffer_take(extremes, desc, found, "this format", &got);
    if (result == NOOK_OK)
        compare_each(&best, &got, found);
    nook_edge_pictures_free(&best);
    nook_edge_pictures_free(&got);
    return result;
}

/** The same of a format whose worst RMS a limit states. */
static nook_result compare_and_state(const nook_extremes *extremes, const nook_edge_scene_desc *desc, double stated,
                                     nook_extreme_found *found)
{
    nook_result result = compare_with_best(extremes, desc, found);
    /* With few pixels, as in a quick run, single rays count for more. */
    nook_extreme_state(found, stated, extremes->quick ? 0.002 : 0.0005, found->measured, "RMS of the worst technique");
    return result;
}

/* ---- Depth ---- */

/* A depth that is off may turn a ray. Less is not seen of rays: one of 16 in one pixel of the picture. */
static double cost_of_a_ray(const nook_extremes *extremes)
{
    return 1.0 / (16.0 * side_of(extremes));
}

/**
 * What an error of distance may cost: the wall at distance x from a point has A = (acos k - k sqrt(1 - k^2)) / pi, k = x / r_max
 * (fixture 5), which changes by at most 2 / (pi r_max) per unit of x. Point and wall may be off both.
 */
static double cost_of_distance(double off)
{
    return 2.0 / (NOOK_PI * R_MAX) * 2.0 * off;
}

/** @param step  of device depth, about 1 */
static double cost_of_depth(const nook_extremes *extremes, double step, double z_near)
{
    return cost_of_a_ray(extremes) + cost_of_distance(step * FARTHEST * FARTHEST / z_near);
}

static nook_result run_float_reversed(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = cost_of_distance(0x1p-24 * FARTHEST);
    return compare_with_best(extremes, &(nook_edge_scene_desc){ .z_near = 1e-6, .depth_format = GL_DEPTH_COMPONENT32F },
                             out_found);
}

static nook_result run_float_normal(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const nook_edge_scene_desc desc = {
        .z_near = 1e-3, .z_far = 1e3, .normal_z = true, .depth_format = GL_DEPTH_COMPONENT32F
    };
    out_found->bound = cost_of_depth(extremes, 0x1p-24, desc.z_near);
    return compare_with_best(extremes, &desc, out_found);
}

static nook_result run_24_reversed(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = cost_of_depth(extremes, 0x1p-24, 0.1);
    return compare_with_best(extremes, &(nook_edge_scene_desc){ .depth_format = GL_DEPTH_COMPONENT24 }, out_found);
}

static nook_result run_24_normal(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const nook_edge_scene_desc desc = {
        .z_near = 0.1, .z_far = 100.0, .normal_z = true, .depth_format = GL_DEPTH_COMPONENT24
    };
    out_found->bound = cost_of_depth(extremes, 0x1p-24, desc.z_near);
    return compare_with_best(extremes, &desc, out_found);
}

static nook_result run_24_near(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const nook_edge_scene_desc desc = {
        .z_near = 1e-3, .z_far = 1e3, .normal_z = true, .depth_format = GL_DEPTH_COMPONENT24
    };
    out_found->bound = cost_of_depth(extremes, 0x1p-24, desc.z_near);
    return compare_with_best(extremes, &desc, out_found);
}

static nook_result run_16_normal(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const nook_edge_scene_desc desc = {
        .z_near = 0.1, .z_far = 100.0, .normal_z = true, .depth_format = GL_DEPTH_COMPONENT16
    };
    out_found->bound = cost_of_depth(extremes, 0x1p-16, desc.z_near);
    return compare_and_state(extremes, &desc, 0.005, out_found);
}

static nook_result run_16_reversed(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = cost_of_depth(extremes, 0x1p-16, 0.1);
    return compare_and_state(extremes, &(nook_edge_scene_desc){ .depth_format = GL_R16 }, 0.003, out_found);
}

/* ---- Normals ---- */

/** A normal turned by an angle changes A by at most half of it: 1/pi times the integral of max(0, sin cos) over the hemisphere. */
static double cost_of_normals(double step)
{
    return 0.5 * 0.5 * sqrt(18.0) * step;
}

static nook_result run_16f(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = cost_of_normals(0x1p-10); /* of [-1, 1], where a texel of [0.5, 1) has steps of 2^-11 */
    return compare_with_best(extremes, &(nook_edge_scene_desc){ .normal_format = GL_RGBA16F }, out_found);
}

static nook_result run_8(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    double up[3];
    nook_fixture_decode_normal((float[2]){ 128.0f / 255.0f, 128.0f / 255.0f }, up); /* the code nearest to +z */
    nook_extreme_state(out_found, 1.0 / 3.0, 0.02, acos(up[2]) / NOOK_PI * 180.0,
                       "degrees that a level floor leans by");
    out_found->bound = cost_of_normals(2.0 / 255.0);
    return compare_and_state(extremes, &(nook_edge_scene_desc){ .normal_format = GL_RGBA8 }, 0.007, out_found);
}

static const nook_extreme cases[] = {
    { .name = "depth of 32 bit float, reversed, near plane 1e-6",
      .unit = "RMS of visibility",
      .why = "Its step is a share of the distance, whatever the near plane: 2/pi of half of one by r_max, of point and "
             "wall.",
      .run = run_float_reversed },
    { .name = "depth of 32 bit float, normal, near plane 0.001, far 1000",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .run = run_float_normal },
    { .name = "depth of 24 bits, reversed, near plane 0.1",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .run = run_24_reversed },
    { .name = "depth of 24 bits, normal, near plane 0.1, far 100",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .run = run_24_normal },
    { .name = "depth of 24 bits, normal, near plane 0.001, far 1000",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .run = run_24_near },
    { .name = "depth of 16 bits, normal, near plane 0.1, far 100",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .limit = "16 bit depth: an RMS of 0.005, reversed 0.003, at distances of 20 to 65 near planes.",
      .run = run_16_normal },
    { .name = "depth of 16 bits, reversed, near plane 0.1",
      .unit = "RMS of visibility",
      .why = "One ray of 16 in one pixel, and 2/pi of the depth's error by r_max: how A of a wall changes with its "
             "distance.",
      .limit = "16 bit depth: an RMS of 0.005, reversed 0.003, at distances of 20 to 65 near planes.",
      .run = run_16_reversed },
    { .name = "normals of 16 bit float",
      .unit = "RMS of visibility",
      .why = "Half of the largest turn of a normal.",
      .run = run_16f },
    { .name = "normals of 8 bits",
      .unit = "RMS of visibility",
      .why = "Half of the largest turn of a normal: 1 degree.",
      .limit = "8 bit normals: an RMS of 0.007, and a level floor leans by a third of a degree.",
      .run = run_8 },
    { .name = "no normals, rebuilt from depth: the same away from edges",
      .unit = "RMS of visibility",
      .why = "On a plane the slope of depth is the normal: half of half a step of its 16 bits.",
      .limit = "no normals: pixels at edges take a neighbour's; an RMS of 0.04 in a small picture with many edges.",
      .run = nook_buffer_run_no_normals },
    { .name = "rows from the top by a flipped projection: no more apart than seeds are",
      .unit = "RMS by RMS of seeds",
      .why = "Only which pixel gets which rays changes: the largest of four seeds, and a quarter for chance.",
      .run = nook_buffer_run_flipped },
};

const nook_extreme_group nook_extreme_buffers = { .name = "buffers", .cases = cases, .count = NOOK_COUNT(cases) };
