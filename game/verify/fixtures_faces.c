/* Fixtures 2 and 15 to 17: rectangles, boxes and other polygons. */
#include "game/verify/fixtures.h"
#include <stdio.h>

void nook_verify_make_closed_box(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const double low[][3] = { { -1, -0.7, 0 }, { -0.5, -0.5, 0 } };
    static const double high[][3] = { { 0.4, 1, 2 }, { 0.5, 0.5, 1 } };
    (void)extent;
    snprintf(scene->point, sizeof scene->point, "%s", point ? "cube" : "off its middle");
    nook_fixture_add_box(nook_verify_scene_object(scene), low[point], high[point], 63);
    nook_fixture_mesh_free(&scene->ground);
    nook_verify_scene_truth(scene, 1.0, 1.0);
    nook_verify_scene_reach_all(scene);
    scene->resolution = 128;
    nook_verify_scene_camera(scene, "inside", (double[]){ 0, 0, 0.9 * high[point][2] }, 2.2);
}

static const double rectangles[][3] = { { 1.2, 0.7, 0.9 }, { 1, 1, 0.5 }, { 0.5, 1.5, 1 } };

void nook_verify_make_level_rectangle(uint32_t point, double extent, nook_verify_scene *scene)
{
    double a = rectangles[point][0], b = rectangles[point][1], c = rectangles[point][2];
    (void)extent;
    snprintf(scene->point, sizeof scene->point, "%g x %g at height %g", a, b, c);
    nook_fixture_add_quad(nook_verify_scene_object(scene), (double[]){ 0, 0, c }, (double[]){ a, 0, 0 },
                          (double[]){ 0, b, 0 });
    nook_verify_scene_truth(scene, nook_form_level_rectangle(NOOK_FORM_COSINE, a, b, c),
                            nook_form_level_rectangle(NOOK_FORM_SOLID_ANGLE, a, b, c));
    nook_verify_scene_reach_all(scene);
    nook_verify_scene_camera(scene, "above", (double[]){ -1, -1, 5 }, 1.1);
    nook_verify_scene_camera(scene, "beside", (double[]){ -2.5, -2.5, 0.3 * c }, 1.1);
}

void nook_verify_make_upright_rectangle(uint32_t point, double extent, nook_verify_scene *scene)
{
    double a = rectangles[point][0], b = rectangles[point][1], c = rectangles[point][2];
    (void)extent;
    snprintf(scene->point, sizeof scene->point, "%g wide, %g high at %g", b, a, c);
    nook_fixture_add_quad(nook_verify_scene_object(scene), (double[]){ c, 0, 0 }, (double[]){ 0, b, 0 },
                          (double[]){ 0, 0, a });
    nook_verify_scene_truth(scene, nook_form_upright_rectangle(NOOK_FORM_COSINE, b, a, c),
                            nook_form_upright_rectangle(NOOK_FORM_SOLID_ANGLE, b, a, c));
    nook_verify_scene_reach_all(scene);
    nook_fixture_add_box(&scene->ground, (double[]){ c, 0, 0 }, (double[]){ c + 50, b, a }, 62); /* all but its front */
    scene->height_field = true;
    nook_verify_scene_camera(scene, "above", (double[]){ 0, 0, 5 }, 1.1);
    nook_verify_scene_camera(scene, "oblique", (double[]){ -3, 0, 4 }, 1.0);
}

static void make_cube(unsigned faces, nook_verify_scene *scene)
{
    static const double low[3] = { -0.5, -0.5, 0 }, high[3] = { 0.5, 0.5, 1 };
    for (unsigned face = 0; face < 6; face++) { /* one object each: together they must not count twice */
        if (!(faces >> face & 1))
            continue;
        nook_fixture_mesh *object = nook_verify_scene_object(scene);
        int axis = (int)face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corner[3] = { low[0], low[1], low[2] }, edge_u[3] = { 0, 0, 0 }, edge_v[3] = { 0, 0, 0 };
        corner[axis] = face & 1 ? high[axis] : low[axis];
        edge_u[u] = 1.0, edge_v[v] = 1.0;
        nook_verify_scene_face(scene, object, corner, edge_u, edge_v);
    }
}

/** A leaning face that goes through the floor. */
static void make_leaning(nook_verify_scene *scene)
{
    nook_verify_scene_face(scene, nook_verify_scene_object(scene), (double[]){ 0.9, -0.6, -0.5 },
                           (double[]){ -0.2, 1.1, 0.3 }, (double[]){ -0.1, 0.4, 1.5 });
}

/** Level ground from the upper edges of the cube's walls on: for cameras they are the sides of a shaft. */
static void add_ground_around(nook_verify_scene *scene)
{
    for (int side = -1; side <= 1; side += 2) {
        nook_fixture_add_quad(&scene->ground, (double[]){ side * 0.5, -50, 1 }, (double[]){ side * 50, 0, 0 },
                              (double[]){ 0, 100, 0 });
        nook_fixture_add_quad(&scene->ground, (double[]){ -0.5, side * 0.5, 1 }, (double[]){ 1, 0, 0 },
                              (double[]){ 0, side * 50, 0 });
    }
}

void nook_verify_make_polygons(uint32_t point, double extent, nook_verify_scene *scene)
{
    static const char *const names[] = { "cube, one wall", "cube, all but floor", "cube, ceiling", "cube, four walls",
                                         "leaning, cut by the floor" };
    static const unsigned faces[] = { 2, 47, 32, 15, 0 };
    (void)extent;
    snprintf(scene->point, sizeof scene->point, "%s", names[point]);
    if (point < 4)
        make_cube(faces[point], scene);
    else
        make_leaning(scene);
    nook_verify_scene_reach_all(scene);
    scene->height_field = point == 0 || point == 3;
    if (point == 3)
        add_ground_around(scene);
    bool covered = point == 1 || point == 2;
    nook_verify_scene_camera(scene, covered ? "inside" : "above", (double[]){ 0, 0, covered ? 0.9 : 4 },
                             covered ? 2.2 : 0.8);
    if (point == 0)
        nook_verify_scene_camera(scene, "oblique", (double[]){ -2.5, 0, 3 }, 0.8);
}
