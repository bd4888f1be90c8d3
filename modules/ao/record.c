#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/frame_block_internal.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(offsetof(frame_block, view_from_world) == 96, "std140 places view_from_world at 96");
_Static_assert(offsetof(frame_block, origin) == 144 && sizeof(frame_block) == 224, "std140 places origin at 144");

enum { BINDING_FETCHES = 2, BINDING_BINS = 2, AO_TEXTURE_UNITS = 8, FILTER_TILE = 2 };
enum { COUNT_SUMS = 1, COUNT_PIXELS = 2, COUNT_STEPS = 4 }; /* shaders/ao/counter.glsl */

static const double RIGID_TOLERANCE = 1e-5; /* what a product of a few matrices in float leaves */

nook_texture ao_host_texture(nook_ao_texture texture)
{
    return (nook_texture){
        .id = texture.native, .target = GL_TEXTURE_2D, .width = texture.width, .height = texture.height, .depth = 1
    };
}

/** Exponent of 1, 2 or 4; truth is always traced at full size. */
static uint32_t trace_scale(const nook_ao *ao, const nook_ao_technique *technique)
{
    return technique->exact ? 0u : (uint32_t)ao->shared.scale;
}

static int all_finite(const double m[16])
{
    int finite = 1;
    for (int i = 0; i < 16; i++)
        finite = finite && isfinite(m[i]);
    return finite;
}

/** Columns of unit length at right angles (mirrored is allowed), and nothing projective. */
static int is_rigid(const double m[16])
{
    for (int a = 0; a < 3; a++) {
        for (int b = a; b < 3; b++) {
            const double *u = m + 4 * a, *v = m + 4 * b;
            if (!(fabs(u[0] * v[0] + u[1] * v[1] + u[2] * v[2] - (a == b)) <= RIGID_TOLERANCE))
                return 0;
        }
    }
    return m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0 && m[15] == 1.0;
}

/* w = -z, and depth follows from z alone: what an oblique near plane or a turned picture has besides would be lost in set_projection. */
static int is_perspective(const double p[16])
{
    static const int zeros[] = { 1, 2, 3, 4, 6, 7, 12, 13, 15 };
    int upright = 1;
    for (size_t i = 0; i < NOOK_COUNT(zeros); i++)
        upright = upright && p[zeros[i]] == 0.0;
    return upright && p[11] == -1.0 && fabs(p[0]) > 0.0 && fabs(p[5]) > 0.0 && p[14] != 0.0;
}

static nook_result check_frame(const nook_ao *ao, const nook_ao_frame *frame)
{
    const double *p = frame->clip_from_view;
    if (frame->depth.native == 0 || frame->depth.width != ao->width || frame->depth.height != ao->height)
        return nook_fail(NOOK_E_ARG, "nook_ao_record: depth is %ux%u, the context %ux%u", frame->depth.width,
                         frame->depth.height, ao->width, ao->height);
    if (frame->normal.native && (frame->normal.width != ao->width || frame->normal.height != ao->height))
        return nook_fail(NOOK_E_ARG, "nook_ao_record: normals are %ux%u, the context %ux%u", frame->normal.width,
                         frame->normal.height, ao->width, ao->height);
    if (frame->fetches.native && (frame->fetches.width != ao->width || frame->fetches.height != ao->height))
        return nook_fail(NOOK_E_ARG, "nook_ao_record: the texture of fetches is %ux%u, the context %ux%u",
                         frame->fetches.width, frame->fetches.height, ao->width, ao->height);
    if (!all_finite(p) || !all_finite(frame->view_from_world))
        return nook_fail(NOOK_E_ARG, "nook_ao_record: clip_from_view or view_from_world is not finite");
    if (!is_rigid(frame->view_from_world))
        return nook_fail(NOOK_E_ARG, "nook_ao_record: view_from_world is not rigid; scale the world, not the camera");
    if (!is_perspective(p))
        return nook_fail(NOOK_E_ARG,
                         "nook_ao_record: clip_from_view is not a perspective with w = -z, or its near plane leans");
    return ao_region_check(ao, &frame->part);
}

/**
 * From clip_from_view (column-major p): ndc = (p0 x + p8 z) / -z, so x / -z = (ndc + p8) / p0; and device depth
 * d = p14 / distance - p10, so distance = p14 / (d + p10). p14 > 0 means that near is larger: reversed-Z.
 */
static void set_projection(const double p[16], frame_block *block)
{
    block->ray_scale[0] = (float)(1.0 / p[0]);
    block->ray_scale[1] = (float)(1.0 / p[5]);
    block->ray_offset[0] = (float)(p[8] / p[0]);
    block->ray_offset[1] = (float)(p[9] / p[5]);
    block->depth_to_distance[0] = (float)p[14];
    /* Counted from the background's depth, infinity, which is exact in float: near 1 the rounding of p10 alone would be off by
       as much as a depth buffer of 24 bits. */
    block->depth_background = p[14] > 0.0 ? 0.0f : 1.0f;
    block->depth_to_distance[1] = (float)(p[10] + (double)block->depth_background);
}

static frame_block make_block(const nook_ao *ao, const nook_ao_frame *frame, int counting)
{
    const ao_shared *shared = &ao->shared;
    const ao_region *region = &ao->recorded;
    const uint32_t scale = 1u << ao->scale;
    frame_block block = {
        .size = { (int32_t)nook_groups(ao->width, scale), (int32_t)nook_groups(ao->height, scale) },
        .full_size = { (int32_t)ao->width, (int32_t)ao->height },
        .scale = (int32_t)scale,
        .r_max = shared->r_max,
        .falloff = shared->falloff,
        .falloff_tau = shared->falloff_tau,
        .seed = frame->index,
        .counting = counting,
        .filter_radius = shared->filter_radius,
        .filter_depth = shared->filter_depth,
        .filter_normal = shared->filter_normal,
        .has_normal = frame->normal.native != 0,
        .bins_across = (int32_t)ao->bins.across,
        .refine_weight = shared->refine_weight,
        .refine_reach = shared->refine_reach,
        .support = shared->support,
        .origin = { region->origin[0], region->origin[1] },
        .begin = { region->begin[0], region->begin[1] },
        .end = { region->end[0], region->end[1] },
        .full_begin = { region->full_begin[0], region->full_begin[1] },
        .full_end = { region->full_end[0], region->full_end[1] },
    };
    for (int axis = 0; axis < 2; axis++) {
        block.texel[axis] = 1.0f / (float)block.size[axis];
        block.full_texel[axis] = 1.0f / (float)block.full_size[axis];
    }
    set_projection(frame->clip_from_view, &block);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            block.view_from_world[column * 4 + row] = (float)frame->view_from_world[column * 4 + row];
    }
    return block;
}

/** Of this frame's trace. */
static nook_result fill_bins(nook_ao *ao, const nook_ao_frame *frame)
{
    const uint32_t scale = 1u << ao->scale;
    frame_block projection = { 0 };
    set_projection(frame->clip_from_view, &projection);
    const ao_bin_view view = {
        .size = { nook_groups(ao->width, scale), nook_groups(ao->height, scale) },
        .full_size = { ao->width, ao->height },
        .scale = scale,
        .ray_scale = { projection.ray_scale[0], projection.ray_scale[1] },
        .ray_offset = { projection.ray_offset[0], projection.ray_offset[1] },
        .r_max = (double)ao->shared.r_max,
    };
    return ao_bins_fill(ao->gpu, &ao->bins, &view, ao->gpu_occluders, ao->statistics.occluders);
}

static nook_result upload_inputs(nook_ao *ao, const nook_ao_frame *frame, const ao_work *work)
{
    static const ao_counts zero = { 0 };
    nook_result result = NOOK_OK;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && result == NOOK_OK; kind++)
        result = volume_atlas_flush(&ao->atlases[kind]);
    if (result == NOOK_OK)
        result = brick_pool_flush(&ao->pool);
    if (result != NOOK_OK)
        return result;
    ao_bins_clear(&ao->bins, ao->statistics.occluders);
    if (work->binned)
        result = fill_bins(ao, frame);
    if (result != NOOK_OK)
        return result;
    frame_block block = make_block(ao, frame, work->counting);
    nook_buffer_update(ao->gpu, ao->frame, 0, &block, sizeof block);
    nook_buffer_update(ao->gpu, ao->counter, 0, &zero, sizeof zero);
    if (ao->statistics.occluders)
        nook_buffer_update(ao->gpu, ao->occluder_buffer, 0, ao->gpu_occluders,
                           ao->statistics.occluders * sizeof *ao->gpu_occluders);
    return NOOK_OK;
}

/** Of the kind that this record marches; of surfels and of several kinds no voxel is read. */
static const volume_atlas *marched_atlas(const nook_ao *ao)
{
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        if (ao->kinds == NOOK_VOLUME_BIT(kind))
            return &ao->atlases[kind];
    return &ao->atlases[NOOK_VOLUME_BINARY];
}

static nook_ao_pass make_pass(nook_ao *ao, const nook_ao_frame *frame, uint32_t instances, int direct)
{
    const ao_targets *targets = &ao->targets;
    const ao_trace *trace = &targets->traces[ao->scale];
    const ao_region *region = &ao->recorded;
    const volume_atlas *atlas = marched_atlas(ao);
    int full = ao->scale == 0;
    frame_block projection = { 0 };
    nook_matrix view_from_world;
    set_projection(frame->clip_from_view, &projection);
    memcpy(view_from_world.m, frame->view_from_world, sizeof view_from_world.m);
    return (nook_ao_pass){
        .gpu = ao->gpu,
        .depth = full ? targets->depth : trace->depth,
        .normal = full ? targets->normal : trace->normal,
        .visibility = direct ? targets->visibility : trace->visibility,
        .frame = ao->frame,
        .counter = ao->counter,
        .counting = ao->counting,
        .width = trace->visibility.width,
        .height = trace->visibility.height,
        .begin = { (uint32_t)region->begin[0], (uint32_t)region->begin[1] },
        .end = { (uint32_t)region->end[0], (uint32_t)region->end[1] },
        .origin = { (uint32_t)region->origin[0], (uint32_t)region->origin[1] },
        .r_max = ao->shared.r_max,
        .falloff = ao->shared.falloff,
        .falloff_tau = ao->shared.falloff_tau,
        .ray_scale = { projection.ray_scale[0], projection.ray_scale[1] },
        .ray_offset = { projection.ray_offset[0], projection.ray_offset[1] },
        .view_from_world = view_from_world,
        .lists = ao->supporting || ao->refining == AO_REFINING_TRACED,
        .seed = frame->index,
        .progress = ao->progress,
        .progress_user = ao->progress_user,
        .volume_atlas = atlas->texture,
        .volume_atlas_version = atlas->version,
        .volume_atlas_change_count = atlas->changes.count,
        .volume_atlas_changes = atlas->changes.boxes,
        .bricks = ao->pool.bricks.texture,
        .surfels = ao->pool.surfels.texture,
        .line_max = ao->line_max,
        .occluders = ao->occluder_buffer,
        .occluder_texture = ao->occluder_texture,
        .occluder_count = ao->statistics.occluders,
        .occluders_tested = ao->bins.longest,
        .bins = ao->bins.across ? &ao->bins.buffer : NULL,
        .meshes = ao->mesh_views,
        .mesh_count = ao->mesh_count,
        .instances = ao->instances,
        .instance_count = instances,
    };
}

static void bind_pass(const nook_ao_pass *pass)
{
    nook_bind_uniform(pass->gpu, 0, pass->frame);
    nook_bind_uniform(pass->gpu, 1, pass->params);
    nook_bind_texture(pass->gpu, 0, pass->depth);
    nook_bind_texture(pass->gpu, 1, pass->normal);
    nook_bind_texture(pass->gpu, 2, pass->volume_atlas);
    nook_bind_texture(pass->gpu, 3, pass->occluder_texture);
    nook_bind_texture(pass->gpu, 5, pass->bricks);
    nook_bind_texture(pass->gpu, 6, pass->surfels);
    nook_bind_storage(pass->gpu, AO_BINDING_COUNTER, pass->counter);
    if (pass->bins)
        nook_bind_storage(pass->gpu, BINDING_BINS, *pass->bins);
    nook_bind_image(pass->gpu, 0, pass->visibility, GL_READ_WRITE);
}

static void bind_fetches(nook_ao *ao, const nook_ao_frame *frame)
{
    nook_texture fetches = ao_host_texture(frame->fetches);
    fetches.format = GL_R32UI;
    if (fetches.id)
        nook_bind_image(ao->gpu, BINDING_FETCHES, fetches, GL_READ_WRITE);
}

nook_result ao_begin(nook_ao *ao, const nook_ao_frame *frame, const ao_work *work, nook_ao_pass *out_pass)
{
    nook_result result = check_frame(ao, frame);
    if (result != NOOK_OK)
        return result;
    nook_gpu_check(ao->gpu, "what was done before nook_ao_record"); /* the host's errors are not ours */
    uint32_t instances = 0;
    ao->scale = work->scale;
    ao->counting = work->counting;
    ao->refining = work->refining;
    ao->supporting = work->supporting;
    ao->kinds = work->kinds;
    ao->recorded = ao_region_make(ao, &frame->part, 1u << work->scale, work->passes);
    nook_matrix view_from_world;
    memcpy(view_from_world.m, frame->view_from_world, sizeof view_from_world.m);
    ao->statistics.occluders =
        work->inputs & NOOK_AO_IN_VOLUMES ? ao_collect_volumes(ao, &view_from_world, work->kinds) : 0;
    if (work->inputs & NOOK_AO_IN_MESHES)
        instances = ao_collect_meshes(ao, &view_from_world);
    bind_fetches(ao, frame);
    for (GLuint unit = 0; unit < AO_TEXTURE_UNITS; unit++)
        ao->gpu->gl->BindSampler(unit, 0); /* the host's would change how our textures are sampled */
    result = ao_targets_fit(ao->gpu, &ao->targets, ao->width, ao->height, ao->scale);
    if (result == NOOK_OK && (work->refining || work->supporting))
        result = ao_refine_fit(ao->gpu, &ao->refine, ao->width, ao->height, 1u << ao->scale,
                               (double)ao->shared.refine_share);
    if (result == NOOK_OK)
        result = upload_inputs(ao, frame, work);
    if (result == NOOK_OK)
        result = ao_fill_inputs(ao, frame);
    if (result != NOOK_OK)
        return result;
    *out_pass = make_pass(ao, frame, instances, work->passes == 0);
    if (work->inputs & NOOK_AO_IN_MESHES)
        ao_depth_error(ao->gpu, frame->depth, frame->clip_from_view, out_pass->depth_error);
    return NOOK_OK;
}

/** What ao.refine says, as far as the technique can. */
static int refining_of(const nook_ao *ao, const nook_ao_technique *technique)
{
    return ao->shared.refine == AO_REFINING_TRACED && !technique->refines ? AO_REFINING_AROUND : ao->shared.refine;
}

static ao_work work_of(const nook_ao *ao, const ao_slot *slot, const nook_ao_frame *frame)
{
    const nook_ao_technique *technique = slot->technique;
    uint32_t scale = trace_scale(ao, technique);
    int as_it_is = technique->exact && !(technique->is_filtered && technique->is_filtered(slot->params));
    int direct = scale == 0 && (as_it_is || ao->shared.filter == 0);
    int stepped = scale > 0 && ao->shared.upscale;
    int pixels = frame->counts == NOOK_AO_COUNTS_STEPS ? COUNT_STEPS : COUNT_PIXELS;
    int counting = ao->shared.count * COUNT_SUMS + (frame->fetches.native != 0) * pixels;
    return (ao_work){ .inputs = technique->inputs,
                      .kinds = ao_slot_kinds(slot),
                      .scale = scale,
                      .passes = direct ? 0 : 1 + stepped,
                      .refining = stepped ? refining_of(ao, technique) : AO_REFINING_NOTHING,
                      .supporting =
                          stepped && technique->refines && ao->shared.filter == FILTER_TILE && ao->shared.support > 1,
                      .binned = technique->reads_bins && technique->reads_bins(slot->params),
                      .counting = technique->exact ? 0 : counting /* truth reads nothing of the kind */ };
}

static nook_result trace(nook_ao *ao, const nook_ao_frame *frame, const ao_slot *slot, nook_ao_pass *pass)
{
    bool reuses = ao_reuse_is_wanted(ao, slot);
    nook_result result = reuses ? ao_reuse_choose(ao, frame, slot, pass) : NOOK_OK;
    if (!reuses)
        ao->reuse.holds = false; /* the next one would have to know what has happened meanwhile */
    if (result != NOOK_OK)
        return result;
    if (slot->technique->params_size)
        nook_buffer_update(ao->gpu, slot->buffer, 0, slot->params, slot->technique->params_size);
    pass->params = slot->buffer;
    bind_pass(pass);
    result = slot->technique->record(slot->state, slot->params, pass);
    return reuses && result == NOOK_OK ? ao_reuse_keep(ao, frame, pass) : result;
}

/** Everything that the trace has bound is bound again: filter and upscaling came between. */
static nook_result trace_listed(nook_ao *ao, const ao_slot *slot, nook_ao_pass *pass)
{
    pass->listed = &ao->refine.listed;
    pass->part = 0;                                /* they are in no mean, and would flicker with the parts */
    pass->occluders_tested = pass->occluder_count; /* its groups are no tiles of the picture, and read no bins */
    pass->visibility = ao->refine.traced;
    pass->width = ao->refine.traced.width, pass->height = ao->refine.traced.height;
    bind_pass(pass);
    return slot->technique->record(slot->state, slot->params, pass);
}

/** From the trace to the picture. */
static nook_result finish(nook_ao *ao, const nook_ao_frame *frame, const ao_slot *slot, nook_ao_pass *pass, int stepped)
{
    if (!stepped)
        return ao_filter(ao);
    nook_result result = ao_filter_trace(ao);
    if (result == NOOK_OK && ao->supporting) {
        result = ao_support_gather(ao);
        if (result == NOOK_OK)
            result = trace_listed(ao, slot, pass);
        if (result == NOOK_OK)
            result = ao_support_finish(ao);
    }
    if (result == NOOK_OK)
        result = ao_upscale(ao, frame);
    if (result == NOOK_OK && ao->refining == AO_REFINING_TRACED) {
        result = ao_refine_gather(ao, frame);
        if (result == NOOK_OK)
            result = trace_listed(ao, slot, pass);
        if (result == NOOK_OK)
            result = ao_refine_finish(ao);
    }
    return result;
}

nook_result nook_ao_record(nook_ao *ao, const nook_ao_frame *frame)
{
    const ao_slot *slot = &ao->slots[ao->current];
    nook_ao_pass pass;
    if (ao->slot_count == 0)
        return nook_fail(NOOK_E_ARG, "nook_ao_record: add a technique first");
    ao_work work = work_of(ao, slot, frame);
    nook_result result = ao_ask_for_volumes(ao, work.kinds);
    if (result == NOOK_OK)
        result = ao_begin(ao, frame, &work, &pass);
    if (result != NOOK_OK)
        return result;
    result = trace(ao, frame, slot, &pass);
    if (result == NOOK_OK && work.passes > 0)
        result = finish(ao, frame, slot, &pass, work.passes == 2);
    if (nook_gpu_check(ao->gpu, "nook_ao_record") && result == NOOK_OK)
        result = NOOK_E_DEVICE; /* the check has logged what it was */
    return result;
}

/** Full-size pixels with geometry in the recorded part. */
static uint64_t count_geometry(nook_ao *ao)
{
    const ao_region *region = &ao->recorded;
    size_t count = (size_t)ao->targets.width * ao->targets.height;
    uint64_t seen = 0;
    float *depth = count ? malloc(count * sizeof *depth) : NULL;
    if (!depth)
        return 0;
    nook_texture_read(ao->gpu, ao->targets.depth, GL_RED, GL_FLOAT, depth, count * sizeof *depth);
    for (size_t y = (size_t)region->full_begin[1]; y < (size_t)region->full_end[1]; y++) {
        for (size_t x = (size_t)region->full_begin[0]; x < (size_t)region->full_end[0]; x++)
            seen += depth[y * ao->targets.width + x] > 0.0f;
    }
    free(depth);
    return seen;
}

void nook_ao_get_statistics(nook_ao *ao, nook_ao_statistics *out_statistics)
{
    ao_counts counted;
    *out_statistics = ao->statistics;
    out_statistics->volume_bytes = ao->kinds & NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL)
                                       ? brick_pool_bytes(&ao->pool)
                                       : volume_atlas_bytes(marched_atlas(ao));
    out_statistics->texture_bytes = ao_targets_bytes(&ao->targets, ao->scale) +
                                    (ao->refining || ao->supporting ? ao_refine_bytes(&ao->refine) : 0) +
                                    ao_reuse_bytes(&ao->reuse);
    out_statistics->refined = ao->refining ? ao_refine_count(ao->gpu, &ao->refine) : 0;
    out_statistics->traced = ao_reuse_count_traced(ao);
    out_statistics->fetches_per_pixel = 0.0;
    out_statistics->outside = 0;
    if (!ao->shared.count)
        return;
    ao->gpu->gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    ao->gpu->gl->GetNamedBufferSubData(ao->counter.id, 0, sizeof counted, &counted);
    out_statistics->outside = counted.outside;
    uint64_t pixels = counted.seen ? counted.seen : count_geometry(ao);
    if (pixels)
        out_statistics->fetches_per_pixel =
            ((double)counted.fetches_high * 4294967296.0 + counted.fetches_low) / (double)pixels;
}
