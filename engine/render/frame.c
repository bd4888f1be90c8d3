/* The frame, in order. docs/rendering.md tells what each pass reads and writes. */
#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <assert.h>
#include <math.h>

static nook_result check(const nook_frame *frame)
{
    const nook_camera *camera = &frame->camera;
    for (int i = 0; i < 16; i++) {
        if (!isfinite(camera->view_from_world.m[i]))
            return nook_fail(NOOK_E_ARG, "camera: its matrix is not finite; look from and to different points");
    }
    if (!(camera->z_near > 0.0) || !isfinite(camera->z_near))
        return nook_fail(NOOK_E_ARG, "camera: z_near %g; give a number above 0", camera->z_near);
    if (!(camera->fov_y_radians > 0.0 && camera->fov_y_radians < 3.1415))
        return nook_fail(NOOK_E_ARG, "camera: field of view %g; give radians between 0 and pi", camera->fov_y_radians);
    if (frame->lights->point_count > NOOK_MAX_POINT_LIGHTS)
        return nook_fail(NOOK_E_ARG, "lights: %u points; at most %u", frame->lights->point_count,
                         NOOK_MAX_POINT_LIGHTS);
    if (frame->draw_count >= NOOK_NONE)
        return nook_fail(NOOK_E_ARG, "%zu draws; at most %u", frame->draw_count, NOOK_NONE - 1);
    for (size_t i = 0; i < frame->draw_count; i++) {
        if (frame->draws[i].mesh >= frame->scene->scene->mesh_count)
            return nook_fail(NOOK_E_ARG, "draw %zu: mesh %u of %u", i, frame->draws[i].mesh,
                             frame->scene->scene->mesh_count);
    }
    return NOOK_OK;
}

/** Which draws the camera sees, as instances, and those of them that blend. */
static nook_result collect_visible(nook_renderer *renderer, const nook_frame *frame)
{
    batch_view view = {
        .view_from_world = frame->camera.view_from_world,
        .cull = true,
        .clip_from_view = nook_renderer_clip_from_view(renderer, &frame->camera),
        .z_near = frame->camera.z_near,
        .by_end = frame->quick,
    };
    nook_result result = nook_batch(renderer->gpu, frame, &view, &renderer->visible);
    if (result == NOOK_OK)
        result = nook_cull_begin(renderer, frame);
    if (result == NOOK_OK)
        result = nook_collect_blended(renderer, frame);
    return result;
}

nook_result nook_frame_shadow(nook_renderer *renderer, const nook_frame *frame)
{
    nook_result result = check(frame);
    if (result == NOOK_OK)
        nook_render_scene_pose(frame->scene, frame->poses, frame->pose_version);
    if (result == NOOK_OK)
        result = collect_visible(renderer, frame);
    return result == NOOK_OK ? nook_pass_shadow(renderer, frame) : result;
}

void nook_frame_gbuffer(nook_renderer *renderer, const nook_frame *frame)
{
    nook_uniforms_frame(renderer, frame);
    nook_uniforms_lights(renderer, frame);
    nook_pass_gbuffer(renderer, frame);
}

nook_result nook_frame_begin(nook_renderer *renderer, const nook_frame *frame)
{
    nook_result result = nook_frame_shadow(renderer, frame);
    if (result == NOOK_OK)
        nook_frame_gbuffer(renderer, frame);
    return result;
}

void nook_frame_finish_part(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, nook_view view,
                            nook_rectangle part)
{
    assert(part.x <= renderer->width && part.width <= renderer->width - part.x && part.y <= renderer->height &&
           part.height <= renderer->height - part.y && (part.width == 0) == (part.height == 0));
    bool lights = view == NOOK_VIEW_LIT || view == NOOK_VIEW_LIGHT;
    bool at_once = view == NOOK_VIEW_LIT && renderer->blended_count == 0;
    if (lights)
        nook_pass_lighting(renderer, frame, visibility, at_once, part);
    if (lights && !at_once)
        nook_pass_blended(renderer, frame, part);
    if (!at_once)
        nook_pass_view(renderer, visibility, view, part);
}

void nook_frame_finish(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, nook_view view)
{
    nook_frame_finish_part(renderer, frame, visibility, view, (nook_rectangle){ 0 });
}
