#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include <assert.h>
#include <math.h>
#include <string.h>

static_assert(sizeof(frame_block) == 224 && offsetof(frame_block, ray_scale) == 192 &&
                  offsetof(frame_block, size) == 216,
              "as shaders/render/frame.glsl in std140");
static_assert(sizeof(lights_block) == 80 + 48 * NOOK_MAX_POINT_LIGHTS, "as shaders/render/lights.glsl in std140");

void nook_camera_position(const nook_camera *camera, double out[3])
{
    const double *m = camera->view_from_world.m;
    for (int i = 0; i < 3; i++) /* rigid: the inverse rotation is the transpose */
        out[i] = -nook_vector_dot(m + i * 4, m + 12);
}

bool nook_sun_shines(const nook_sun *sun)
{
    bool black = sun->colour[0] <= 0.0f && sun->colour[1] <= 0.0f && sun->colour[2] <= 0.0f;
    return !black && (sun->direction[0] != 0.0 || sun->direction[1] != 0.0 || sun->direction[2] != 0.0);
}

void nook_uniforms_frame(nook_renderer *renderer, const nook_frame *frame)
{
    frame_block *block = &renderer->frame;
    const nook_camera *camera = &frame->camera;
    nook_matrix clip_from_view = nook_renderer_clip_from_view(renderer, camera);
    nook_matrix_to_float(&clip_from_view, block->clip_from_view);
    memset(block->world_from_view, 0, sizeof block->world_from_view);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            block->world_from_view[column * 4 + row] = (float)camera->view_from_world.m[row * 4 + column];
    }
    block->world_from_view[15] = 1.0f;
    block->ray_scale[0] = (float)(1.0 / clip_from_view.m[0]);
    block->ray_scale[1] = (float)(1.0 / clip_from_view.m[5]);
    block->z_near = (float)camera->z_near;
    bool empty = renderer->visible.instance_count == 0;
    block->depth_near = empty ? 0.0f : (float)renderer->visible.near_distance;
    block->depth_far = empty ? 1.0f : (float)renderer->visible.far_distance;
    block->size[0] = (float)renderer->width;
    block->size[1] = (float)renderer->height;
    nook_buffer_update(renderer->gpu, renderer->frame_uniforms, 0, block, sizeof *block);
}

static void expose(const float colour[3], float exposure, float out[4])
{
    for (int i = 0; i < 3; i++)
        out[i] = colour[i] * exposure;
}

static void point_light(const nook_point_light *light, const double eye[3], float exposure, float position_fade[4],
                        float colour_inner[4], float direction_outer[4])
{
    for (int i = 0; i < 3; i++) {
        position_fade[i] = (float)(light->position[i] - eye[i]);
        direction_outer[i] = (float)light->direction[i];
    }
    position_fade[3] = light->range > 0.0f ? 1.0f / (light->range * light->range) : 0.0f;
    expose(light->colour, exposure, colour_inner);
    colour_inner[3] = light->cos_inner;
    direction_outer[3] = light->cos_outer;
}

void nook_uniforms_lights(nook_renderer *renderer, const nook_frame *frame)
{
    const nook_lights *lights = frame->lights;
    lights_block block;
    memset(&block, 0, sizeof block);
    if (nook_sun_shines(&lights->sun)) {
        const double *d = lights->sun.direction;
        double length = nook_vector_length(d);
        for (int i = 0; i < 3; i++)
            block.sun_direction[i] = (float)(-d[i] / length);
        block.sun_direction[3] = 1.0f;
        expose(lights->sun.colour, lights->exposure, block.sun_colour);
    }
    expose(lights->ambient_top, lights->exposure, block.ambient_top);
    expose(lights->ambient_bottom, lights->exposure, block.ambient_bottom);
    block.point_count[0] = lights->point_count;
    double eye[3];
    nook_camera_position(&frame->camera, eye);
    for (uint32_t i = 0; i < lights->point_count; i++)
        point_light(&lights->points[i], eye, lights->exposure, block.points[i].position_fade,
                    block.points[i].colour_inner, block.points[i].direction_outer);
    nook_buffer_update(renderer->gpu, renderer->light_uniforms, 0, &block, sizeof block);
}
