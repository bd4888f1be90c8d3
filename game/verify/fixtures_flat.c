/* Fixtures 1 and 4 to 9: planes and pieces of planes that are infinite in the closed forms. */
#include "engine/core/angle.h"
#include "game/verify/fixtures.h"
#include <math.h>
#include <stdio.h>

static bool is_infinite(double extent)
{
    return extent >= NOOK_VERIFY_INFINITE;
}

static void look_from_above(nook_verify_scene *scene)
{
    nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 5 }, 1.1);
}

static void look_from_the_side(nook_verify_scene *scene)
{
    nook_verify_scene_camera(scene, "oblique", (double[]){ -3, 0, 4 }, 1.0);
}

/** A face from the line (x, z) a to the line b, along y from -extent to extent. */
static void add_strip(nook_verify_scene *scene, nook_fixture_mesh *mesh, const double a[2], const double b[2],
                      double extent)
{
    nook_verify_scene_face(scene, mesh, (double[]){ a[0], -extent, a[1] }, (double[]){ 0, 2 * extent, 0 },
                           (double[]){ b[0] - a[0], 0, b[1] - a[1] });
}

/** What cameras see beyond a wall: level ground at a height from x on, towards +x or -x. */
static void add_ground_beyond(nook_verify_scene *scene, double x, double height, double side)
{
    nook_fixture_add_quad(&scene->ground, (double[]){ x, -50, height }, (double[]){ side * 50, 0, 0 },
                          (double[]){ 0, 100, 0 });
}

void nook_verify_make_plane(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const char *const falloffs[] = { "hard", "linear", "exponential" };
    static const nook_falloff kinds[] = { NOOK_FALLOFF_HARD, NOOK_FALLOFF_LINEAR, NOOK_FALLOFF_EXPONENTIAL };
    snprintf(scene->point, sizeof scene->point, "%s", falloffs[point]);
    scene->falloff = kinds[point];
    nook_fixture_mesh *floor = nook_verify_scene_object(scene);
    nook_fixture_add_quad(floor, (double[]){ -extent, -extent, 0 }, (double[]){ 2 * extent, 0, 0 },
                          (double[]){ 0, 2 * extent, 0 });
    scene->height_field = true;
    look_from_above(scene);
    look_from_the_side(scene);
}

void nook_verify_make_ceiling(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double heights[] = { 0.4, 0.1, 0.9, 0.7 };
    (void)extent; /* what is beyond r_max does not count */
    double k = point < 16 ? heights[point / 4] : 0.4, tau = scene->tau;
    scene->falloff = point < 16 ? (nook_falloff[]){ NOOK_FALLOFF_HARD, NOOK_FALLOFF_LINEAR, NOOK_FALLOFF_QUADRATIC,
                                                    NOOK_FALLOFF_EXPONENTIAL }[point % 4]
                                : NOOK_FALLOFF_WENDLAND;
    snprintf(scene->point, sizeof scene->point, "k %g, %s", k, nook_verify_falloff_name(scene->falloff));
    nook_fixture_add_quad(nook_verify_scene_object(scene), (double[]){ -1.05, -1.05, k }, (double[]){ 2.1, 0, 0 },
                          (double[]){ 0, 2.1, 0 });
    nook_verify_scene_truth(scene, nook_form_ceiling(NOOK_FORM_COSINE, scene->falloff, tau, k),
                            nook_form_ceiling(NOOK_FORM_SOLID_ANGLE, scene->falloff, tau, k));
    nook_verify_scene_camera(scene, "beside", (double[]){ -1.5, 0, 0.5 * k }, 1.2);
    nook_verify_scene_camera(scene, "below it", (double[]){ 0, 0, 0.8 * k }, 1.0);
}

/** A hard falloff that cuts nothing: one half at any distance, were the wall infinite. */
static void make_wall_within_reach(double x, double extent, nook_verify_scene *scene)
{
    snprintf(scene->point, sizeof scene->point, "x %g, r_max beyond all", x);
    add_strip(scene, nook_verify_scene_object(scene), (double[]){ x, 0 }, (double[]){ x, extent }, extent);
    if (is_infinite(extent))
        nook_verify_scene_truth(scene, 0.5, 0.5);
    nook_verify_scene_reach_all(scene);
    add_ground_beyond(scene, x, extent, 1.0);
    scene->height_field = true;
    look_from_above(scene);
    nook_verify_scene_camera(scene, "oblique", (double[]){ -4, 0, 4 }, 1.1);
}

void nook_verify_make_wall(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double infinite[] = { 1.0, 0.01, 0.1 }, finite[] = { 1.0, 0.25, 0.5 };
    static const struct {
        nook_falloff falloff;
        double k;
    } points[] = { { NOOK_FALLOFF_HARD, 0.3 },     { NOOK_FALLOFF_LINEAR, 0.1 },    { NOOK_FALLOFF_QUADRATIC, 0.3 },
                   { NOOK_FALLOFF_HARD, 0.6 },     { NOOK_FALLOFF_HARD, 0.1 },      { NOOK_FALLOFF_LINEAR, 0.3 },
                   { NOOK_FALLOFF_LINEAR, 0.6 },   { NOOK_FALLOFF_QUADRATIC, 0.1 }, { NOOK_FALLOFF_QUADRATIC, 0.6 },
                   { NOOK_FALLOFF_WENDLAND, 0.1 }, { NOOK_FALLOFF_WENDLAND, 0.3 },  { NOOK_FALLOFF_WENDLAND, 0.6 } };
    if (point >= 12) {
        make_wall_within_reach(is_infinite(extent) ? infinite[point - 12] : finite[point - 12], extent, scene);
        return;
    }
    double k = points[point].k;
    scene->falloff = points[point].falloff;
    snprintf(scene->point, sizeof scene->point, "k %g, %s", k, nook_verify_falloff_name(scene->falloff));
    nook_fixture_add_quad(nook_verify_scene_object(scene), (double[]){ k, -1.05, 0 }, (double[]){ 0, 2.1, 0 },
                          (double[]){ 0, 0, 1.05 });
    nook_verify_scene_truth(scene, nook_form_wall(NOOK_FORM_COSINE, scene->falloff, k),
                            nook_form_wall(NOOK_FORM_SOLID_ANGLE, scene->falloff, k));
    add_ground_beyond(scene, k, 1.05, 1.0);
    scene->height_field = true;
    nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 3 }, 1.1);
    nook_verify_scene_camera(scene, "oblique", (double[]){ -2, 0, 3 }, 0.8);
}

void nook_verify_make_low_wall(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double sizes[][2] = { { 1, 1.5 }, { 0.5, 1 }, { 1, 0.5 }, { 0.3, 1.5 } };
    double x = sizes[point][0], height = sizes[point][1];
    snprintf(scene->point, sizeof scene->point, "x %g, height %g", x, height);
    add_strip(scene, nook_verify_scene_object(scene), (double[]){ x, 0 }, (double[]){ x, height }, extent);
    if (is_infinite(extent))
        nook_verify_scene_truth(scene, nook_form_low_wall(NOOK_FORM_COSINE, x, height),
                                nook_form_low_wall(NOOK_FORM_SOLID_ANGLE, x, height));
    nook_verify_scene_reach_all(scene);
    add_ground_beyond(scene, x, height, 1.0);
    scene->height_field = true;
    look_from_above(scene);
    look_from_the_side(scene);
}

void nook_verify_make_dihedral(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double angles[] = { 120, 90, 60, 150, 45 };
    double angle = angles[point] * NOOK_PI / 180, x = is_infinite(extent) ? 1.0 : 0.5;
    double length = is_infinite(extent) ? extent : 1.5, top[2] = { x - length * cos(angle), length * sin(angle) };
    snprintf(scene->point, sizeof scene->point, "%g degrees", angles[point]);
    add_strip(scene, nook_verify_scene_object(scene), (double[]){ x, 0 }, top, extent);
    if (is_infinite(extent))
        nook_verify_scene_truth(scene, nook_form_dihedral(NOOK_FORM_COSINE, angle),
                                nook_form_dihedral(NOOK_FORM_SOLID_ANGLE, angle));
    nook_verify_scene_reach_all(scene);
    scene->height_field = angles[point] >= 90;
    if (scene->height_field) {
        add_ground_beyond(scene, top[0], top[1], 1.0);
        look_from_above(scene);
        look_from_the_side(scene);
    } else {
        nook_verify_scene_camera(scene, "beside", (double[]){ -4, 0, 1.5 }, 1.0);
    }
}

void nook_verify_make_overhang(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double edges[][2] = { { 0.7, 1 }, { -0.5, 1 }, { 0, 0.5 } };
    double offset = edges[point][0], height = edges[point][1];
    snprintf(scene->point, sizeof scene->point, "offset %g, height %g", offset, height);
    add_strip(scene, nook_verify_scene_object(scene), edges[point], (double[]){ extent, height }, extent);
    if (is_infinite(extent))
        nook_verify_scene_truth(scene, nook_form_overhang(NOOK_FORM_COSINE, offset, height),
                                nook_form_overhang(NOOK_FORM_SOLID_ANGLE, offset, height));
    nook_verify_scene_reach_all(scene);
    if (offset > 0.0)
        nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 5 }, 1.1);
    nook_verify_scene_camera(scene, "beside", (double[]){ -4, 0, 0.5 * height }, 1.0);
}

void nook_verify_make_trench(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double sizes[][2] = { { 1.2, 1 }, { 2, 0.5 }, { 0.8, 1 } };
    double width = sizes[point][0], depth = sizes[point][1];
    snprintf(scene->point, sizeof scene->point, "width %g, depth %g", width, depth);
    nook_fixture_mesh *walls = nook_verify_scene_object(scene);
    for (double side = -1; side <= 1; side += 2) {
        double x = side * width / 2;
        add_strip(scene, walls, (double[]){ x, 0 }, (double[]){ x, depth }, extent);
        add_ground_beyond(scene, x, depth, side);
    }
    if (is_infinite(extent))
        nook_verify_scene_truth(scene, nook_form_trench(NOOK_FORM_COSINE, width, depth),
                                nook_form_trench(NOOK_FORM_SOLID_ANGLE, width, depth));
    nook_verify_scene_reach_all(scene);
    scene->height_field = true;
    look_from_above(scene);
}
