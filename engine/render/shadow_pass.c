/* The sun's shadow map. It is kept from frame to frame: when something moves, only the parts of it that show what has moved are
   made anew, from a second map that holds all that never moves. What comes out is the map that drawing everything would give, bit
   for bit, because each texel is the least of the same depths. */
#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <string.h>

static bool same_direction(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** Draws are compared as bytes: a difference that is none only costs a pass. */
static bool same_draw(const nook_draw *a, const nook_draw *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

/** Another one when a shader that the map was made with has been reloaded. */
static uint32_t program_version(const nook_renderer *renderer)
{
    return nook_program_version(renderer->gpu, renderer->shadow_program) +
           nook_program_version(renderer->gpu, renderer->shadow_masked_program);
}

/** Whether the map is of this scene, this sun and these draws, wherever those that move stand now. */
static bool is_of(const nook_renderer *renderer, const nook_frame *frame)
{
    const shadow_contents *shadow = &renderer->shadow;
    bool same = shadow->scene == frame->scene && shadow->program_version == program_version(renderer) &&
                shadow->scene_created_ms == frame->scene->created_ms &&
                same_direction(shadow->sun_direction, frame->lights->sun.direction) &&
                shadow->draw_count == frame->draw_count;
    const nook_draw *draws = shadow->draws.items;
    for (size_t i = 0; same && i < frame->draw_count; i++) {
        const nook_draw *draw = &frame->draws[i];
        same = draws[i].moves && draw->moves && draws[i].mesh == draw->mesh ? true : same_draw(&draws[i], draw);
    }
    return same;
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

static nook_program choose_program(nook_renderer *renderer, const void *user, const render_material *material,
                                   bool masked)
{
    (void)user, (void)material;
    return masked ? renderer->shadow_masked_program : renderer->shadow_program;
}

/** Draws into a map. @param part only there, over what it holds; NULL: the whole map, from nothing */
static nook_result draw_map(nook_renderer *renderer, const nook_frame *frame, nook_framebuffer target,
                            const shadow_rect *part)
{
    const nook_gl *gl = renderer->gpu->gl;
    nook_matrix clip_from_map = nook_matrix_scale(2.0, 2.0, 1.0); /* x and y to [-1, 1] */
    clip_from_map.m[12] = clip_from_map.m[13] = -1.0;
    batch_view view = { .view_from_world = nook_matrix_multiply(&clip_from_map, &renderer->shadow.fit.map_from_world) };
    nook_result result = nook_batch(renderer->gpu, frame, &view, &renderer->casters);
    if (result != NOOK_OK)
        return result;
    nook_raster_begin(renderer->gpu, target, (raster_state){ .depth_compare = GL_LESS, .depth_write = true });
    const float far = 1.0f;
    if (part) {
        gl->Enable(GL_SCISSOR_TEST);
        gl->Scissor(part->low[0], part->low[1], part->high[0] - part->low[0], part->high[1] - part->low[1]);
    } else {
        gl->ClearNamedFramebufferfv(target.id, GL_DEPTH, 0, &far);
    }
    nook_draw_solid(renderer, frame->scene, &renderer->casters, choose_program, NULL, false);
    gl->Disable(GL_SCISSOR_TEST);
    nook_raster_end(renderer->gpu);
    return NOOK_OK;
}

/** Those draws of a frame that move, or those that do not. @param part of those that move, only what can touch it; NULL: all */
static nook_result choose(shadow_contents *shadow, const nook_frame *frame, bool moves, const shadow_rect *part,
                          nook_frame *out)
{
    if (!nook_grow(&shadow->some, frame->draw_count * sizeof(nook_draw)))
        return nook_fail(NOOK_E_MEMORY, "%zu draws: no memory for their shadows", frame->draw_count);
    nook_draw *some = shadow->some.items;
    *out = *frame;
    out->draws = some;
    out->draw_count = 0;
    for (size_t i = 0; i < frame->draw_count; i++) {
        shadow_rect rect;
        const nook_draw *draw = &frame->draws[i];
        if (draw->moves != moves)
            continue;
        if (part &&
            !(nook_shadow_rect(&shadow->fit, frame->scene->scene, draw, &rect) && nook_shadow_rects_meet(&rect, part)))
            continue;
        some[out->draw_count++] = *draw;
    }
    return NOOK_OK;
}

/** Makes the second map, and draws into it what does not move. */
static nook_result draw_base(nook_renderer *renderer, const nook_frame *frame)
{
    nook_result result = NOOK_OK;
    nook_frame still;
    if (renderer->shadow_base.id == 0) {
        result = nook_texture_create_2d(renderer->gpu, GL_DEPTH_COMPONENT32F, SHADOW_SIZE, SHADOW_SIZE, GL_NEAREST,
                                        &renderer->shadow_base);
        if (result == NOOK_OK)
            result =
                nook_framebuffer_create(renderer->gpu, NULL, 0, renderer->shadow_base, &renderer->shadow_base_target);
    }
    if (result == NOOK_OK)
        result = choose(&renderer->shadow, frame, false, NULL, &still);
    if (result == NOOK_OK)
        result = draw_map(renderer, &still, renderer->shadow_base_target, NULL);
    renderer->shadow.has_base = result == NOOK_OK;
    return result;
}

/** The parts of the map where what has moved was, or is. @return false: something has left the map */
static bool find_changes(const shadow_contents *shadow, const nook_frame *frame, shadow_rects *out)
{
    const nook_scene *scene = frame->scene->scene;
    const nook_draw *before = shadow->draws.items;
    *out = (shadow_rects){ .count = 0 };
    for (size_t i = 0; i < frame->draw_count; i++) {
        shadow_rect rect;
        if (same_draw(&before[i], &frame->draws[i]))
            continue;
        if (!nook_shadow_has_room(&shadow->fit, scene, &frame->draws[i]))
            return false;
        if (nook_shadow_rect(&shadow->fit, scene, &before[i], &rect))
            nook_shadow_rects_add(out, rect);
        if (nook_shadow_rect(&shadow->fit, scene, &frame->draws[i], &rect))
            nook_shadow_rects_add(out, rect);
    }
    return true;
}

static nook_result draw_part(nook_renderer *renderer, const nook_frame *frame, const shadow_rect *part)
{
    nook_frame movers;
    nook_result result = choose(&renderer->shadow, frame, true, part, &movers);
    if (result != NOOK_OK)
        return result;
    renderer->gpu->gl->CopyImageSubData(renderer->shadow_base.id, GL_TEXTURE_2D, 0, part->low[0], part->low[1], 0,
                                        renderer->shadow_map.id, GL_TEXTURE_2D, 0, part->low[0], part->low[1], 0,
                                        part->high[0] - part->low[0], part->high[1] - part->low[1], 1);
    return movers.draw_count > 0 ? draw_map(renderer, &movers, renderer->shadow_target, part) : NOOK_OK;
}

static nook_result draw_changes(nook_renderer *renderer, const nook_frame *frame, const shadow_rects *changes)
{
    nook_result result = NOOK_OK;
    if (changes->count > 0 && !renderer->shadow.has_base)
        result = draw_base(renderer, frame);
    for (uint32_t i = 0; i < changes->count && result == NOOK_OK; i++)
        result = draw_part(renderer, frame, &changes->items[i]);
    return result;
}

/** @return NOOK_OK also when nothing is drawn: nobody looks into the map then */
static nook_result draw_all(nook_renderer *renderer, const nook_frame *frame, bool *out_drawn)
{
    renderer->shadow.has_base = false;
    *out_drawn = nook_shadow_fit(frame, &renderer->shadow.fit);
    return *out_drawn ? draw_map(renderer, frame, renderer->shadow_target, NULL) : NOOK_OK;
}

/** The map as the shaders use it: from relative space. The camera moves, the map need not. */
static void set_uniforms(nook_renderer *renderer, const nook_camera *camera)
{
    double eye[3];
    nook_camera_position(camera, eye);
    nook_matrix world_from_relative = nook_matrix_translation(eye[0], eye[1], eye[2]);
    nook_matrix map_from_relative = nook_matrix_multiply(&renderer->shadow.fit.map_from_world, &world_from_relative);
    nook_matrix_to_float(&map_from_relative, renderer->frame.shadow_from_relative);
    renderer->frame.shadow_texel = (float)renderer->shadow.fit.texel;
}

nook_result nook_pass_shadow(nook_renderer *renderer, const nook_frame *frame)
{
    shadow_contents *shadow = &renderer->shadow;
    if (!nook_sun_shines(&frame->lights->sun))
        return NOOK_OK;
    shadow_rects changes;
    bool drawn = true, in_parts = is_of(renderer, frame) && find_changes(shadow, frame, &changes);
    shadow->scene = NULL; /* until it is whole */
    nook_result result = in_parts ? draw_changes(renderer, frame, &changes) : draw_all(renderer, frame, &drawn);
    if (result == NOOK_OK && drawn)
        result = remember(shadow, frame);
    shadow->program_version = program_version(renderer);
    if (result == NOOK_OK && drawn)
        set_uniforms(renderer, &frame->camera);
    return result;
}
