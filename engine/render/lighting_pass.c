#include "engine/render/internal.h"
#include <stdio.h>

enum { UNROLLED_POINTS = 8 /* beyond that the program is long and its light dim */, DEFINES_SIZE = 256 };

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
    gpu->gl->BindSampler(UNIT_VISIBILITY, renderer->nearest_sampler); /* it is the caller's, with any filter */
}

static void draw(nook_renderer *renderer, nook_program program)
{
    nook_draw_fullscreen(renderer, program);
    renderer->gpu->gl->BindSampler(UNIT_VISIBILITY, 0);
}

/** Whether the lights' calls can be written out one by one. */
static bool can_unroll(const nook_lights *lights)
{
    bool can = lights->point_count <= UNROLLED_POINTS;
    for (uint32_t i = 0; can && i < lights->point_count; i++) {
        const double *d = lights->points[i].direction;
        can = d[0] == 0.0 && d[1] == 0.0 && d[2] == 0.0;
    }
    return can;
}

/** The program of a frame's lights, compiled when a number of them comes for the first time; on software GL with a vertex shader that
    hands on what is one for the whole picture. */
static nook_program lighting_program(nook_renderer *renderer, const nook_lights *lights, bool to_image)
{
    char defines[DEFINES_SIZE];
    nook_program program = to_image ? renderer->lighting_image_program : renderer->lighting_program;
    if (!can_unroll(lights))
        return program;
    const char *vertex = "shaders/render/fullscreen.vert.glsl";
    int length = snprintf(defines, sizeof defines, "%s", to_image ? "#define TO_IMAGE\n" : "");
    if (renderer->gpu->software) {
        vertex = "shaders/render/lighting.vert.glsl";
        length +=
            snprintf(defines + length, sizeof defines - (size_t)length, "#define BY_VERTEX %u\n", lights->point_count);
    }
    length += snprintf(defines + length, sizeof defines - (size_t)length, "#define EACH_POINT(f)");
    for (uint32_t i = 0; i < lights->point_count; i++)
        length += snprintf(defines + length, sizeof defines - (size_t)length, " f(%u);", i);
    snprintf(defines + length, sizeof defines - (size_t)length, "\n");
    nook_program unrolled;
    nook_result result =
        nook_program_raster(renderer->gpu, vertex, "shaders/render/lighting.frag.glsl", defines, &unrolled);
    return result == NOOK_OK ? unrolled : program;
}

void nook_pass_lighting(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, bool to_image,
                        nook_rectangle part)
{
    const render_targets *targets = &renderer->targets;
    nook_program program = lighting_program(renderer, frame->lights, to_image);
    nook_raster_begin(renderer->gpu, to_image ? targets->image_target : targets->light_target,
                      (raster_state){ .part = part });
    bind_inputs(renderer, visibility);
    draw(renderer, program);
    nook_raster_end(renderer->gpu);
}

void nook_pass_view(nook_renderer *renderer, nook_texture visibility, nook_view view, nook_rectangle part)
{
    nook_raster_begin(renderer->gpu, renderer->targets.image_target, (raster_state){ .part = part });
    bind_inputs(renderer, visibility);
    nook_bind_texture(renderer->gpu, UNIT_LIGHT, renderer->targets.light);
    nook_program_use(renderer->gpu, renderer->view_program);
    nook_uniform_int(renderer->gpu, LOCATION_DRAW, &(const int32_t){ (int32_t)view }, 1);
    draw(renderer, renderer->view_program);
    nook_raster_end(renderer->gpu);
}
