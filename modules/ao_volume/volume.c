#include "modules/ao_volume/volume.h"
#include "modules/ao/direction_texture.h"
#include "modules/ao_volume/boxes.h"
#include "modules/ao_volume/corners.h"
#include "modules/ao_volume/cut_internal.h"
#include "modules/ao_volume/limits.def"
#include "modules/bake/volume_file.h"

#define NOOK_PARAM_STRUCT volume_params
#define NOOK_PARAM_FILE "modules/ao_volume/params.def"
#include "engine/core/param_block.inl"
#include <stdio.h>

enum { COMBINE_MULTIPLY = 0, SAMPLING_CORNERS = 1, PATH_RASTER = 1, GUARD_SEEN = 2 };
enum {
    TILE_SIZE = 8,
    BINDING_DIRECTIONS = 4,
    BINDING_AGAIN = 5,
    BINDING_CORNERS = 7,
    BINDING_VISIBILITY = 0,
    BINDING_KEPT = 1
};
enum { LOCATION_PART = 0, LOCATION_OCCLUDERS = 1, LOCATION_OF_LIST = 2 };

/**
 * Loop turns of a ray in a volume of surfels, densities or distances as a rule, counted in rooms and around single objects, where the
 * longest through surfels took 77.
 */
enum { TURNS_USUALLY = 128 };

typedef struct volume_state {
    nook_direction_texture directions;
    nook_buffer again; /**< Groups x, y, z of dispatches that do the work again: none until loops were ended. */
    volume_corners corners;
    volume_boxes boxes;
    nook_texture
        kept[2]; /**< Of the trace's and of a list's size, R32F or, of surfels, RGBA32F; id 0 until a cut needs it. */
} volume_state;

static nook_result create(void *state, nook_gpu *gpu)
{
    volume_state *s = state;
    return nook_buffer_create(gpu, NULL, 3 * sizeof(GLuint), &s->again);
}

static void destroy(void *state, nook_gpu *gpu)
{
    volume_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
    nook_buffer_destroy(gpu, &s->again);
    nook_texture_destroy(gpu, &s->kept[0]);
    nook_texture_destroy(gpu, &s->kept[1]);
    volume_corners_release(&s->corners, gpu);
    volume_boxes_release(&s->boxes, gpu);
}

static uint32_t at_most(uint32_t highest, uint32_t value)
{
    return value < highest ? value : highest;
}

/**
 * Union takes a ray's occluders one after the other, the product an occluder's rays.
 * @param groups  of each dispatch, on the GPU; NULL: all of the trace
 */
static void dispatch_parts(const nook_ao_pass *pass, const volume_work *work, const volume_cut *cut,
                           nook_program program, const nook_buffer *groups)
{
    uint32_t ray_parts = nook_groups(work->rays, cut->rays);
    uint32_t occluder_parts = nook_groups(work->occluders, cut->occluders), all[2];
    nook_ao_pass_groups(pass, TILE_SIZE, TILE_SIZE, all);
    for (uint32_t i = 0; i < ray_parts * occluder_parts; i++) {
        uint32_t ray = cut->rays * (work->multiply ? i % ray_parts : i / occluder_parts);
        uint32_t occluder = cut->occluders * (work->multiply ? i / ray_parts : i % occluder_parts);
        const int32_t part[4] = { (int32_t)ray, (int32_t)at_most(work->rays, ray + cut->rays), (int32_t)occluder,
                                  (int32_t)at_most(work->occluders, occluder + cut->occluders) };
        nook_uniform_int(pass->gpu, LOCATION_PART, part, 4);
        if (groups)
            nook_dispatch_indirect(pass->gpu, program, *groups);
        else
            nook_dispatch(pass->gpu, program, all[0], all[1], 1);
    }
}

/** Fits and binds the image for what waits from one dispatch to the next. */
static nook_result bind_kept(volume_state *s, const nook_ao_pass *pass, uint32_t format)
{
    nook_texture *kept = &s->kept[pass->listed != NULL];
    if (kept->id == 0 || kept->format != format || kept->width != pass->width || kept->height != pass->height) {
        nook_texture_destroy(pass->gpu, kept);
        nook_result result = nook_texture_create_2d(pass->gpu, format, pass->width, pass->height, GL_NEAREST, kept);
        if (result != NOOK_OK)
            return result;
    }
    nook_bind_image(pass->gpu, BINDING_KEPT, *kept, GL_READ_WRITE);
    return NOOK_OK;
}

/** A shader, and how much there is to do for it. */
typedef struct volume_task {
    nook_program program;
    volume_work usual, most; /**< As a rule, and at the most. */
    uint32_t kept_format;
} volume_task;

/**
 * The likely cut first. When it was not sure and the shader found that its loops were ended, everything is done again, carefully; else
 * those dispatches have no groups. The GPU knows which: nobody waits for it.
 */
static nook_result trace(volume_state *s, const nook_ao_pass *pass, const volume_task *task)
{
    const nook_buffer *groups = pass->listed ? pass->listed : pass->tiles;
    const GLuint nothing[3] = { 0, 0, 1 };
    volume_cut likely = volume_cut_likely(&task->usual), careful = volume_cut_careful(&task->most);
    likely.sure = likely.sure && task->usual.steps == task->most.steps;
    if (volume_cut_needs_image(&task->usual, &likely) || volume_cut_needs_image(&task->most, &careful)) {
        nook_result result = bind_kept(s, pass, task->kept_format);
        if (result != NOOK_OK)
            return result;
    } else { /* nothing waits: something that is always the same, or llvmpipe compiles the program for whatever is bound there */
        nook_bind_image(pass->gpu, BINDING_KEPT, pass->visibility, GL_READ_WRITE);
    }
    nook_buffer_update(pass->gpu, s->again, 0, nothing, sizeof nothing);
    nook_bind_storage(pass->gpu, BINDING_AGAIN, s->again);
    if (pass->tiles)
        nook_bind_storage(pass->gpu, NOOK_AO_BINDING_TILES, *pass->tiles);
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    nook_bind_image(pass->gpu, BINDING_VISIBILITY, pass->visibility, GL_READ_WRITE);
    nook_program_use(pass->gpu, task->program);
    nook_uniform_int(pass->gpu, LOCATION_OCCLUDERS, &(const int32_t){ (int32_t)pass->occluder_count }, 1);
    if (pass->lists)
        nook_uniform_int(pass->gpu, LOCATION_OF_LIST, &(const int32_t){ pass->listed != NULL }, 1);
    dispatch_parts(pass, &task->usual, &likely, task->program, groups);
    if (!likely.sure)
        dispatch_parts(pass, &task->most, &careful, task->program, &s->again);
    return NOOK_OK;
}

static void leave_open(const nook_ao_pass *pass)
{
    const float open[4] = { 1.0f, 1.0f, 1.0f, 1.0f };
    if (pass->listed)
        pass->gpu->gl->ClearTexImage(pass->visibility.id, 0, GL_RGBA, GL_FLOAT, open);
    else
        pass->gpu->gl->ClearTexSubImage(pass->visibility.id, 0, (GLint)pass->begin[0], (GLint)pass->begin[1], 0,
                                        (GLsizei)(pass->end[0] - pass->begin[0]),
                                        (GLsizei)(pass->end[1] - pass->begin[1]), 1, GL_RGBA, GL_FLOAT, open);
}

static uint32_t volume_kind(const void *params)
{
    const volume_params *p = params;
    return (uint32_t)p->kind; /* the choices of params.def stand in the order of nook_volume_kind */
}

/** Boxes that are drawn blend over all that they cover. */
static uint32_t is_reusable(const void *params)
{
    const volume_params *p = params;
    return p->path != PATH_RASTER;
}

/** Boxes that are drawn find their pixels themselves. */
static uint32_t reads_bins(const void *params)
{
    const volume_params *p = params;
    return p->path != PATH_RASTER;
}

/** Boxes that are drawn blend, and a list of points is multiplied as they are. */
static int multiplies(const volume_params *p)
{
    return p->combine == COMBINE_MULTIPLY || p->path == PATH_RASTER;
}

static volume_task make_task(const volume_params *p, const nook_ao_pass *pass)
{
    uint32_t out = p->guard == GUARD_SEEN ? VOLUME_TURNS_OUT : 0; /* once for all rays, but they may be in parts */
    const volume_work work = { (uint32_t)p->rays, (uint32_t)p->steps + out, pass->occluder_count, multiplies(p),
                               pass->occluders_tested };
    volume_task task = { .usual = work, .most = work, .kept_format = GL_R32F };
    if (p->kind != NOOK_VOLUME_BINARY) {
        task.most.steps = VOLUME_TURNS_PER_VOXEL * pass->line_max;
        task.usual.steps = at_most(TURNS_USUALLY, task.most.steps);
        task.kept_format = p->kind == NOOK_VOLUME_DISTANCE ? GL_R32F : GL_RGBA32F;
    }
    return task;
}

/** As the papers draw it, cut so that it holds whatever meets what: what was blended cannot be done again. */
static nook_result draw(volume_state *s, const nook_ao_pass *pass, const volume_task *task)
{
    volume_cut cut = volume_cut_careful(&task->most);
    if (cut.rays < task->most.rays) {
        nook_result result = bind_kept(s, pass, task->kept_format);
        if (result != NOOK_OK)
            return result;
    }
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    leave_open(pass);
    return volume_boxes_draw(&s->boxes, pass, task->program, &task->most, &cut);
}

/** Boxes cover pixels of the trace; points of a list are multiplied by the other path. */
static int is_drawn(const volume_params *p, const nook_ao_pass *pass)
{
    return p->path == PATH_RASTER && !pass->listed;
}

/** The shader of these parameters, with what it reads of the volumes bound. */
static nook_result choose_program(volume_state *s, const volume_params *p, const nook_ao_pass *pass,
                                  nook_program *out_program)
{
    static const char *const computed[NOOK_VOLUME_KINDS] = {
        [NOOK_VOLUME_BINARY] = "shaders/ao/volume.comp.glsl",
        [NOOK_VOLUME_DENSITY] = "shaders/ao/density.comp.glsl",
        [NOOK_VOLUME_SURFEL] = "shaders/ao/surfel.comp.glsl",
        [NOOK_VOLUME_DISTANCE] = "shaders/ao/distance.comp.glsl",
    };
    static const char *const drawn[NOOK_VOLUME_KINDS] = {
        [NOOK_VOLUME_BINARY] = "shaders/ao/volume.frag.glsl",
        [NOOK_VOLUME_DENSITY] = "shaders/ao/density.frag.glsl",
        [NOOK_VOLUME_SURFEL] = "shaders/ao/surfel.frag.glsl",
        [NOOK_VOLUME_DISTANCE] = "shaders/ao/distance.frag.glsl",
    };
    char defines[128];
    int corners = p->kind == NOOK_VOLUME_BINARY && p->sampling == SAMPLING_CORNERS;
    nook_result result = corners ? volume_corners_fit(&s->corners, pass) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    if (corners)
        nook_bind_texture(pass->gpu, BINDING_CORNERS, s->corners.texture);
    snprintf(defines, sizeof defines, "%s%s%s%s%s", corners ? "#define CORNERS\n" : "",
             multiplies(p) ? "#define MULTIPLY\n" : "", pass->tiles ? "#define TILES\n" : "",
             pass->bins ? "#define BINNED\n" : "", nook_ao_pass_defines(pass, !is_drawn(p, pass)));
    if (is_drawn(p, pass))
        return nook_program_raster(pass->gpu, "shaders/ao/volume_box.vert.glsl", drawn[p->kind], defines, out_program);
    return nook_program_compute(pass->gpu, computed[p->kind], defines, out_program);
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    volume_state *s = state;
    const volume_params *p = params;
    if (pass->occluder_count == 0) {
        leave_open(pass);
        return NOOK_OK;
    }
    volume_task task = make_task(p, pass);
    nook_result result = nook_direction_texture_fit(&s->directions, pass->gpu, task.most.rays, pass->seed, pass->part);
    if (result == NOOK_OK)
        result = choose_program(s, p, pass, &task.program);
    if (result != NOOK_OK)
        return result;
    return is_drawn(p, pass) ? draw(s, pass, &task) : trace(s, pass, &task);
}

const nook_ao_technique nook_ao_volume_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "volume",
    .summary = "Rays marched through precomputed voxel volumes; sees what the camera does not",
    .inputs = NOOK_AO_IN_VOLUMES,
    .volume_kind = volume_kind,
    .reads_bins = reads_bins,
    .refines = 1,
    .is_reusable = is_reusable,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(volume_params),
    .state_size = sizeof(volume_state),
    .state_version = 6,
    .create = create,
    .destroy = destroy,
    .record = record,
};
