#include "game/stage.h"
#include "engine/core/log.h"
#include "game/stream_volumes.h"
#include "game/techniques.h"
#include "game/volumes.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* G-buffer, light, AO and what is read back, bytes per pixel, rounded up; on software GL all of it is main memory. */
static const double bytes_per_pixel = 160.0;

enum { OCCLUDERS_SPARE = 256 }; /* for a scene that is exchanged for one with more bodies */

static const uint32_t window_max[2] = { 1600, 900 };

static nook_result check_size(const nook_stage_desc *desc)
{
    double need = bytes_per_pixel * desc->width * desc->height;
    double have = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGE_SIZE);
    if (need > 0.5 * have)
        return nook_fail(NOOK_E_RANGE,
                         "%u x %u pixels need about %.1f GB and this machine has %.1f; give a smaller --size",
                         desc->width, desc->height, need * 1e-9, have * 1e-9);
    return NOOK_OK;
}

static nook_result load_scene(nook_stage *stage, const nook_stage_desc *desc)
{
    nook_result result = NOOK_OK;
    stage->scene = desc->scene;
    if (!stage->scene)
        result = nook_scene_load(desc->scene_path, NULL, &stage->scene);
    if (result == NOOK_OK && !desc->plays)
        result = nook_moment_stand_still(stage->scene, &desc->moment);
    if (result != NOOK_OK)
        return result;
    if (stage->scene->triangle_count == 0)
        return nook_fail(NOOK_E_FORMAT, "%s: holds no triangles, so there is nothing to draw", stage->scene->path);
    return nook_game_world_create(stage->scene, &stage->world);
}

static nook_result open_devices(nook_stage *stage, const nook_stage_desc *desc)
{
    /* Shown when there is something to see in it. */
    const nook_context_desc context = {
        .backend = desc->backend,
        .want_window = desc->want_window,
        .width = desc->width < window_max[0] ? desc->width : window_max[0],
        .height = desc->height < window_max[1] ? desc->height : window_max[1],
        .hidden = true,
    };
    nook_result result = nook_context_create(&context, &stage->context);
    if (result != NOOK_OK)
        return result;
    stage->shows = desc->want_window && nook_context_backend(stage->context) == NOOK_BACKEND_WINDOW;
    const nook_gpu_desc gpu = { nook_context_get_proc(stage->context), desc->root, .log_debug_output = true };
    result = nook_gpu_create(&gpu, &stage->gpu);
    if (result != NOOK_OK)
        return result;
    if (desc->width > stage->gpu->max_texture_size || desc->height > stage->gpu->max_texture_size)
        return nook_fail(NOOK_E_RANGE, "%u x %u pixels: %s draws at most %u on a side; give a smaller --size",
                         desc->width, desc->height, stage->gpu->renderer, stage->gpu->max_texture_size);
    return NOOK_OK;
}

/* Remembers that the user wants out; everything else waits. */
static void answer_events(nook_stage *stage, nook_input *out_input)
{
    nook_context_poll(stage->context, out_input);
    if (out_input->close_requested || out_input->pressed[NOOK_KEY_ESCAPE])
        stage->stop_asked = true;
}

static void pass_progress_on(void *user, double fraction)
{
    nook_stage *stage = user;
    nook_input input;
    if (stage->progress)
        nook_progress_update(stage->progress, fraction);
    if (stage->shows)
        answer_events(stage, &input);
}

/* A body is one occluder each frame, and so are a density and all that stands still. */
static uint32_t count_occluders(const nook_scene *scene)
{
    uint32_t count = 1 + scene->density_count;
    for (uint32_t i = 0; i < scene->node_count; i++)
        count += scene->nodes[i].mesh != NOOK_NONE && (scene->nodes[i].moving || scene->nodes[i].animated);
    return count;
}

static nook_result open_ao(nook_stage *stage)
{
    stage->occluder_max = count_occluders(stage->scene) + OCCLUDERS_SPARE;
    const nook_ao_desc desc = { .version = NOOK_AO_VERSION,
                                .gpu = stage->gpu,
                                .width = stage->width,
                                .height = stage->height,
                                .max_occluders = stage->occluder_max,
                                .progress = pass_progress_on,
                                .progress_user = stage };
    nook_result result = nook_ao_create(&desc, &stage->ao);
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    for (size_t i = 0; i < count && result == NOOK_OK; i++)
        result = nook_ao_add_technique(stage->ao, techniques[i]);
    return result;
}

nook_result nook_stage_open(const nook_stage_desc *desc, nook_stage *out_stage)
{
    *out_stage =
        (nook_stage){ .width = desc->width, .height = desc->height, .moment = desc->moment, .plays = desc->plays };
    nook_result result = load_scene(out_stage, desc);
    if (result == NOOK_OK)
        result = check_size(desc);
    if (result == NOOK_OK)
        result = open_devices(out_stage, desc);
    if (result == NOOK_OK)
        result = open_ao(out_stage);
    if (result != NOOK_OK)
        nook_stage_close(out_stage);
    return result;
}

/* Of nook_ao_set_supply: what is marched for the first time is baked then. */
static nook_result supply_volumes(void *user, uint32_t kinds)
{
    nook_stage *stage = user;
    return nook_game_world_supply(stage->world, kinds, &stage->volumes);
}

static uint32_t live_resolution(const nook_stage *stage)
{
    uint32_t resolution = stage->volumes.resolution;
    return !stage->live_scene ? 0 : resolution > 0 ? resolution : NOOK_VOLUMES_RESOLUTION_DEFAULT;
}

/* Triangles for the reference, and one volume that is voxelised as they move. */
static nook_result fill_live(nook_stage *stage)
{
    const nook_volumes_desc desc = { .resolution = stage->volumes.resolution, .r_max = stage->volumes.r_max };
    nook_scene_volumes collected;
    if (nook_ao_volume_kinds(stage->ao) & ~NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY))
        return nook_fail(NOOK_E_ARG,
                         "%s: live volumes hold binary voxels; take volume.kind = binary, or volumes = baked",
                         stage->scene->path);
    if (stage->plan.mode != NOOK_PLAN_OFF)
        nook_log_warning("%s: its volumes are live, so that nothing is planned", stage->scene->path);
    if (stage->stream_params.budget > 0.0f)
        nook_log_warning("%s: its volumes are live, so that volumes.budget does nothing", stage->scene->path);
    nook_result result = nook_volumes_collect(stage->scene, &desc, &collected);
    if (result == NOOK_OK &&
        (result = nook_volumes_add_densities(stage->scene, desc.resolution, &collected)) != NOOK_OK)
        nook_volumes_free(&collected);
    return result == NOOK_OK ? nook_game_world_take_volumes(stage->world, stage->ao, &collected, live_resolution(stage))
                             : result;
}

static nook_result make_stream(nook_stage *stage)
{
    bool wanted = stage->stream_params.budget > 0.0f && !stage->live_scene;
    return wanted && !stage->stream ? nook_stream_create(stage->ao, &stage->stream_params, &stage->stream) : NOOK_OK;
}

nook_result nook_stage_fill(nook_stage *stage, const nook_game_world_desc *desc)
{
    nook_result result = NOOK_OK;
    if (stage->filled) {
        nook_game_world_destroy(stage->world);
        result = nook_game_world_create(stage->scene, &stage->world);
    }
    const nook_volumes_plan plan = { stage->plan, stage->plays, nook_game_world_multiplies(stage->ao) };
    stage->volumes = *desc;
    if (result == NOOK_OK)
        result = make_stream(stage);
    if (result == NOOK_OK) {
        nook_game_world_set_stream(stage->world, stage->stream);
        result = stage->live_scene ? fill_live(stage) : nook_game_world_bake(stage->world, stage->ao, desc, &plan);
    }
    stage->filled = result == NOOK_OK;
    nook_ao_set_supply(stage->ao, supply_volumes, stage);
    if (result != NOOK_OK || stage->renderer)
        return result;
    stage->lights = nook_lights_from_scene(stage->scene);
    result = nook_render_scene_create(stage->gpu, stage->scene, &stage->render_scene);
    return result == NOOK_OK ? nook_renderer_create(stage->gpu, stage->width, stage->height, &stage->renderer) : result;
}

nook_result nook_stage_renew(nook_stage *stage)
{
    nook_ao_set_progress(stage->ao, pass_progress_on, stage);
    nook_ao_set_supply(stage->ao, supply_volumes, stage);
    return nook_game_world_renew(stage->world);
}

nook_result nook_stage_scene_upload(nook_stage *stage, nook_scene *scene, nook_scene_volumes *baked,
                                    nook_stage_scene *out)
{
    nook_stage_scene made = { 0 };
    *out = made;
    nook_result result = NOOK_OK;
    if (scene->triangle_count == 0)
        result = nook_fail(NOOK_E_FORMAT, "%s: holds no triangles, so there is nothing to draw", scene->path);
    else if (baked->occluder_count + scene->deformable_count > stage->occluder_max)
        result = nook_fail(NOOK_E_RANGE, "%s: %u bodies, there is room for %u; start again to see them", scene->path,
                           baked->occluder_count, stage->occluder_max);
    if (result == NOOK_OK)
        result = nook_game_world_create(scene, &made.world);
    if (result == NOOK_OK) {
        nook_game_world_set_stream(made.world, stage->stream);
        result = nook_game_world_take_volumes(made.world, stage->ao, baked, live_resolution(stage));
    }
    if (result == NOOK_OK)
        result = nook_render_scene_create(stage->gpu, scene, &made.render_scene);
    nook_volumes_free(baked);
    if (result != NOOK_OK) {
        nook_stage_scene_destroy(&made);
        return result;
    }
    made.scene = scene;
    *out = made;
    return NOOK_OK;
}

nook_stage_scene nook_stage_exchange_scene(nook_stage *stage, const nook_stage_scene *scene)
{
    nook_stage_scene before = { stage->scene, stage->world, stage->render_scene };
    float exposure = stage->lights.exposure;
    stage->scene = scene->scene;
    stage->world = scene->world;
    stage->render_scene = scene->render_scene;
    stage->lights = nook_lights_from_scene(stage->scene);
    stage->lights.exposure = exposure;
    return before;
}

void nook_stage_scene_destroy(nook_stage_scene *scene)
{
    nook_render_scene_destroy(scene->render_scene);
    nook_game_world_destroy(scene->world);
    nook_scene_destroy(scene->scene);
    *scene = (nook_stage_scene){ 0 };
}

void nook_stage_close(nook_stage *stage)
{
    nook_renderer_destroy(stage->renderer);
    nook_render_scene_destroy(stage->render_scene);
    nook_game_world_destroy(stage->world);
    nook_stream_destroy(stage->stream);
    nook_ao_destroy(stage->ao);
    nook_gpu_destroy(stage->gpu);
    nook_context_destroy(stage->context);
    nook_scene_destroy(stage->scene);
    *stage = (nook_stage){ 0 };
}

nook_result nook_stage_set_size(nook_stage *stage, uint32_t width, uint32_t height)
{
    nook_result result = nook_renderer_set_size(stage->renderer, width, height);
    if (result == NOOK_OK)
        result = nook_ao_set_size(stage->ao, width, height);
    stage->width = width;
    stage->height = height;
    return result;
}

nook_result nook_stage_check(nook_stage *stage, const char *where)
{
    return nook_gpu_check(stage->gpu, where) ? NOOK_E_DEVICE : NOOK_OK;
}

/* What fails here was told once, and keeps volumes from coming: the picture goes on with those that are there. */
static void stream(nook_stage *stage, const nook_camera *camera)
{
    nook_matrix clip_from_view = nook_renderer_clip_from_view(stage->renderer, camera);
    uint32_t count;
    const nook_ao_occluder *occluders = nook_game_world_occluders(stage->world, &count);
    (void)nook_stream_look(stage->stream, camera, &clip_from_view, occluders, count);
}

nook_result nook_stage_update(nook_stage *stage, const nook_camera *camera)
{
    nook_result result = nook_game_world_update(stage->world, stage->ao);
    if (result != NOOK_OK)
        return result;
    if (stage->stream)
        stream(stage, camera);
    size_t draw_count;
    uint32_t pose_version;
    const nook_draw *draws = nook_game_world_draws(stage->world, &draw_count);
    const nook_mesh_pose *poses = nook_game_world_poses(stage->world, &pose_version);
    stage->frame = (nook_frame){ .scene = stage->render_scene,
                                 .draws = draws,
                                 .draw_count = draw_count,
                                 .poses = poses,
                                 .pose_version = pose_version,
                                 .camera = *camera,
                                 .lights = &stage->lights,
                                 .quick = stage->quick,
                                 .cull_back_faces = stage->quick };
    return nook_game_world_voxelize(stage->world, stage->render_scene, camera, (double)stage->width / stage->height);
}

nook_result nook_stage_begin(nook_stage *stage, const nook_camera *camera)
{
    nook_result result = nook_stage_update(stage, camera);
    if (result == NOOK_OK)
        result = nook_frame_begin(stage->renderer, &stage->frame);
    return result == NOOK_OK ? nook_stage_check(stage, "the G-buffer") : result;
}

static nook_ao_texture ao_texture(nook_texture texture)
{
    return (nook_ao_texture){ texture.id, texture.width, texture.height };
}

nook_ao_frame nook_stage_ao_frame(const nook_stage *stage)
{
    nook_gbuffer gbuffer = nook_renderer_gbuffer(stage->renderer);
    nook_matrix clip_from_view = nook_renderer_clip_from_view(stage->renderer, &stage->frame.camera);
    nook_ao_frame frame = { .depth = ao_texture(gbuffer.depth),
                            .normal = ao_texture(gbuffer.geometric_normal),
                            .index = stage->frame_index };
    memcpy(frame.view_from_world, stage->frame.camera.view_from_world.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, clip_from_view.m, sizeof frame.clip_from_view);
    return frame;
}

nook_result nook_stage_occlude(nook_stage *stage)
{
    const nook_ao_frame frame = nook_stage_ao_frame(stage);
    return nook_ao_record(stage->ao, &frame);
}

/* Records until every value is the mean of as many traces as it may be. 1: there are no means. */
static int records_of_means(const nook_stage *stage)
{
    double traces = 1.0, turns = 1.0;
    nook_ao_get_param(stage->ao, "ao.accumulate", &traces);
    nook_ao_get_param(stage->ao, "ao.reuse", &turns);
    return traces > 1.0 ? (int)(traces * turns) : 1;
}

nook_result nook_stage_settle(nook_stage *stage)
{
    const int records = records_of_means(stage);
    nook_result result = NOOK_OK;
    nook_ao_statistics last = { .traced = UINT32_MAX };
    if (records > 1)
        nook_ao_get_statistics(stage->ao, &last);
    if (last.traced == UINT32_MAX)
        return NOOK_OK; /* a technique that makes none: the truth would be traced again and again */
    nook_stage_begin_means(stage);
    for (int i = 0; i < records && result == NOOK_OK; i++)
        result = nook_stage_occlude(stage);
    return result;
}

void nook_stage_begin_means(nook_stage *stage)
{
    if (records_of_means(stage) > 1)
        nook_ao_forget(stage->ao);
}

nook_texture nook_stage_visibility(const nook_stage *stage)
{
    nook_ao_texture texture = nook_ao_visibility(stage->ao);
    return (nook_texture){ texture.native, GL_TEXTURE_2D, texture.width, texture.height, 1, GL_R32F };
}

nook_result nook_stage_finish(nook_stage *stage, bool occluded, nook_view view)
{
    nook_texture visibility = { 0 };
    if (occluded)
        visibility = nook_stage_visibility(stage);
    nook_frame_finish(stage->renderer, &stage->frame, visibility, view);
    return nook_stage_check(stage, "a picture");
}

void nook_stage_show(nook_stage *stage, const char *doing)
{
    if (!stage->shows)
        return;
    char title[256];
    nook_input input;
    snprintf(title, sizeof title, "Nook: comparing (%s)", doing);
    nook_context_set_title(stage->context, title);
    nook_context_show(stage->context);
    answer_events(stage, &input);
    if (input.width == 0 || input.height == 0)
        return;
    nook_renderer_present(stage->renderer, input.width, input.height);
    nook_context_present(stage->context);
}
