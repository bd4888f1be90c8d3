/* Our own passes around a technique: its inputs before it, filter and upscaling after it. */
#include "modules/ao/ao_internal.h"
#include <stdio.h>

/** The program of a pass, with what all of them read bound. */
static nook_result prepare_pass(nook_ao *ao, const char *path, const char *defines, nook_program *out_program)
{
    char all[128];
    snprintf(all, sizeof all, "%s%s", defines, ao->counting ? "#define COUNTING\n" : "");
    nook_bind_uniform(ao->gpu, 0, ao->frame);
    nook_bind_storage(ao->gpu, AO_BINDING_COUNTER, ao->counter);
    return nook_program_compute(ao->gpu, path, all, out_program);
}

nook_result ao_dispatch_over(nook_ao *ao, const char *path, const char *defines, uint32_t width, uint32_t height)
{
    nook_program program;
    nook_result result = prepare_pass(ao, path, defines, &program);
    if (result == NOOK_OK)
        nook_dispatch(ao->gpu, program, nook_groups(width, 16), nook_groups(height, 8), 1);
    return result;
}

static const char HAS_NORMAL[] = "#define HAS_NORMAL\n";

enum { LOCATION_GATHERING = 0, HOST_TEXTURES = 2, UPSCALE_BILINEAR = 2, DOWNSAMPLE_MAJORITY = 1 };

/** However the host samples its textures, ours is the nearest texel; release_host gives it back. */
static void bind_host(nook_ao *ao, const nook_ao_frame *frame)
{
    nook_bind_texture(ao->gpu, 0, ao_host_texture(frame->depth));
    nook_bind_texture(ao->gpu, 1, ao_host_texture(frame->normal.native ? frame->normal : frame->depth));
    for (GLuint unit = 0; unit < HOST_TEXTURES; unit++)
        ao->gpu->gl->BindSampler(unit, ao->nearest_sampler);
}

static void release_host(nook_ao *ao)
{
    for (GLuint unit = 0; unit < HOST_TEXTURES; unit++)
        ao->gpu->gl->BindSampler(unit, 0);
}

static nook_result dispatch_prepare(nook_ao *ao, const nook_ao_frame *frame, const char *defines, nook_texture depth,
                                    nook_texture normal)
{
    bind_host(ao, frame);
    nook_bind_image(ao->gpu, 0, depth, GL_WRITE_ONLY);
    nook_bind_image(ao->gpu, 1, normal, GL_WRITE_ONLY);
    nook_result result = ao_dispatch_over(ao, "shaders/ao/prepare.comp.glsl", defines, depth.width, depth.height);
    release_host(ao);
    return result;
}

static int is_stepped(const nook_ao *ao)
{
    return ao->scale > 0 && ao->shared.upscale;
}

nook_result ao_fill_inputs(nook_ao *ao, const nook_ao_frame *frame)
{
    ao_targets *targets = &ao->targets;
    ao_trace *trace = &targets->traces[ao->scale];
    nook_result result = NOOK_OK;
    if (!frame->same_view) {
        targets->holds_view = 0;
        for (int i = 0; i < AO_SCALES; i++)
            targets->traces[i].holds_view = 0;
    }
    if (!targets->holds_view && !is_stepped(ao)) { /* whose upscaling reads the host's own */
        result = dispatch_prepare(ao, frame, "", targets->depth, targets->normal);
        targets->holds_view = result == NOOK_OK;
    }
    if (result == NOOK_OK && ao->scale > 0 && (!trace->holds_view || trace->downsample != ao->shared.downsample)) {
        const char *defines = ao->shared.downsample == DOWNSAMPLE_MAJORITY ? "#define AT_TRACE\n#define MAJORITY\n"
                                                                           : "#define AT_TRACE\n";
        result = dispatch_prepare(ao, frame, defines, trace->depth, trace->normal);
        trace->holds_view = result == NOOK_OK;
        trace->downsample = ao->shared.downsample;
    }
    return result;
}

/** Of filter.comp.glsl and refine_filter.comp.glsl. Not a branch of theirs: a software driver would compile all three. */
static const char *filter_define(const nook_ao *ao)
{
    static const char *const defines[] = { "", "#define DISC\n", "#define TILE\n" }; /* in the order of ao.filter */
    return defines[ao->shared.filter];
}

/** What filter.comp.glsl binds. */
static void bind_filter(nook_ao *ao, nook_texture out)
{
    const ao_targets *targets = &ao->targets;
    const ao_trace *trace = &targets->traces[ao->scale];
    nook_bind_texture(ao->gpu, 0, targets->depth);
    nook_bind_texture(ao->gpu, 1, targets->normal);
    nook_bind_texture(ao->gpu, 2, ao->scale > 0 ? trace->depth : targets->depth);
    nook_bind_texture(ao->gpu, 3, ao->scale > 0 ? trace->normal : targets->normal);
    nook_bind_texture(ao->gpu, 4, trace->visibility);
    nook_bind_image(ao->gpu, 0, out, GL_WRITE_ONLY);
}

/** Runs a shader that writes the wanted pixels of the picture. */
static nook_result dispatch_full(nook_ao *ao, const char *path, const char *defines)
{
    const ao_region *region = &ao->recorded;
    return ao_dispatch_over(ao, path, defines, (uint32_t)(region->full_end[0] - region->full_begin[0]),
                            (uint32_t)(region->full_end[1] - region->full_begin[1]));
}

nook_result ao_filter(nook_ao *ao)
{
    bind_filter(ao, ao->targets.visibility);
    return dispatch_full(ao, "shaders/ao/filter.comp.glsl", filter_define(ao));
}

/** Blocks of scale x scale pixels, from half a trace pixel on, that hold pixels begin to end - 1 of an axis: shaders/ao/upscale.comp.glsl. */
static uint32_t count_blocks(int32_t begin, int32_t end, int32_t scale)
{
    return (uint32_t)((end - 1 + scale / 2) / scale - (begin + scale / 2) / scale + 1);
}

/** Brings the filtered trace back to full size. */
static nook_result upscale(nook_ao *ao, int has_normal)
{
    static const char *const path = "shaders/ao/upscale.comp.glsl";
    const ao_region *region = &ao->recorded;
    const int32_t scale = 1 << ao->scale;
    const int bilinear = ao->shared.upscale == UPSCALE_BILINEAR;
    char defines[64];
    snprintf(defines, sizeof defines, "%s%s%s", has_normal ? HAS_NORMAL : "", bilinear ? "#define BILINEAR\n" : "",
             ao->refining ? "#define REFINE\n" : "");
    if (!bilinear)
        return dispatch_full(ao, path, defines);
    return ao_dispatch_over(ao, path, defines, count_blocks(region->full_begin[0], region->full_end[0], scale),
                            count_blocks(region->full_begin[1], region->full_end[1], scale));
}

/** Over what an earlier pass has listed. */
static nook_result dispatch_listed(nook_ao *ao, const char *path, const char *defines, nook_buffer groups)
{
    nook_program program;
    nook_result result = prepare_pass(ao, path, defines, &program);
    if (result == NOOK_OK)
        nook_dispatch_indirect(ao->gpu, program, groups);
    return result;
}

/** Once more, from farther samples, what upscaling has listed. Bound is what that binds. */
static nook_result refine_around(nook_ao *ao, int has_normal)
{
    char defines[64];
    snprintf(defines, sizeof defines, "%s%s", has_normal ? HAS_NORMAL : "",
             ao->refining == AO_REFINING_TRACED ? "#define TRACED\n" : "");
    return dispatch_listed(ao, "shaders/ao/refine_around.comp.glsl", defines, ao->refine.candidates);
}

/** Where the picture has 4 or 16 times the pixels of the trace, most of the filter's work is done once for all of them. */
nook_result ao_filter_trace(nook_ao *ao)
{
    ao_trace *trace = &ao->targets.traces[ao->scale];
    const ao_region *region = &ao->recorded;
    nook_result result = ao_trace_fit_filtered(ao->gpu, trace);
    if (result != NOOK_OK)
        return result;
    char defines[64];
    snprintf(defines, sizeof defines, "#define AT_TRACE\n%s%s", ao->supporting ? "#define SUPPORT\n" : "",
             filter_define(ao));
    bind_filter(ao, trace->filtered);
    if (ao->supporting)
        ao_refine_begin(ao->gpu, &ao->refine);
    return ao_dispatch_over(ao, "shaders/ao/filter.comp.glsl", defines, (uint32_t)(region->end[0] - region->begin[0]),
                            (uint32_t)(region->end[1] - region->begin[1]));
}

/** What both halves of shaders/ao/support.comp.glsl bind, in both: llvmpipe compiles a program for what is bound. */
static nook_result support(nook_ao *ao, bool gathering, nook_buffer groups)
{
    const ao_trace *trace = &ao->targets.traces[ao->scale];
    nook_program program;
    nook_result result = prepare_pass(ao, "shaders/ao/support.comp.glsl", "", &program);
    if (result != NOOK_OK)
        return result;
    ao_refine_bind(ao->gpu, &ao->refine); /* the technique may have bound others, and other textures */
    nook_bind_texture(ao->gpu, 2, trace->depth);
    nook_bind_texture(ao->gpu, 3, trace->normal);
    nook_bind_image(ao->gpu, 0, trace->filtered, GL_READ_WRITE);
    nook_bind_image(ao->gpu, 1, ao->refine.traced, GL_READ_ONLY);
    nook_program_use(ao->gpu, program);
    nook_uniform_int(ao->gpu, LOCATION_GATHERING, &(const int32_t){ gathering }, 1);
    nook_dispatch_indirect(ao->gpu, program, groups);
    return NOOK_OK;
}

nook_result ao_support_gather(nook_ao *ao)
{
    return support(ao, true, ao->refine.candidates);
}

nook_result ao_support_finish(nook_ao *ao)
{
    return support(ao, false, ao->refine.listed);
}

nook_result ao_upscale(nook_ao *ao, const nook_ao_frame *frame)
{
    const ao_trace *trace = &ao->targets.traces[ao->scale];
    bind_host(ao, frame);
    nook_bind_texture(ao->gpu, 2, trace->filtered);
    nook_bind_image(ao->gpu, 0, ao->targets.visibility, GL_WRITE_ONLY);
    if (ao->refining)
        ao_refine_begin(ao->gpu, &ao->refine);
    nook_result result = upscale(ao, frame->normal.native != 0);
    if (result == NOOK_OK && ao->refining)
        result = refine_around(ao, frame->normal.native != 0);
    release_host(ao);
    return result;
}

nook_result ao_refine_gather(nook_ao *ao, const nook_ao_frame *frame)
{
    bind_host(ao, frame);
    nook_bind_image(ao->gpu, 0, ao->targets.visibility, GL_WRITE_ONLY);
    nook_result result = dispatch_listed(ao, "shaders/ao/refine_gather.comp.glsl",
                                         frame->normal.native ? HAS_NORMAL : "", ao->refine.candidates);
    release_host(ao);
    return result;
}

nook_result ao_refine_finish(nook_ao *ao)
{
    ao_refine_bind(ao->gpu, &ao->refine); /* the technique may have bound others */
    nook_bind_image(ao->gpu, 0, ao->targets.visibility, GL_READ_WRITE);
    nook_bind_image(ao->gpu, 1, ao->refine.traced, GL_READ_ONLY);
    nook_result result =
        dispatch_listed(ao, "shaders/ao/refine_filter.comp.glsl", filter_define(ao), ao->refine.listed);
    if (result == NOOK_OK)
        result = dispatch_listed(ao, "shaders/ao/refine_scatter.comp.glsl", "", ao->refine.listed);
    return result;
}
