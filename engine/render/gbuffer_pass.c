#include "engine/render/internal.h"

void nook_pass_gbuffer(nook_renderer *renderer, const nook_frame *frame)
{
    const nook_gl *gl = renderer->gpu->gl;
    const nook_framebuffer target = renderer->targets.gbuffer_target;
    const float zero[4] = { 0 };
    nook_raster_begin(renderer->gpu, target,
                      (raster_state){ .depth_compare = GL_GREATER, .depth_write = true, .cull = true, .srgb = true });
    for (GLint i = 0; i < 5; i++)
        gl->ClearNamedFramebufferfv(target.id, GL_COLOR, i, zero);
    gl->ClearNamedFramebufferfv(target.id, GL_DEPTH, 0, zero); /* reversed-Z: infinitely far */
    nook_draw_solid(renderer, frame->scene, &renderer->visible, renderer->gbuffer_program,
                    renderer->gbuffer_masked_program, frame->cull_back_faces);
    nook_raster_end(renderer->gpu);
}
