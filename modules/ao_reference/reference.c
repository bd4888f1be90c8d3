#include "modules/ao_reference/reference.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/ao/sampling.h"
#include "modules/ao_reference/depth_mesh_internal.h"
#include "modules/trace/pixel_rays.h"
#include <stdlib.h>

#define NOOK_PARAM_STRUCT reference_params
#define NOOK_PARAM_FILE "modules/ao_reference/params.def"
#include "engine/core/param_block.inl"

/** One record's work on the CPU. */
typedef struct image_work {
    const nook_ao_pass *pass;
    nook_trace_work rays;
    uint32_t first_row;
    float *visibility; /**< width * height. */
} image_work;

enum { BAND_ROWS = 8 /* rows between two calls of progress */ };

typedef struct reference_state {
    nook_tracer *tracer;
} reference_state;

static void trace_rows(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    const image_work *work = user;
    uint32_t width = work->pass->width;
    for (size_t row = work->first_row + first; row < work->first_row + last; row++) {
        nook_trace_pixels(&work->rays, work->pass->begin[0], work->pass->end[0], (uint32_t)row,
                          work->visibility + row * width);
    }
}

static void trace_image(image_work *work, unsigned threads)
{
    uint32_t begin = work->pass->begin[1], end = work->pass->end[1];
    for (work->first_row = begin; work->first_row < end; work->first_row += BAND_ROWS) {
        uint32_t rows = end - work->first_row < BAND_ROWS ? end - work->first_row : BAND_ROWS;
        nook_parallel_for(rows, threads, trace_rows, work);
        work->pass->progress(work->pass->progress_user, (double)(work->first_row + rows - begin) / (end - begin));
    }
}

/** The wanted pixels, row by row out of the whole picture. */
static void write_wanted(const nook_ao_pass *pass, const float *visibility)
{
    const nook_gl *gl = pass->gpu->gl;
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, (GLint)pass->width);
    gl->TextureSubImage2D(pass->visibility.id, 0, (GLint)pass->begin[0], (GLint)pass->begin[1],
                          (GLsizei)(pass->end[0] - pass->begin[0]), (GLsizei)(pass->end[1] - pass->begin[1]), GL_RED,
                          GL_FLOAT, visibility + (size_t)pass->begin[1] * pass->width + pass->begin[0]);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

enum { SEES_SCENE, SEES_SCREEN };       /* the choices of reference.sees */
enum { SAMPLING_PIXEL, SAMPLING_TILE }; /* and of reference.sampling */

static uint32_t is_filtered(const void *params)
{
    return ((const reference_params *)params)->sampling == SAMPLING_TILE;
}

/** Bytes a ray takes: a direction for each block, or a point. */
static size_t bytes_per_ray(const reference_params *params)
{
    return is_filtered(params) ? NOOK_DIRECTION_BLOCKS * 4 * sizeof(float) : sizeof(nook_ray_point);
}

/** Points, or directions in their place. */
static void fill_rays(const reference_params *params, void *memory, nook_trace_work *out)
{
    out->count = (uint32_t)params->rays;
    if (is_filtered(params)) {
        nook_fill_directions(out->count, out->seed, 0, memory);
        out->directions = (const float(*)[4])memory;
    } else {
        nook_ray_points_fill(memory, out->count);
        out->points = memory;
    }
}

static nook_result show_screen(nook_tracer *t, const nook_ao_pass *pass, const float *depth, const uint16_t *normal)
{
    depth_mesh mesh;
    nook_result result = depth_mesh_create(pass, depth, normal, &mesh);
    if (result != NOOK_OK)
        return result;
    result = nook_tracer_update_triangles(t, mesh.positions, mesh.vertex_count, mesh.indices, mesh.index_count);
    depth_mesh_free(&mesh);
    return result;
}

/** Everything the trace needs in one block: rays, depth, visibility, normals. */
static nook_result trace_with_memory(const nook_ao_pass *pass, const reference_params *params, nook_tracer *t,
                                     void *memory)
{
    size_t pixels = (size_t)pass->width * pass->height;
    float *depth = (float *)(void *)((char *)memory + (size_t)params->rays * bytes_per_ray(params));
    float *visibility = depth + pixels;
    uint16_t *normal = (uint16_t *)(void *)(visibility + pixels);
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, depth, pixels * sizeof *depth);
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_UNSIGNED_SHORT, normal, pixels * 2 * sizeof *normal);
    nook_result result =
        params->sees == SEES_SCREEN ? show_screen(t, pass, depth, normal) : nook_tracer_update(t, pass);
    if (result != NOOK_OK)
        return result;
    image_work work = { .pass = pass,
                        .rays = { .pass = pass, .triangles = t, .depth = depth, .normal = normal, .seed = pass->seed },
                        .visibility = visibility };
    fill_rays(params, memory, &work.rays);
    trace_image(&work, (unsigned)params->threads);
    write_wanted(pass, visibility);
    return NOOK_OK;
}

static nook_result create(void *state, nook_gpu *gpu)
{
    (void)gpu;
    reference_state *s = state;
    return nook_tracer_create(0, &s->tracer);
}

static void destroy(void *state, nook_gpu *gpu)
{
    (void)gpu;
    reference_state *s = state;
    nook_tracer_destroy(s->tracer);
    s->tracer = NULL;
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    reference_state *s = state;
    const reference_params *p = params;
    size_t pixels = (size_t)pass->width * pass->height;
    void *memory = malloc((size_t)p->rays * bytes_per_ray(p) + 3 * pixels * sizeof(float));
    if (!memory)
        return nook_fail(NOOK_E_MEMORY, "reference: no memory for %ux%u pixels", pass->width, pass->height);
    nook_result result = trace_with_memory(pass, p, s->tracer, memory);
    free(memory);
    return result;
}

const nook_ao_technique nook_ao_reference_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "reference",
    .summary = "Rays cast against the triangles on the CPU: the truth the others are measured against",
    .inputs = NOOK_AO_IN_MESHES,
    .exact = 1,
    .is_filtered = is_filtered,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(reference_params),
    .state_size = sizeof(reference_state),
    .state_version = 1,
    .create = create,
    .destroy = destroy,
    .record = record,
};
