/* What each mode puts into its view's part of the image. */
#include "game/live/live_internal.h"
#include "modules/ao/inspect.h"
#include "modules/measure/colour_map.h"
#include <math.h>
#include <string.h>

enum { UNIT_FIRST = 0, UNIT_TRUTH = 1, UNIT_DEPTH = 2, UNIT_COLOURS = 3 };

static const char vertex_path[] = "shaders/render/fullscreen.vert.glsl";
static const double voxel_threshold = 0.5; /* modules/bake writes 0 and 255 */

/* ---- Targets ------------------------------------------------------------------------------------------------------ */

static nook_result create_colours(nook_gpu *gpu, nook_rgb (*colour)(float share), nook_texture *out)
{
    uint8_t rgba[LIVE_COLOURS][4];
    for (int i = 0; i < LIVE_COLOURS; i++) {
        nook_rgb c = colour((float)i / (LIVE_COLOURS - 1));
        rgba[i][0] = c.r, rgba[i][1] = c.g, rgba[i][2] = c.b, rgba[i][3] = 255;
    }
    nook_result result = nook_texture_create_2d(gpu, GL_RGBA8, LIVE_COLOURS, 1, GL_NEAREST, out);
    if (result == NOOK_OK)
        nook_texture_write(gpu, *out, GL_RGBA, GL_UNSIGNED_BYTE, rgba, sizeof rgba);
    return result;
}

static nook_rgb error_colour(float share)
{
    return nook_error_colour(2.0f * share - 1.0f, 1.0f);
}

nook_result live_targets_create(nook_live *live)
{
    const float open = 1.0f;
    nook_gpu *gpu = live->stage->gpu;
    nook_result result = create_colours(gpu, error_colour, &live->targets.error_colours);
    if (result == NOOK_OK)
        result = create_colours(gpu, nook_amount_colour, &live->targets.amount_colours);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_R32F, 1, 1, GL_NEAREST, &live->targets.open);
    if (result == NOOK_OK)
        nook_texture_write(gpu, live->targets.open, GL_RED, GL_FLOAT, &open, sizeof open);
    return result;
}

void live_targets_destroy(nook_live *live)
{
    live_targets *t = &live->targets;
    nook_gpu *gpu = live->stage->gpu;
    nook_framebuffer_destroy(gpu, &t->image);
    nook_texture_destroy(gpu, &t->error_colours);
    nook_texture_destroy(gpu, &t->amount_colours);
    nook_framebuffer_destroy(gpu, &t->shot_target);
    nook_texture_destroy(gpu, &t->shot);
    nook_texture_destroy(gpu, &t->counts);
    nook_texture_destroy(gpu, &t->open);
    if (t->vertex_array)
        gpu->gl->DeleteVertexArrays(1, &t->vertex_array);
    t->vertex_array = 0;
}

nook_result live_fit_counts(nook_live *live)
{
    nook_texture *counts = &live->targets.counts;
    if (counts->id && counts->width == live->stage->width && counts->height == live->stage->height)
        return NOOK_OK;
    nook_texture_destroy(live->stage->gpu, counts);
    return nook_texture_create_2d(live->stage->gpu, GL_R32UI, live->stage->width, live->stage->height, GL_NEAREST,
                                  counts);
}

nook_result live_fit_image(nook_live *live)
{
    live_targets *t = &live->targets;
    nook_texture image = nook_renderer_image(live->stage->renderer);
    if (t->image.id && t->image_id == image.id && t->image.width == image.width && t->image.height == image.height)
        return NOOK_OK;
    nook_framebuffer_destroy(live->stage->gpu, &t->image);
    t->image_id = image.id;
    return nook_framebuffer_create(live->stage->gpu, &image, 1, (nook_texture){ 0 }, &t->image);
}

/* ---- Passes over a part of the image ------------------------------------------------------------------------------ */

static nook_result begin_pass(nook_live *live, const char *fragment_path, const nook_rectangle *part,
                              nook_program *out_program)
{
    nook_gpu *gpu = live->stage->gpu;
    const nook_gl *gl = gpu->gl;
    nook_result result = live_fit_image(live);
    if (result == NOOK_OK)
        result = nook_program_raster(gpu, vertex_path, fragment_path, "", out_program);
    if (result != NOOK_OK)
        return result;
    if (!live->targets.vertex_array)
        gl->CreateVertexArrays(1, &live->targets.vertex_array);
    nook_framebuffer_bind(gpu, live->targets.image);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor((GLint)part->x, (GLint)part->y, (GLsizei)part->width, (GLsizei)part->height);
    nook_program_use(gpu, *out_program);
    return NOOK_OK;
}

static void end_pass(nook_live *live)
{
    const nook_gl *gl = live->stage->gpu->gl;
    gl->BindVertexArray(live->targets.vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
    gl->Disable(GL_SCISSOR_TEST);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void set_float(nook_gpu *gpu, uint32_t location, double value)
{
    const float number = (float)value;
    nook_uniform_float(gpu, location, &number, 1);
}

static nook_result show_counts(nook_live *live, const nook_rectangle *part, double strongest)
{
    nook_gpu *gpu = live->stage->gpu;
    nook_program program;
    nook_result result = begin_pass(live, "shaders/live/amount.frag.glsl", part, &program);
    if (result != NOOK_OK)
        return result;
    nook_bind_texture(gpu, UNIT_FIRST, live->targets.counts);
    nook_bind_texture(gpu, UNIT_COLOURS, live->targets.amount_colours);
    set_float(gpu, 0, strongest);
    end_pass(live);
    return NOOK_OK;
}

static nook_result show_divergence(nook_live *live, const nook_rectangle *part, double scale)
{
    nook_gpu *gpu = live->stage->gpu;
    const int32_t pixels = 1 << (int)scale;
    const int32_t inside[4] = { (int32_t)part->x, (int32_t)part->y, (int32_t)(part->x + part->width),
                                (int32_t)(part->y + part->height) };
    nook_program program;
    nook_result result = begin_pass(live, "shaders/live/divergence.frag.glsl", part, &program);
    if (result != NOOK_OK)
        return result;
    nook_bind_texture(gpu, UNIT_FIRST, live->targets.counts);
    nook_bind_texture(gpu, UNIT_COLOURS, live->targets.amount_colours);
    nook_uniform_int(gpu, 0, &pixels, 1);
    nook_uniform_int(gpu, 1, inside, 4);
    end_pass(live);
    return NOOK_OK;
}

static nook_result show_counted(nook_live *live, uint32_t view, const nook_rectangle *part)
{
    switch (live->views.views[view].mode) {
    case NOOK_LIVE_DIVERGENCE:
        return show_divergence(live, part, live->scales[view]);
    case NOOK_LIVE_STEPS:
        return show_counts(live, part, live->views.steps_range * NOOK_AO_FETCH_UNITS);
    default:
        return show_counts(live, part, live->views.fetches_range * NOOK_AO_FETCH_UNITS);
    }
}

static nook_result show_occluders(nook_live *live, const nook_rectangle *part)
{
    nook_ao_frame frame = nook_stage_ao_frame(live->stage);
    frame.part = *part;
    frame.same_view = live->view_recorded;
    nook_result result = live_fit_counts(live);
    if (result != NOOK_OK)
        return result;
    const nook_texture *counts = &live->targets.counts;
    result = nook_ao_set_param(live->stage->ao, "ao.r_max", live->views.r_max);
    if (result == NOOK_OK)
        result = nook_ao_count_occluders(live->stage->ao, &frame,
                                         (nook_ao_texture){ counts->id, counts->width, counts->height });
    live->view_recorded = live->view_recorded || result == NOOK_OK;
    return result == NOOK_OK ? show_counts(live, part, live->views.counts_range) : result;
}

static nook_result show_error(nook_live *live, const nook_rectangle *part, nook_texture visibility, nook_texture truth)
{
    nook_gpu *gpu = live->stage->gpu;
    const nook_rgb ground = nook_error_no_geometry();
    const float grey[3] = { (float)ground.r / 255.0f, (float)ground.g / 255.0f, (float)ground.b / 255.0f };
    nook_program program;
    nook_result result = begin_pass(live, "shaders/live/error.frag.glsl", part, &program);
    if (result != NOOK_OK)
        return result;
    nook_bind_texture(gpu, UNIT_FIRST, visibility.id ? visibility : live->targets.open);
    nook_bind_texture(gpu, UNIT_TRUTH, truth);
    nook_bind_texture(gpu, UNIT_DEPTH, nook_renderer_gbuffer(live->stage->renderer).depth);
    nook_bind_texture(gpu, UNIT_COLOURS, live->targets.error_colours);
    set_float(gpu, 0, live->views.error_range);
    nook_uniform_float(gpu, 1, grey, 3);
    end_pass(live);
    return NOOK_OK;
}

/* ---- A body's volume ---------------------------------------------------------------------------------------------- */

const nook_ao_occluder *live_chosen_body(nook_live *live)
{
    uint32_t count;
    const nook_ao_occluder *occluders = nook_game_world_occluders(live->stage->world, &count);
    return count == 0 ? NULL : &occluders[live->views.body < count ? live->views.body : 0];
}

static void set_volume(nook_gpu *gpu, const nook_ao_volume_place *place)
{
    int32_t origin[3], size[3];
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = (int32_t)place->origin[axis];
        size[axis] = (int32_t)place->size[axis];
    }
    nook_bind_texture(gpu, UNIT_FIRST, place->atlas);
    nook_uniform_int(gpu, 0, origin, 3);
    nook_uniform_int(gpu, 1, size, 3);
}

static nook_result show_slices(nook_live *live, const nook_rectangle *part, const nook_ao_volume_place *place)
{
    nook_gpu *gpu = live->stage->gpu;
    const double *slice = live->views.slice;
    const float cut[3] = { (float)slice[0], (float)slice[1], (float)slice[2] };
    const float place_of_view[4] = { (float)part->x, (float)part->y, (float)part->width, (float)part->height };
    nook_program program;
    nook_result result = begin_pass(live, "shaders/live/slices.frag.glsl", part, &program);
    if (result != NOOK_OK)
        return result;
    set_volume(gpu, place);
    nook_uniform_float(gpu, 2, cut, 3);
    nook_uniform_float(gpu, 3, place_of_view, 4);
    end_pass(live);
    return NOOK_OK;
}

/* Composed in double, as modules/ao/occluders.c does. @return false: it is singular */
static bool voxel_from_view(const nook_live *live, const nook_ao_occluder *body, const nook_ao_volume_place *place,
                            float out[16])
{
    nook_matrix world_from_mesh, inverse;
    memcpy(world_from_mesh.m, body->world_from_mesh, sizeof world_from_mesh.m);
    nook_matrix scale = nook_matrix_scale(place->voxel_size, place->voxel_size, place->voxel_size);
    nook_matrix corner = nook_matrix_translation(place->corner[0], place->corner[1], place->corner[2]);
    nook_matrix mesh_from_voxel = nook_matrix_multiply(&corner, &scale);
    nook_matrix view_from_mesh = nook_matrix_multiply(&live->camera.view_from_world, &world_from_mesh);
    nook_matrix view_from_voxel = nook_matrix_multiply(&view_from_mesh, &mesh_from_voxel);
    if (!nook_matrix_inverse_affine(&view_from_voxel, &inverse))
        return false;
    nook_matrix_to_float(&inverse, out);
    return true;
}

static nook_result show_voxels(nook_live *live, const nook_rectangle *part, const nook_ao_occluder *body,
                               const nook_ao_volume_place *place)
{
    nook_gpu *gpu = live->stage->gpu;
    const float light[3] = { 0.36f, 0.80f, 0.48f }; /* from above, over the right shoulder */
    float matrix[16];
    nook_program program;
    nook_matrix clip_from_view = nook_renderer_clip_from_view(live->stage->renderer, &live->camera);
    const float rays[4] = { (float)(1.0 / clip_from_view.m[0]), (float)(1.0 / clip_from_view.m[5]),
                            (float)live->stage->width, (float)live->stage->height };
    if (!voxel_from_view(live, body, place, matrix))
        return NOOK_OK;
    nook_result result = begin_pass(live, "shaders/live/voxels.frag.glsl", part, &program);
    if (result != NOOK_OK)
        return result;
    set_volume(gpu, place);
    for (uint32_t column = 0; column < 4; column++)
        nook_uniform_float(gpu, 2 + column, matrix + 4 * column, 3);
    nook_uniform_float(gpu, 6, rays, 4);
    nook_uniform_float(gpu, 7, light, 3);
    set_float(gpu, 8, voxel_threshold);
    end_pass(live);
    return NOOK_OK;
}

static nook_result show_volume(nook_live *live, const nook_rectangle *part, uint32_t mode)
{
    const nook_ao_occluder *body = live_chosen_body(live);
    nook_ao_volume_place place;
    if (mode == NOOK_LIVE_VOXELS || !body || body->volume.id == 0)
        nook_frame_finish_part(live->stage->renderer, &live->stage->frame, (nook_texture){ 0 }, NOOK_VIEW_LIT, *part);
    if (!body || body->volume.id == 0)
        return NOOK_OK;
    nook_result result = nook_ao_inspect_volume(live->stage->ao, body->volume, &place);
    if (result != NOOK_OK || place.size[0] == 0) /* it has neither voxels nor densities */
        return result;
    return mode == NOOK_LIVE_SLICES ? show_slices(live, part, &place) : show_voxels(live, part, body, &place);
}

nook_result live_show_view(nook_live *live, uint32_t view, nook_texture visibility, nook_texture truth)
{
    const nook_live_view *v = &live->views.views[view];
    const nook_rectangle part = live->places[view], all = { 0 };
    switch (v->mode) {
    case NOOK_LIVE_OCCLUDERS:
        return show_occluders(live, &part);
    case NOOK_LIVE_FETCHES:
    case NOOK_LIVE_STEPS:
    case NOOK_LIVE_DIVERGENCE:
        if (visibility.id == 0 || live->targets.counts.id == 0)
            break;
        return show_counted(live, view, &part);
    case NOOK_LIVE_ERROR:
        if (truth.id == 0)
            break;
        return show_error(live, &part, visibility, truth);
    case NOOK_LIVE_SLICES:
    case NOOK_LIVE_VOXELS:
        return show_volume(live, &part, v->mode);
    default:
        break;
    }
    nook_frame_finish_part(live->stage->renderer, &live->stage->frame, visibility,
                           (nook_view)nook_live_mode_buffer(v->mode), live->views.count == 1 ? all : part);
    return NOOK_OK;
}
