#include "engine/render/internal.h"

/** What lighting and the views read: the G-buffer, the shadow and the visibility. */
static void bind_inputs(nook_renderer *renderer, nook_texture visibility)
{
    nook_gpu *gpu = renderer->gpu;
    const nook_gbuffer *g = &renderer->targets.gbuffer;
    nook_bind_uniform(gpu, UNIFORM_FRAME, renderer->frame_uniforms);
    nook_bind_uniform(gpu, UNIFORM_LIGHTS, renderer->light_uniforms);
    nook_bind_texture(gpu, UNIT_SHADOW, renderer->shadow_map);
    nook_bind_texture(gpu, UNIT_BASE_COLOUR, g->base_colour);
    nook_bind_texture(gpu, UNIT_NORMAL, g->normal);
    nook_bind_texture(gpu, UNIT_GEOMETRIC_NORMAL, g->geometric_normal);
    nook_bind_texture(gpu, UNIT_MATERIAL, g->material);
    nook_bind_texture(gpu, UNIT_EMISSIVE, g->emissive);
    nook_bind_texture(gpu, UNIT_DEPTH, g->depth);
    nook_bind_texture(gpu, UNIT_VISIBILITY, visibility.id != 0 ? visibility : renderer->white);
}

void nook_pass_lighting(nook_renderer *renderer, nook_texture visibility, nook_rectangle part)
{
    nook_raster_begin(renderer->gpu, renderer->targets.light_target, (raster_state){ .part = part });
    bind_inputs(renderer, visibility);
    nook_draw_fullscreen(renderer, renderer->lighting_program);
    nook_raster_end(renderer->gpu);
}

void nook_pass_view(nook_renderer *renderer, nook_texture visibility, nook_view view, nook_rectangle part)
{
    nook_raster_begin(renderer->gpu, renderer->targets.image_target, (raster_state){ .part = part });
    bind_inputs(renderer, visibility);
    nook_bind_texture(renderer->gpu, UNIT_LIGHT, renderer->targets.light);
    nook_program_use(renderer->gpu, renderer->view_program);
    nook_uniform_int(renderer->gpu, LOCATION_DRAW, &(const int32_t){ (int32_t)view }, 1);
    nook_draw_fullscreen(renderer, renderer->view_program);
    nook_raster_end(renderer->gpu);
}
