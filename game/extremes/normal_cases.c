/* Normals that a host may give, and those that it should not. */
#include "engine/core/angle.h"
#include "game/extremes/edge_scene.h"
#include "game/extremes/probe.h"
#include "game/extremes/random_transform.h"
#include "game/extremes/surface_internal.h"
#include "game/techniques.h"
#include <math.h>
#include <stdio.h>

static double angle_between(const double a[3], const double b[3])
{
    double cross[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
    double sine = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    return atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/** A view that only the probe looks at. */
static nook_result open_probe(const nook_extremes *extremes, uint32_t side, uint32_t normal_format, nook_probe *probe,
                              nook_fixture_view **out_view)
{
    static const nook_ao_technique *const techniques[] = { &nook_probe_technique };
    const nook_fixture_view_desc desc = { .gpu = extremes->gpu,
                                          .width = side,
                                          .height = side,
                                          .techniques = techniques,
                                          .technique_count = 1,
                                          .normal_format = normal_format,
                                          .progress_user = probe };
    return nook_fixture_view_create(&desc, out_view);
}

/* ---- RG16 ---- */

/** Codes all over the square, its borders and corners included. */
static void fill_codes(nook_fixture_view *view)
{
    const uint32_t side = view->width;
    for (uint32_t i = 0; i < side * side; i++) {
        view->normals[i][0] = (float)(round(65535.0 * (i % side) / (side - 1)) / 65535.0);
        view->normals[i][1] = (float)(round(65535.0 * (i / side) / (side - 1)) / 65535.0);
    }
}

static nook_result compare_codes(nook_fixture_view *view, const nook_probe *probe, int turn, nook_extreme_found *found)
{
    nook_result result = nook_fixture_view_record(view, "probe");
    for (size_t i = 0; result == NOOK_OK && i < (size_t)view->width * view->height; i++) {
        double world[3], got[3];
        nook_fixture_decode_normal(view->normals[i], world);
        nook_matrix_apply_vector(&view->view_from_world, world, world);
        nook_probe_normal(probe, i, got);
        nook_extreme_worst(found, angle_between(world, got), "turn %d, code (%.0f, %.0f) of 65535", turn,
                           (double)view->normals[i][0] * 65535.0, (double)view->normals[i][1] * 65535.0);
    }
    return result;
}

nook_result nook_surface_run_codes(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    const uint32_t side = extremes->quick ? 52 : 258; /* 65535 is 255 * 257 */
    const double here[3] = { 0, 0, 0 }, one[3] = { 1, 1, 1 };
    nook_probe probe = { 0 };
    nook_random random = { 3 };
    nook_fixture_view *view;
    nook_result result = open_probe(extremes, side, 0, &probe, &view);
    out_found->bound = 0.5 * sqrt(18.0) / 32767.0 + 1e-6; /* and the rounding of floats */
    if (result != NOOK_OK)
        return result;
    fill_codes(view);
    for (int turn = 0; result == NOOK_OK && turn < (extremes->quick ? 2 : 8); turn++) {
        double quaternion[4] = { 0, 0, 0, 1 };
        if (turn > 0)
            nook_random_turn(&random, quaternion);
        view->view_from_world = nook_matrix_compose(here, quaternion, one);
        result = compare_codes(view, &probe, turn, out_found);
    }
    nook_fixture_view_destroy(view);
    nook_probe_free(&probe);
    return result;
}

/* ---- NaN and infinity ---- */

/** A plane with this normal in view space, 3 units away in the middle of the image, and normals that are all `texel`. */
static void draw_plane(nook_fixture_view *view, const double normal[3], float texel)
{
    for (uint32_t i = 0; i < view->width * view->height; i++) {
        double ray[3];
        nook_fixture_view_position(view, i % view->width, i / view->width, 1.0, ray);
        double facing = normal[0] * ray[0] + normal[1] * ray[1] + normal[2] * ray[2];
        nook_fixture_view_set_pixel(view, i % view->width, i / view->width, -3.0 * normal[2] / facing, normal);
        view->normals[i][0] = texel;
        view->normals[i][1] = i % 3 == 0 ? 0.5f : texel; /* one of the two is enough */
    }
}

nook_result nook_surface_run_rebuilt(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const uint32_t formats[] = { GL_RG32F, GL_RG16F, GL_RGBA16F };
    static const float texels[] = { NAN, INFINITY, -INFINITY };
    const double normals[][3] = { { 0, 0, 1 }, { 0.6, 0, 0.8 }, { -0.36, 0.48, 0.8 }, { 0, -0.8, 0.6 } };
    nook_result result = NOOK_OK;
    out_found->bound = 1e-4;
    for (size_t f = 0; result == NOOK_OK && f < NOOK_COUNT(formats); f++) {
        nook_probe probe = { 0 };
        nook_fixture_view *view;
        result = open_probe(extremes, 24, formats[f], &probe, &view);
        for (size_t i = 0; result == NOOK_OK && i < NOOK_COUNT(texels) * NOOK_COUNT(normals); i++) {
            const double *normal = normals[i / NOOK_COUNT(texels)];
            const float texel = texels[i % NOOK_COUNT(texels)];
            draw_plane(view, normal, texel);
            result = nook_fixture_view_record(view, "probe");
            for (size_t k = 0; result == NOOK_OK && k < (size_t)view->width * view->height; k++) {
                double got[3];
                nook_probe_normal(&probe, k, got);
                nook_extreme_worst(out_found, angle_between(normal, got), "format %#x, texel %g, plane %zu", formats[f],
                                   (double)texel, i / NOOK_COUNT(texels));
            }
        }
        nook_fixture_view_destroy(view);
        nook_probe_free(&probe);
    }
    return result;
}

/* ---- Anything ---- */

/** At full and at half scale, where a trace pixel takes one normal of four. */
static nook_result record_scales(nook_edge_scene *scene, nook_extreme_found *found, const char *what)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < 2; i++) {
        char where[128];
        snprintf(where, sizeof where, "%s, %s", what, nook_fixture_scales[i]);
        result = nook_ao_parse_param(scene->view->ao, "ao.scale", nook_fixture_scales[i]);
        if (result == NOOK_OK)
            result = nook_edge_scene_record_all(scene, found, where);
    }
    return result;
}

/** Every third normal becomes a pair of these. */
static void spoil(nook_edge_scene *scene)
{
    static const float texels[] = { 0.0f,  -0.0f, 1.0f,   NAN,     INFINITY, -INFINITY, 1e30f, -1e30f,
                                    -1.0f, 2.0f,  1e-30f, 3.4e38f, 0.5f,     65504.0f,  1e-45f };
    for (size_t i = 0; i < scene->pixels; i += 3) {
        scene->view->normals[i][0] = texels[i / 3 % NOOK_COUNT(texels)];
        scene->view->normals[i][1] = texels[i / 3 / NOOK_COUNT(texels) % NOOK_COUNT(texels)];
    }
}

/** Normals that lie in the surface, and that point into it. */
static nook_result turn_normals(nook_edge_scene *scene, nook_extreme_found *found)
{
    static const double turns[] = { 1.5707963267948966, NOOK_PI, 2.0 };
    nook_result result = NOOK_OK;
    for (size_t k = 0; result == NOOK_OK && k < NOOK_COUNT(turns); k++) {
        result = nook_edge_scene_draw(scene);
        for (size_t i = 0; i < scene->pixels; i++) {
            const double angle = turns[k];
            double n[3];
            nook_fixture_decode_normal(scene->view->normals[i], n);
            const double turned[3] = { cos(angle) * n[0] - sin(angle) * n[2], n[1],
                                       sin(angle) * n[0] + cos(angle) * n[2] };
            nook_fixture_encode_normal(turned, scene->view->normals[i]);
        }
        if (result == NOOK_OK)
            result = record_scales(scene, found, "turned");
    }
    return result;
}

nook_result nook_surface_run_rubbish_normals(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const uint32_t formats[] = { GL_RG32F, GL_RG16F, GL_RG16, GL_RG8 };
    const uint32_t side = extremes->quick ? 24 : 48;
    nook_result result = NOOK_OK;
    out_found->bound = 0.0;
    for (size_t f = 0; result == NOOK_OK && f < NOOK_COUNT(formats); f++) {
        const nook_edge_scene_desc desc = {
            .width = side, .height = side, .resolution = 24, .normal_format = formats[f]
        };
        nook_edge_scene scene;
        result = nook_edge_scene_make(extremes, &desc, &scene);
        if (result != NOOK_OK)
            break;
        spoil(&scene);
        char what[48];
        snprintf(what, sizeof what, "rubbish in format %#x", formats[f]);
        result = record_scales(&scene, out_found, what);
        if (result == NOOK_OK && f == 0)
            result = turn_normals(&scene, out_found);
        nook_edge_scene_free(&scene);
        nook_extreme_progress(extremes, (double)(f + 1) / NOOK_COUNT(formats));
    }
    return result;
}
