#include "game/verify/scene.h"
#include "engine/core/vector.h"
#include "game/verify/fixtures.h"
#include <assert.h>
#include <math.h>

static const nook_verify_fixture fixtures[] = {
#define NOOK_VERIFY_FIXTURE(row, name, points, camera_points, quick_points, what) \
    { #name, what, nook_verify_make_##name, row, points, camera_points, quick_points },
#include "game/verify/fixtures.def"
#undef NOOK_VERIFY_FIXTURE
};

const nook_verify_fixture *nook_verify_fixtures(size_t *out_count)
{
    *out_count = sizeof fixtures / sizeof *fixtures;
    return fixtures;
}

/** Wide enough to fill every picture. */
static void add_floor(nook_fixture_mesh *mesh)
{
    nook_fixture_add_quad(mesh, (double[]){ -50, -50, 0 }, (double[]){ 100, 0, 0 }, (double[]){ 0, 100, 0 });
}

void nook_verify_scene_make(const nook_verify_fixture *fixture, uint32_t point, double extent,
                            nook_verify_scene *out_scene)
{
    assert(point < fixture->points);
    *out_scene = (nook_verify_scene){ .r_max = 1.0, .tau = 3.0, .resolution = 256 };
    add_floor(&out_scene->ground);
    fixture->make(point, extent, out_scene);
}

void nook_verify_scene_free(nook_verify_scene *scene)
{
    for (uint32_t i = 0; i < scene->object_count; i++)
        nook_fixture_mesh_free(&scene->objects[i]);
    nook_fixture_mesh_free(&scene->ground);
}

nook_fixture_mesh *nook_verify_scene_object(nook_verify_scene *scene)
{
    assert(scene->object_count < NOOK_VERIFY_OBJECTS_MAX);
    return &scene->objects[scene->object_count++];
}

void nook_verify_scene_face(nook_verify_scene *scene, nook_fixture_mesh *object, const double corner[3],
                            const double edge_u[3], const double edge_v[3])
{
    double points[4][3];
    for (int axis = 0; axis < 3; axis++) {
        points[0][axis] = corner[axis];
        points[1][axis] = corner[axis] + edge_u[axis];
        points[2][axis] = points[1][axis] + edge_v[axis];
        points[3][axis] = corner[axis] + edge_v[axis];
    }
    nook_fixture_add_quad(object, corner, edge_u, edge_v);
    for (int weight = 0; weight < 2; weight++)
        scene->truth[weight] += nook_form_polygon((nook_form_weight)weight, (const double(*)[3])points, 4);
}

void nook_verify_scene_truth(nook_verify_scene *scene, double cosine, double solid_angle)
{
    scene->truth[NOOK_FORM_COSINE] = cosine;
    scene->truth[NOOK_FORM_SOLID_ANGLE] = solid_angle;
}

void nook_verify_scene_reach_all(nook_verify_scene *scene)
{
    double farthest = 0.0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const nook_fixture_mesh *mesh = &scene->objects[i];
        for (size_t k = 0; k < mesh->vertex_count; k++) {
            const float *p = mesh->positions + 3 * k;
            farthest = fmax(farthest, nook_vector_length((double[]){ p[0], p[1], p[2] }));
        }
    }
    scene->r_max = 1.2 * farthest;
}

void nook_verify_scene_camera(nook_verify_scene *scene, const char *name, const double eye[3], double angle)
{
    uint32_t i = 0;
    while (scene->cameras[i].name)
        i++;
    assert(i < NOOK_VERIFY_CAMERAS_MAX);
    scene->cameras[i] = (nook_verify_camera){ .name = name, .eye = { eye[0], eye[1], eye[2] }, .angle = angle };
}

nook_matrix nook_verify_camera_matrix(const nook_verify_camera *camera)
{
    const double *eye = camera->eye;
    bool from_above = hypot(eye[0], eye[1]) < 1e-3 * fabs(eye[2]);
    return nook_matrix_look_at(eye, (double[]){ 0, 0, 0 }, (double[]){ 0, from_above, !from_above });
}

const char *nook_verify_falloff_name(nook_falloff falloff)
{
    static const char *const names[] = { "hard", "linear", "quadratic", "wendland", "exponential" };
    return names[falloff];
}
