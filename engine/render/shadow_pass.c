#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include <math.h>
#include <string.h>

/** A box in the sun's axes: x, y across, z away from the sun. In double: it is not relative to the camera, which moves. */
typedef struct sun_box {
    double low[3], high[3];
} sun_box;

/** Extends a box by that of a mesh. */
static void add_mesh(const nook_mesh *mesh, const nook_matrix *sun_from_mesh, sun_box *box)
{
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (i >> k & 1) ? mesh->bounds_max[k] : mesh->bounds_min[k];
        nook_matrix_apply_point(sun_from_mesh, p, p);
        for (int k = 0; k < 3; k++) {
            box->low[k] = fmin(box->low[k], p[k]);
            box->high[k] = fmax(box->high[k], p[k]);
        }
    }
}

/** The box of everything drawn. @return false: nothing is */
static bool box_of_draws(const nook_frame *frame, const nook_matrix *sun_from_world, sun_box *box)
{
    *box = (sun_box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (size_t i = 0; i < frame->draw_count; i++) {
        const nook_mesh *mesh = &frame->scene->scene->meshes[frame->draws[i].mesh];
        if (!(mesh->bounds_min[0] <= mesh->bounds_max[0]))
            continue;
        nook_matrix sun_from_mesh = nook_matrix_multiply(sun_from_world, &frame->draws[i].world_from_local);
        add_mesh(mesh, &sun_from_mesh, box);
    }
    return box->low[0] <= box->high[0] && isfinite(box->high[0] - box->low[0]);
}

/** The sun's axes: z away from the sun, so that depth grows along its light. */
static nook_matrix sun_axes(const nook_sun *sun)
{
    const double *d = sun->direction;
    const double zero[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 }, side[3] = { 1, 0, 0 };
    bool steep = fabs(d[1]) > 0.99 * nook_vector_length(d);
    nook_matrix view = nook_matrix_look_at(zero, d, steep ? side : up); /* looks along -z */
    nook_matrix flip = nook_matrix_scale(1.0, 1.0, -1.0);
    return nook_matrix_multiply(&flip, &view);
}

/** Fits the map to a box. @return map from sun: [0, 1]^3; *texel is a texel's width in metres */
static nook_matrix fit(const sun_box *box, double *texel)
{
    const double margin = 4.0; /* texels: the filter never reaches past the edge */
    double width = fmax(box->high[0] - box->low[0], box->high[1] - box->low[1]);
    double depth = box->high[2] - box->low[2];
    width = fmax(width, fmax(depth * 1e-3, 1e-6)) * SHADOW_SIZE / (SHADOW_SIZE - 2.0 * margin);
    *texel = width / SHADOW_SIZE;
    double spare = 4.0 * *texel;
    depth += 2.0 * spare;
    nook_matrix scale = nook_matrix_scale(1.0 / width, 1.0 / width, 1.0 / depth);
    nook_matrix move = nook_matrix_translation(0.5 * width - 0.5 * (box->low[0] + box->high[0]),
                                               0.5 * width - 0.5 * (box->low[1] + box->high[1]), spare - box->low[2]);
    return nook_matrix_multiply(&scale, &move);
}

static bool same_direction(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** Draws are compared as bytes: a difference that is none only costs a pass. */
static bool is_current(const shadow_contents *shadow, const nook_frame *frame)
{
    return shadow->scene == frame->scene && shadow->scene_created_ms == frame->scene->created_ms &&
           same_direction(shadow->sun_direction, frame->lights->sun.direction) &&
           shadow->draw_count == frame->draw_count &&
           (frame->draw_count == 0 ||
            memcmp(shadow->draws.items, frame->draws, frame->draw_count * sizeof *frame->draws) == 0);
}

static nook_result remember(shadow_contents *shadow, const nook_frame *frame)
{
    size_t size = frame->draw_count * sizeof *frame->draws;
    if (!nook_grow(&shadow->draws, size))
        return nook_fail(NOOK_E_MEMORY, "%zu draws: no memory to remember their shadows", frame->draw_count);
    if (size > 0)
        memcpy(shadow->draws.items, frame->draws, size);
    memcpy(shadow->sun_direction, frame->lights->sun.direction, sizeof shadow->sun_direction);
    shadow->draw_count = frame->draw_count;
    shadow->scene_created_ms = frame->scene->created_ms;
    shadow->scene = frame->scene;
    return NOOK_OK;
}

static nook_result draw_map(nook_renderer *renderer, const nook_frame *frame)
{
    const nook_gl *gl = renderer->gpu->gl;
    nook_matrix clip_from_map = nook_matrix_scale(2.0, 2.0, 1.0); /* x and y to [-1, 1] */
    clip_from_map.m[12] = clip_from_map.m[13] = -1.0;
    batch_view view = { .view_from_world = nook_matrix_multiply(&clip_from_map, &renderer->shadow.map_from_world) };
    nook_result result = nook_batch(renderer->gpu, frame, &view, &renderer->casters);
    if (result != NOOK_OK)
        return result;
    nook_raster_begin(renderer->gpu, renderer->shadow_target,
                      (raster_state){ .depth_compare = GL_LESS, .depth_write = true });
    const float far = 1.0f;
    gl->ClearNamedFramebufferfv(renderer->shadow_target.id, GL_DEPTH, 0, &far);
    nook_draw_solid(renderer, frame->scene, &renderer->casters, renderer->shadow_program,
                    renderer->shadow_masked_program, false);
    nook_raster_end(renderer->gpu);
    return remember(&renderer->shadow, frame);
}

/** The map as the shaders use it: from relative space. The camera moves, the map need not. */
static void set_uniforms(nook_renderer *renderer, const nook_camera *camera)
{
    double eye[3];
    nook_camera_position(camera, eye);
    nook_matrix world_from_relative = nook_matrix_translation(eye[0], eye[1], eye[2]);
    nook_matrix map_from_relative = nook_matrix_multiply(&renderer->shadow.map_from_world, &world_from_relative);
    nook_matrix_to_float(&map_from_relative, renderer->frame.shadow_from_relative);
    renderer->frame.shadow_texel = (float)renderer->shadow.texel;
}

nook_result nook_pass_shadow(nook_renderer *renderer, const nook_frame *frame)
{
    shadow_contents *shadow = &renderer->shadow;
    if (!nook_sun_shines(&frame->lights->sun))
        return NOOK_OK;
    nook_result result = NOOK_OK;
    if (!is_current(shadow, frame)) {
        nook_matrix sun_from_world = sun_axes(&frame->lights->sun);
        sun_box box;
        shadow->scene = NULL;
        if (!box_of_draws(frame, &sun_from_world, &box))
            return NOOK_OK; /* nothing is drawn: nobody looks into the map */
        nook_matrix map_from_sun = fit(&box, &shadow->texel);
        shadow->map_from_world = nook_matrix_multiply(&map_from_sun, &sun_from_world);
        result = draw_map(renderer, frame);
    }
    set_uniforms(renderer, &frame->camera);
    return result;
}
