#include "game/extremes/edge_render.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The bodies as a scene ---- */

/** All bodies' corners one after another, as one mesh. */
static nook_result join_bodies(const nook_edge_scene *scene, nook_scene **out_scene)
{
    size_t vertices = 0, indices = 0;
    for (int body = 0; body < NOOK_EDGE_BODIES; body++)
        vertices += scene->bodies[body].vertex_count, indices += scene->bodies[body].index_count;
    float *positions = malloc(3 * vertices * sizeof *positions);
    uint32_t *order = malloc(indices * sizeof *order), first = 0;
    if (!positions || !order) {
        free(positions);
        free(order);
        return nook_fail(NOOK_E_MEMORY, "extremes: no room for %zu vertices to draw", vertices);
    }
    indices = 0;
    for (int body = 0; body < NOOK_EDGE_BODIES; body++) {
        const nook_fixture_mesh *mesh = &scene->bodies[body];
        memcpy(positions + 3 * (size_t)first, mesh->positions, 3 * mesh->vertex_count * sizeof *positions);
        for (uint32_t i = 0; i < mesh->index_count; i++)
            order[indices++] = first + mesh->indices[i];
        first += mesh->vertex_count;
    }
    nook_result result =
        nook_scene_from_triangles("bodies", positions, (uint32_t)vertices, order, (uint32_t)indices, out_scene);
    free(positions);
    free(order);
    return result;
}

static void set_bounds(nook_mesh *mesh, const nook_fixture_mesh *body)
{
    for (int axis = 0; axis < 3; axis++) {
        mesh->bounds_min[axis] = INFINITY, mesh->bounds_max[axis] = -INFINITY;
        for (uint32_t i = 0; i < body->vertex_count; i++) {
            const float at = body->positions[3 * i + (uint32_t)axis];
            mesh->bounds_min[axis] = fminf(mesh->bounds_min[axis], at);
            mesh->bounds_max[axis] = fmaxf(mesh->bounds_max[axis], at);
        }
    }
}

/** A mesh for each body again: a run of the joined indices. */
static void split_bodies(nook_edge_render *render, const nook_edge_scene *scene)
{
    uint32_t first = 0;
    render->scene = *render->all;
    render->scene.primitives = render->primitives;
    render->scene.meshes = render->meshes;
    render->scene.primitive_count = render->scene.mesh_count = NOOK_EDGE_BODIES;
    for (uint32_t body = 0; body < NOOK_EDGE_BODIES; body++) {
        const uint32_t count = scene->bodies[body].index_count;
        render->primitives[body] = render->all->primitives[0];
        render->primitives[body].first_index = first;
        render->primitives[body].index_count = count;
        render->meshes[body] = (nook_mesh){ .name = "body", .first_primitive = body, .primitive_count = 1 };
        set_bounds(&render->meshes[body], &scene->bodies[body]);
        first += count;
    }
}

/* ---- Drawing them ---- */

nook_result nook_edge_render_make(const nook_extremes *extremes, const nook_edge_scene *scene,
                                  nook_edge_render *out_render)
{
    *out_render = (nook_edge_render){ .gpu = extremes->gpu };
    nook_result result = join_bodies(scene, &out_render->all);
    if (result == NOOK_OK) {
        split_bodies(out_render, scene);
        result = nook_render_scene_create(extremes->gpu, &out_render->scene, &out_render->uploaded);
    }
    if (result == NOOK_OK)
        result = nook_renderer_create(extremes->gpu, scene->view->width, scene->view->height, &out_render->renderer);
    if (result != NOOK_OK)
        nook_edge_render_free(out_render);
    return result;
}

void nook_edge_render_free(nook_edge_render *render)
{
    nook_renderer_destroy(render->renderer);
    nook_render_scene_destroy(render->uploaded);
    nook_scene_destroy(render->all);
    *render = (nook_edge_render){ 0 };
}

/** What the view's projection is made from, as the renderer wants it. */
static nook_camera camera_of(const nook_fixture_view *view)
{
    return (nook_camera){ .view_from_world = view->view_from_world,
                          .fov_y_radians = 2.0 * atan(1.0 / view->clip_from_view.m[5]),
                          .z_near = view->clip_from_view.m[14] };
}

nook_result nook_edge_render_draw(nook_edge_render *render, nook_edge_scene *scene)
{
    nook_fixture_view *view = scene->view;
    nook_lights dark = nook_lights_default();
    nook_draw draws[NOOK_EDGE_BODIES];
    memset(dark.sun.colour, 0, sizeof dark.sun.colour); /* no shadow map */
    for (uint32_t body = 0; body < NOOK_EDGE_BODIES; body++) {
        draws[body] = (nook_draw){ .mesh = body };
        memcpy(draws[body].world_from_local.m, view->occluders[body].world_from_mesh,
               sizeof draws[body].world_from_local.m);
    }
    const nook_frame frame = { .scene = render->uploaded,
                               .draws = draws,
                               .draw_count = NOOK_EDGE_BODIES,
                               .camera = camera_of(view),
                               .lights = &dark };
    nook_result result = nook_frame_begin(render->renderer, &frame);
    if (result != NOOK_OK)
        return result;
    const nook_gbuffer gbuffer = nook_renderer_gbuffer(render->renderer);
    view->clip_from_view = nook_renderer_clip_from_view(render->renderer, &frame.camera);
    nook_texture_read(render->gpu, gbuffer.depth, GL_DEPTH_COMPONENT, GL_FLOAT, view->device_depth,
                      scene->pixels * sizeof *view->device_depth);
    nook_texture_read(render->gpu, gbuffer.geometric_normal, GL_RG, GL_FLOAT, view->normals,
                      scene->pixels * sizeof *view->normals);
    return NOOK_OK;
}
