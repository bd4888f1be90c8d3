#include "engine/render/internal.h"
#include <stdio.h>

enum { DEFINES_SIZE = 128 };

/** What a round of the pass draws. */
typedef struct gbuffer_round {
    const nook_frame *frame;
    bool emits; /* materials that do, or those that do not */
} gbuffer_round;

/** Quick frames keep sRGB as it is stored, from the image to the G-buffer. */
static bool is_encoded(const nook_renderer *renderer, const nook_frame *frame)
{
    return frame->quick && renderer->gpu->skips_srgb_decode;
}

/** The program that a material's images and the frame ask for, compiled when the first comes that asks so. */
static nook_program choose_program(nook_renderer *renderer, const void *user, const render_material *material,
                                   bool masked)
{
    const gbuffer_round *round = user;
    const nook_frame *frame = round->frame;
    uint32_t kind = (masked ? GBUFFER_MASKED : 0u) | (frame->quick ? GBUFFER_QUICK : 0u) |
                    (frame->scene->has_tangents && !frame->quick ? 0u : GBUFFER_NO_TANGENTS) |
                    (frame->quick && !frame->scene->has_colours ? GBUFFER_NO_COLOURS : 0u);
    nook_program *program = &renderer->gbuffer_programs[kind][material->image_set];
    if (material->emits != round->emits)
        return (nook_program){ 0 };
    if (program->handle != 0)
        return *program;
    char defines[DEFINES_SIZE];
    snprintf(defines, sizeof defines, "#define IMAGES %uu\n%s%s%s%s%s", material->image_set,
             kind & GBUFFER_MASKED ? "#define MASKED\n" : "", kind & GBUFFER_QUICK ? "#define QUICK\n" : "",
             is_encoded(renderer, frame) ? "#define ENCODED\n" : "",
             kind & GBUFFER_NO_TANGENTS ? "#define NO_TANGENTS\n" : "",
             kind & GBUFFER_NO_COLOURS ? "#define NO_COLOURS\n" : "");
    if (nook_program_raster(renderer->gpu, "shaders/render/surface.vert.glsl", "shaders/render/gbuffer.frag.glsl",
                            defines, program) != NOOK_OK)
        return masked ? renderer->gbuffer_masked_program : renderer->gbuffer_program;
    return *program;
}

/** @param list  of what is to be drawn; NULL: all */
static void draw_round(nook_renderer *renderer, const nook_frame *frame, bool emits, nook_framebuffer target,
                       const index_list *list)
{
    const gbuffer_round round = { frame, emits };
    const draw_set *set = &renderer->visible;
    nook_raster_begin(
        renderer->gpu, target,
        (raster_state){
            .depth_compare = GL_GREATER, .depth_write = true, .cull = true, .srgb = !is_encoded(renderer, frame) });
    if (list)
        nook_draw_listed(renderer, frame->scene, set, choose_program, &round, frame->cull_back_faces, list,
                         renderer->cull.first_range.items);
    else
        nook_draw_solid(renderer, frame->scene, set, choose_program, &round, frame->cull_back_faces);
}

/* Emission is 0 nearly everywhere, and writing it costs a software driver a fifteenth of a picture: only what emits does, after all
   else, so that nothing in front of it would have to write 0 over it. */
static void draw_rounds(nook_renderer *renderer, const nook_frame *frame, const index_list *list)
{
    draw_round(renderer, frame, false, renderer->targets.dark_gbuffer_target, list);
    draw_round(renderer, frame, true, renderer->targets.gbuffer_target, list);
}

/** What showed in the last frame, then what else shows: that may cover what emits. */
static void draw_culled(nook_renderer *renderer, const nook_frame *frame)
{
    const triangle_cull *cull = &renderer->cull;
    const nook_framebuffer target = renderer->targets.gbuffer_target;
    draw_rounds(renderer, frame, &cull->kept);
    renderer->gpu->gl->Flush(); /* pixels are filled while triangles are found */
    nook_cull_find(renderer, frame);
    nook_cull_list(renderer, frame);
    if (cull->rest.count > 0) {
        draw_round(renderer, frame, false, target, &cull->rest);
        draw_round(renderer, frame, true, target, &cull->rest);
    }
}

void nook_pass_gbuffer(nook_renderer *renderer, const nook_frame *frame)
{
    const nook_gl *gl = renderer->gpu->gl;
    const nook_framebuffer target = renderer->targets.gbuffer_target;
    const float zero[4] = { 0 };
    for (GLint i = 0; i < 5; i++)
        gl->ClearNamedFramebufferfv(target.id, GL_COLOR, i, zero);
    gl->ClearNamedFramebufferfv(target.id, GL_DEPTH, 0, zero); /* reversed-Z: infinitely far */
    for (GLuint i = 0; i < MATERIAL_IMAGES && frame->quick; i++)
        gl->BindSampler(i, renderer->quick_sampler);
    if (renderer->cull.on)
        draw_culled(renderer, frame);
    else
        draw_rounds(renderer, frame, NULL);
    for (GLuint i = 0; i < MATERIAL_IMAGES; i++)
        gl->BindSampler(i, 0);
    nook_raster_end(renderer->gpu);
}
