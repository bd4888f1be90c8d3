#include "game/extremes/edge_scene.h"
#include "game/techniques.h"
#include "modules/fixture/draw.h"
#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SIZE_USUAL = 48, RESOLUTION_USUAL = 64, RAYS_USUAL = 16, TECHNIQUES_MAX = 16 };
static const double R_MAX_USUAL = 0.8, Z_NEAR_USUAL = 0.1, FOV_Y = 0.8;

static double or_usual(double value, double usual)
{
    return value != 0.0 ? value : usual;
}

/* ---- Bodies ---- */

/** One of the four, in usual units. */
static void build_body(int body, nook_fixture_mesh *mesh)
{
    switch (body) {
    case 0:
        nook_fixture_add_quad(mesh, (double[]){ -2.5, -2.5, 0 }, (double[]){ 5, 0, 0 }, (double[]){ 0, 5, 0 });
        break;
    case 1:
        nook_fixture_add_box(mesh, (double[]){ -2.5, 1.5, 0 }, (double[]){ 2.5, 1.7, 1.6 }, 63);
        break;
    case 2:
        nook_fixture_add_box(mesh, (double[]){ -0.9, -0.4, 0 }, (double[]){ 0.1, 0.6, 0.8 }, 63);
        break;
    default:
        nook_fixture_add_sphere(mesh, (double[]){ 1.1, -0.5, 0.5 }, 0.5, 24);
    }
}

/** Where each body's own origin is. No power of two: matrices must hold more than floats can. */
static const double places[NOOK_EDGE_BODIES][3] = {
    { 0.1, -0.3, 0.0 }, { 0.0, 1.6, 0.8 }, { -0.4, 0.1, 0.4 }, { 1.1, -0.5, 0.5 }
};

static void shift_and_scale(nook_fixture_mesh *mesh, const double by[3], double scale)
{
    for (size_t i = 0; i < (size_t)mesh->vertex_count * 3; i++)
        mesh->positions[i] = (float)(mesh->positions[i] * scale + by[i % 3]);
}

static void append_placed(nook_fixture_mesh *mesh, const nook_fixture_mesh *part, const double place[3], double scale)
{
    for (uint32_t i = 0; i < part->index_count; i += 3) {
        double corner[3][3];
        for (uint32_t k = 0; k < 9; k++)
            corner[k / 3][k % 3] = part->positions[part->indices[i + k / 3] * 3 + k % 3] * scale + place[k % 3];
        nook_fixture_add_triangle(mesh, corner[0], corner[1], corner[2]);
    }
}

/** One body: about its own origin, its matrix takes it to its place. */
static nook_result add_body(nook_edge_scene *scene, const nook_edge_scene_desc *desc, int body)
{
    const double vertex_scale = or_usual(desc->vertex_scale, 1.0), matrix_scale = or_usual(desc->matrix_scale, 1.0);
    const double still[4] = { 0, 0, 0, 1 }, scale[3] = { matrix_scale, matrix_scale, matrix_scale };
    nook_fixture_mesh *mesh = &scene->bodies[body];
    double back[3], place[3], voxel_size;
    for (int axis = 0; axis < 3; axis++) {
        back[axis] = desc->vertex_offset[axis] - places[body][axis] * vertex_scale;
        place[axis] = places[body][axis] * scene->scale - desc->vertex_offset[axis] * matrix_scale;
    }
    const nook_matrix world_from_mesh = nook_matrix_compose(place, still, scale);
    build_body(body, mesh);
    shift_and_scale(mesh, back, vertex_scale);
    nook_result result = nook_fixture_view_add(
        scene->view, mesh, desc->resolution ? desc->resolution : RESOLUTION_USUAL, &world_from_mesh, &voxel_size);
    append_placed(&scene->world, mesh, place, matrix_scale);
    if (result == NOOK_OK)
        scene->voxel_size = fmax(scene->voxel_size, voxel_size * matrix_scale);
    return result;
}

static nook_result add_bodies(nook_edge_scene *scene, const nook_edge_scene_desc *desc)
{
    nook_result result = NOOK_OK;
    for (int body = 0; body < NOOK_EDGE_BODIES && result == NOOK_OK; body++)
        result = add_body(scene, desc, body);
    return result;
}

/* ---- Camera and parameters ---- */

static void place_camera(nook_edge_scene *scene, const nook_edge_scene_desc *desc)
{
    double eye[3] = { 2.2, -3.0, 2.2 }, target[3] = { 0.1, 0.2, 0.3 };
    const double up[3] = { 0, 0, 1 };
    nook_fixture_view *view = scene->view;
    for (int axis = 0; axis < 3; axis++)
        eye[axis] *= scene->scale, target[axis] *= scene->scale;
    const nook_fixture_projection projection = { .fov_y_radians = FOV_Y,
                                                 .aspect = (double)view->width / view->height,
                                                 .z_near = or_usual(desc->z_near, Z_NEAR_USUAL) * scene->scale,
                                                 .z_far = desc->z_far * scene->scale,
                                                 .normal_z = desc->normal_z };
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    view->clip_from_view = nook_fixture_projection_matrix(&projection);
    if (desc->rows_down)
        view->clip_from_view.m[5] = -view->clip_from_view.m[5];
}

static nook_result set_params(nook_edge_scene *scene)
{
    nook_ao *ao = scene->view->ao;
    nook_result result = nook_edge_scene_reach(scene, R_MAX_USUAL);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "volume.rays", RAYS_USUAL);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "reference.rays", RAYS_USUAL);
    return result;
}

nook_result nook_edge_scene_reach(nook_edge_scene *scene, double r_max)
{
    return nook_ao_set_param(scene->view->ao, "ao.r_max", r_max * scene->scale);
}

nook_result nook_edge_scene_draw(nook_edge_scene *scene)
{
    nook_fixture_view_clear(scene->view);
    return nook_fixture_view_draw(scene->view, &scene->world);
}

/* ---- Making it ---- */

static nook_result open_view(const nook_extremes *extremes, const nook_edge_scene_desc *desc, nook_edge_scene *scene)
{
    size_t count;
    const nook_ao_technique *const *ours = nook_techniques(&count);
    const nook_ao_technique *techniques[TECHNIQUES_MAX + 1];
    assert(count <= TECHNIQUES_MAX);
    for (size_t i = 0; i < count; i++)
        techniques[i] = ours[i];
    if (desc->technique)
        techniques[count++] = desc->technique;
    const nook_fixture_view_desc view = { .gpu = extremes->gpu,
                                          .width = desc->width ? desc->width : SIZE_USUAL,
                                          .height = desc->height ? desc->height : SIZE_USUAL,
                                          .techniques = techniques,
                                          .technique_count = count,
                                          .depth_format = desc->depth_format,
                                          .normal_format = desc->normal_format,
                                          .progress_user = desc->user,
                                          .cache_dir = extremes->scratch };
    nook_result result = nook_fixture_view_create(&view, &scene->view);
    if (result != NOOK_OK)
        return result;
    scene->view->index = desc->frame_index;
    scene->pixels = (size_t)view.width * view.height;
    return NOOK_OK;
}

nook_result nook_edge_scene_make(const nook_extremes *extremes, const nook_edge_scene_desc *desc,
                                 nook_edge_scene *out_scene)
{
    nook_edge_scene scene = { .scale = or_usual(desc->vertex_scale, 1.0) * or_usual(desc->matrix_scale, 1.0) };
    scene.diagonal = sqrt(5.0 * 5.0 + 5.0 * 5.0 + 1.6 * 1.6) * scene.scale;
    *out_scene = (nook_edge_scene){ 0 };
    nook_result result = open_view(extremes, desc, &scene);
    if (result == NOOK_OK)
        result = add_bodies(&scene, desc);
    if (result == NOOK_OK)
        result = set_params(&scene);
    if (result == NOOK_OK) {
        place_camera(&scene, desc);
        result = nook_edge_scene_draw(&scene);
    }
    if (result != NOOK_OK) {
        nook_edge_scene_free(&scene);
        return result;
    }
    *out_scene = scene;
    return NOOK_OK;
}

void nook_edge_scene_free(nook_edge_scene *scene)
{
    nook_fixture_view_destroy(scene->view);
    nook_fixture_mesh_free(&scene->world);
    for (int body = 0; body < NOOK_EDGE_BODIES; body++)
        nook_fixture_mesh_free(&scene->bodies[body]);
    *scene = (nook_edge_scene){ 0 };
}

void nook_edge_scene_move(nook_edge_scene *scene, const nook_matrix *move)
{
    nook_fixture_view *view = scene->view;
    nook_matrix back;
    nook_matrix_inverse_affine(move, &back);
    view->view_from_world = nook_matrix_multiply(&view->view_from_world, &back);
    for (uint32_t i = 0; i < view->occluder_count; i++) {
        nook_matrix world_from_mesh;
        memcpy(world_from_mesh.m, view->occluders[i].world_from_mesh, sizeof world_from_mesh.m);
        world_from_mesh = nook_matrix_multiply(move, &world_from_mesh);
        memcpy(view->occluders[i].world_from_mesh, world_from_mesh.m, sizeof world_from_mesh.m);
    }
    for (size_t i = 0; i < scene->pixels; i++) {
        double normal[3];
        nook_fixture_decode_normal(view->normals[i], normal);
        nook_matrix_apply_vector(move, normal, normal);
        nook_fixture_encode_normal(normal, view->normals[i]);
    }
}

/** The technique, with the kind of volumes that the name asks for; the one before is set again. */
static nook_result record_with_kind(nook_fixture_view *view, const char *estimator)
{
    char technique[NOOK_EDGE_ESTIMATOR_NAME_MAX], name[NOOK_EDGE_ESTIMATOR_NAME_MAX + 8];
    const char *kind = nook_edge_estimator_split(estimator, technique);
    double before = 0.0;
    snprintf(name, sizeof name, "%s.kind", technique);
    nook_result result = kind ? nook_ao_get_param(view->ao, name, &before) : NOOK_OK;
    if (result == NOOK_OK && kind)
        result = nook_ao_parse_param(view->ao, name, kind);
    if (result == NOOK_OK)
        result = nook_fixture_view_record(view, technique);
    nook_result restored = kind ? nook_ao_set_param(view->ao, name, before) : NOOK_OK;
    return result == NOOK_OK ? restored : result;
}

nook_result nook_edge_scene_record(nook_edge_scene *scene, const char *estimator, nook_extreme_found *found,
                                   const char *format, ...)
{
    char where[160];
    va_list arguments;
    nook_result result = record_with_kind(scene->view, estimator);
    if (result != NOOK_OK)
        return result;
    va_start(arguments, format);
    vsnprintf(where, sizeof where, format, arguments);
    va_end(arguments);
    nook_extreme_check_view(found, scene->view, "%s, %s", estimator, where);
    return NOOK_OK;
}

nook_result nook_edge_scene_record_all(nook_edge_scene *scene, nook_extreme_found *found, const char *what)
{
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    const size_t count = nook_edge_estimators(estimators);
    nook_result result = NOOK_OK;
    for (size_t i = 0; result == NOOK_OK && i < count; i++)
        result = nook_edge_scene_record(scene, estimators[i].name, found, "%s", what);
    nook_extreme_worst(found, (double)found->outside, "%s", what);
    return result;
}
