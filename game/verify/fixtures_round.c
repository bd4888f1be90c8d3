/* Fixtures 3 and 10 to 14: spheres, a pit, a disc. */
#include "engine/core/angle.h"
#include "game/verify/fixtures.h"
#include <math.h>
#include <stdio.h>

/* Corners lie on the round surface; what the chords lose is under 1e-3 of A. Of a sphere seen from inside the receiver's own facet must be
   smaller than a pixel, or it hides from the flattest rays what is nearest: with 64 sides A is 0.04 too small. */
enum { SIDES_TRACED = 256, SIDES_DRAWN = 64, SIDES_DRAWN_INSIDE = 128, SIDES_VOXELS = 128 };

static uint32_t sides_for(double extent)
{
    return extent >= NOOK_VERIFY_INFINITE ? SIDES_TRACED : extent >= NOOK_VERIFY_VOXELS ? SIDES_VOXELS : SIDES_DRAWN;
}

void nook_verify_make_sphere_inside(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const struct {
        nook_falloff falloff;
        double reach; /* r_max in diameters */
    } points[] = { { NOOK_FALLOFF_HARD, 0.75 },        { NOOK_FALLOFF_LINEAR, 0.75 }, { NOOK_FALLOFF_HARD, 0.3 },
                   { NOOK_FALLOFF_HARD, 1.5 },         { NOOK_FALLOFF_LINEAR, 2 },    { NOOK_FALLOFF_QUADRATIC, 0.75 },
                   { NOOK_FALLOFF_EXPONENTIAL, 0.75 }, { NOOK_FALLOFF_LINEAR, 0.3 },  { NOOK_FALLOFF_EXPONENTIAL, 2 } };
    const double tau = scene->tau, reach = points[point].reach;
    scene->falloff = points[point].falloff;
    snprintf(scene->point, sizeof scene->point, "K %g, %s", reach, nook_verify_falloff_name(scene->falloff));
    /* A hair inside: the receiver's plane would cut through the facets around the pole. */
    double lift = extent >= NOOK_VERIFY_INFINITE ? 1e-4 : 1e-3;
    uint32_t sides = sides_for(extent) < SIDES_DRAWN_INSIDE ? SIDES_DRAWN_INSIDE : sides_for(extent);
    nook_fixture_add_sphere(nook_verify_scene_object(scene), (double[]){ 0, 0, 1 - lift }, 1.0, sides);
    nook_fixture_mesh_free(&scene->ground);
    nook_verify_scene_truth(scene, nook_form_sphere_inside(NOOK_FORM_COSINE, scene->falloff, tau, reach),
                            nook_form_sphere_inside(NOOK_FORM_SOLID_ANGLE, scene->falloff, tau, reach));
    scene->r_max = 2.0 * reach;
    scene->height_field = true; /* of its lower half */
    nook_verify_scene_camera(scene, "inside", (double[]){ 0, 0, 1.6 }, 1.9);
}

void nook_verify_make_pit(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double sizes[][2] = { { 1, 1 }, { 1, 0.5 }, { 0.6, 1 }, { 1.5, 0.5 } };
    double radius = sizes[point][0], depth = sizes[point][1];
    uint32_t sides = sides_for(extent);
    snprintf(scene->point, sizeof scene->point, "radius %g, depth %g", radius, depth);
    nook_fixture_add_tube(nook_verify_scene_object(scene), radius, 0.0, depth, sides);
    for (uint32_t i = 0; i < sides; i++) { /* the ground around it */
        double a = 2 * NOOK_PI * i / sides, b = 2 * NOOK_PI * (i + 1) / sides;
        double p[3] = { radius * cos(a), radius * sin(a), depth }, q[3] = { radius * cos(b), radius * sin(b), depth };
        double r[3] = { 50 * cos(a), 50 * sin(a), depth }, s[3] = { 50 * cos(b), 50 * sin(b), depth };
        nook_fixture_add_triangle(&scene->ground, p, r, s);
        nook_fixture_add_triangle(&scene->ground, p, s, q);
    }
    nook_verify_scene_truth(scene, nook_form_pit(NOOK_FORM_COSINE, radius, depth),
                            nook_form_pit(NOOK_FORM_SOLID_ANGLE, radius, depth));
    nook_verify_scene_reach_all(scene);
    scene->height_field = true;
    nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 4 }, 1.0);
}

void nook_verify_make_disc(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double sizes[][2] = { { 0.8, 1 }, { 0.5, 1 }, { 2, 1 } };
    double radius = sizes[point][0], height = sizes[point][1];
    snprintf(scene->point, sizeof scene->point, "radius %g, height %g", radius, height);
    nook_fixture_add_disc(nook_verify_scene_object(scene), (double[]){ 0, 0, height }, radius, sides_for(extent));
    nook_verify_scene_truth(scene, nook_form_disc(NOOK_FORM_COSINE, radius, height),
                            nook_form_disc(NOOK_FORM_SOLID_ANGLE, radius, height));
    nook_verify_scene_reach_all(scene);
    double away =
        radius > 1.0
            ? 1.2
            : 2.5; /* from its edge: a wide one is a thin line from afar, a small one behind the eye from near */
    nook_verify_scene_camera(scene, "beside", (double[]){ -away - radius, 0, 0.3 * height }, 1.2);
    nook_verify_scene_camera(scene, "below it", (double[]){ 0, 0, 0.8 * height }, 1.1);
}

static void add_sphere(const double centre[3], double extent, nook_verify_scene *scene)
{
    double distance = hypot(hypot(centre[0], centre[1]), centre[2]), cosine = centre[2] / distance;
    nook_fixture_add_sphere(nook_verify_scene_object(scene), centre, 1.0, sides_for(extent));
    nook_verify_scene_truth(scene, nook_form_sphere(NOOK_FORM_COSINE, 1.0, distance, cosine),
                            nook_form_sphere(NOOK_FORM_SOLID_ANGLE, 1.0, distance, cosine));
    nook_verify_scene_reach_all(scene);
    scene->resolution = 128;
}

void nook_verify_make_sphere_above(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double centres[][3] = { { 0, 0, 1.5 }, { 1, 0, 1.5 }, { 0, 0, 3 } };
    snprintf(scene->point, sizeof scene->point, "centre (%g, 0, %g)", centres[point][0], centres[point][2]);
    add_sphere(centres[point], extent, scene);
    nook_verify_scene_camera(scene, "beside", (double[]){ -4, 0, 0.5 }, 1.2);
    nook_verify_scene_camera(scene, "below it", (double[]){ 0, 0, 0.4 }, 1.1);
}

void nook_verify_make_resting_ball(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double distances[] = { 1.3, 0.8, 2.5 };
    snprintf(scene->point, sizeof scene->point, "distance %g", distances[point]);
    add_sphere((double[]){ distances[point], 0, 1 }, extent, scene);
    if (distances[point] > 1.0)
        nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 6 }, 1.1);
    nook_verify_scene_camera(scene, "front", (double[]){ -4, 0, 1.5 }, 1.0);
}

void nook_verify_make_cut_sphere(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double centres[][3] = { { 1.5, 0, -0.3 }, { 1.5, 0, 0.4 }, { 1.2, 0, 0 }, { 1.6, 0, -0.7 } };
    snprintf(scene->point, sizeof scene->point, "centre (%g, 0, %g)", centres[point][0], centres[point][2]);
    add_sphere(centres[point], extent, scene);
    scene->height_field = centres[point][2] <= 0.0;
    nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 5 }, 1.1);
    nook_verify_scene_camera(scene, "oblique", (double[]){ -3, 0, 4 }, 1.0);
}
