#include "modules/ao_reference/reference.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "engine/core/surface.h"
#include "engine/core/vector.h"
#include "modules/ao/falloff.h"
#include "modules/ao/sampling.h"
#include "modules/ao_reference/depth_mesh_internal.h"
#include "modules/ao_reference/pixel_internal.h"
#include "modules/ao_reference/tracer_internal.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NOOK_PARAM_STRUCT reference_params
#define NOOK_PARAM_FILE "modules/ao_reference/params.def"
#include "engine/core/param_block.inl"

enum { BAND_ROWS = 8 /* rows between two calls of progress */ };

typedef struct reference_state {
    tracer *tracer;
} reference_state;

/** One record's work on the CPU. */
typedef struct trace_work {
    const nook_ao_pass *pass;
    const tracer *tracer;
    const float *depth;     /**< width * height. */
    const uint16_t *normal; /**< RG pairs. */
    const float *points;    /**< Sobol points, xy * rays. */
    uint32_t rays, first_row;
    float *visibility;
} trace_work;

/**
 * Columns: two tangents and the normal (Duff et al., "Building an Orthonormal Basis, Revisited", 2017). In float: the
 * normal's own steps are 100 times coarser than its rounding, and Embree takes directions in float.
 */
static void tangent_frame(vec3 n, mat3 frame)
{
    float s = n[2] >= 0.0f ? 1.0f : -1.0f, a = -1.0f / (s + n[2]), c = n[0] * n[1] * a;
    frame[0][0] = 1.0f + s * n[0] * n[0] * a, frame[0][1] = s * c, frame[0][2] = -s * n[0];
    frame[1][0] = c, frame[1][1] = s + n[1] * n[1] * a, frame[1][2] = -n[1];
    glm_vec3_copy(n, frame[2]);
}

/**
 * Where rays start: the pixel's point, lifted along the normal past the rounding of its depth (24 bits, and as much again in
 * the rasteriser) and of Embree's own arithmetic, which grow with the distance from the camera; and past what a coarser depth
 * buffer cannot tell, as far as that leads off the surface.
 */
static void ray_origin(const nook_ao_pass *pass, uint32_t x, uint32_t y, double depth, const double n[3], float out[3])
{
    double p[3];
    reference_pixel_position(pass, x, y, depth, p);
    double off = pass->depth_error[0] * depth + pass->depth_error[1] * depth * depth;
    double facing = fabs(nook_vector_dot(p, n)) / depth;
    double lift = fmax(NOOK_SURFACE_ROUNDING * (fabs(p[0]) + fabs(p[1]) + fabs(p[2])), off * facing);
    for (int axis = 0; axis < 3; axis++)
        out[axis] = (float)(p[axis] + n[axis] * lift);
}

static double trace_pixel(const trace_work *work, uint32_t x, uint32_t y, double depth, const uint16_t code[2])
{
    const nook_ao_pass *pass = work->pass;
    vec3 origin;
    mat3 view_from_local;
    double normal[3], sum = 0.0;
    reference_decode_normal(code, normal);
    tangent_frame((vec3){ (float)normal[0], (float)normal[1], (float)normal[2] }, view_from_local);
    ray_origin(pass, x, y, depth, normal, origin);
    uint32_t h = nook_mix_bits(x + nook_mix_bits(y + nook_mix_bits(pass->seed)));
    float shift_x = (float)(h >> 8) / 16777216.0f, shift_y = (float)(nook_mix_bits(h) >> 8) / 16777216.0f;
    int any = pass->falloff == NOOK_FALLOFF_HARD;
    for (uint32_t i = 0; i < work->rays; i++) {
        float point[2] = { work->points[2 * i] + shift_x, work->points[2 * i + 1] + shift_y };
        vec3 local, direction;
        point[0] -= point[0] >= 1.0f ? 1.0f : 0.0f;
        point[1] -= point[1] >= 1.0f ? 1.0f : 0.0f;
        nook_cosine_direction(point, local);
        glm_mat3_mulv(view_from_local, local, direction);
        float distance = tracer_distance(work->tracer, origin, direction, (float)pass->r_max, any);
        sum += nook_falloff_evaluate((nook_falloff)pass->falloff, distance, pass->r_max, pass->falloff_tau);
    }
    return 1.0 - sum / work->rays;
}

static void trace_rows(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    const trace_work *work = user;
    uint32_t width = work->pass->width;
    for (size_t row = work->first_row + first; row < work->first_row + last; row++) {
        for (uint32_t x = 0; x < width; x++) {
            size_t i = row * width + x;
            double depth = work->depth[i];
            work->visibility[i] =
                depth > 0.0 ? (float)trace_pixel(work, x, (uint32_t)row, depth, work->normal + 2 * i) : 1.0f;
        }
    }
}

static void trace_image(trace_work *work, unsigned threads)
{
    uint32_t height = work->pass->height;
    for (work->first_row = 0; work->first_row < height; work->first_row += BAND_ROWS) {
        uint32_t rows = height - work->first_row < BAND_ROWS ? height - work->first_row : BAND_ROWS;
        nook_parallel_for(rows, threads, trace_rows, work);
        work->pass->progress(work->pass->progress_user, (double)(work->first_row + rows) / height);
    }
}

enum { SEES_SCENE, SEES_SCREEN }; /* the choices of reference.sees */

static nook_result show_screen(tracer *t, const nook_ao_pass *pass, const float *depth, const uint16_t *normal)
{
    depth_mesh mesh;
    nook_result result = depth_mesh_create(pass, depth, normal, &mesh);
    if (result != NOOK_OK)
        return result;
    result = tracer_update_triangles(t, mesh.positions, mesh.vertex_count, mesh.indices, mesh.index_count);
    depth_mesh_free(&mesh);
    return result;
}

/** Everything the trace needs in one block: depth, visibility, points, normals. */
static nook_result trace_with_memory(const nook_ao_pass *pass, const reference_params *params, tracer *t, float *memory)
{
    size_t pixels = (size_t)pass->width * pass->height;
    float *depth = memory, *visibility = depth + pixels, *points = visibility + pixels;
    uint16_t *normal = (uint16_t *)(void *)(points + 2 * (size_t)params->rays);
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, depth, pixels * sizeof *depth);
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_UNSIGNED_SHORT, normal, pixels * 2 * sizeof *normal);
    nook_result result = params->sees == SEES_SCREEN ? show_screen(t, pass, depth, normal) : tracer_update(t, pass);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < (uint32_t)params->rays; i++)
        nook_sobol_point(i, 0, points + 2 * i);
    trace_work work = { .pass = pass,
                        .tracer = t,
                        .depth = depth,
                        .normal = normal,
                        .points = points,
                        .rays = (uint32_t)params->rays,
                        .visibility = visibility };
    trace_image(&work, (unsigned)params->threads);
    pass->gpu->gl->TextureSubImage2D(pass->visibility.id, 0, 0, 0, (GLsizei)pass->width, (GLsizei)pass->height, GL_RED,
                                     GL_FLOAT, visibility);
    return NOOK_OK;
}

static nook_result create(void *state, nook_gpu *gpu)
{
    (void)gpu;
    reference_state *s = state;
    return tracer_create(&s->tracer);
}

static void destroy(void *state, nook_gpu *gpu)
{
    (void)gpu;
    reference_state *s = state;
    tracer_destroy(s->tracer);
    s->tracer = NULL;
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    reference_state *s = state;
    const reference_params *p = params;
    size_t pixels = (size_t)pass->width * pass->height;
    float *memory = malloc((3 * pixels + 2 * (size_t)p->rays) * sizeof *memory);
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
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(reference_params),
    .state_size = sizeof(reference_state),
    .state_version = 1,
    .create = create,
    .destroy = destroy,
    .record = record,
};
