#include "modules/ao_reference/reference.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "engine/core/surface.h"
#include "engine/core/vector.h"
#include "modules/ao/falloff.h"
#include "modules/ao_reference/depth_mesh_internal.h"
#include "modules/ao_reference/pixel_internal.h"
#include "modules/ao_reference/ray_points_internal.h"
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
    const float *depth;      /**< width * height. */
    const uint16_t *normal;  /**< RG pairs. */
    const ray_point *points; /**< As many as rays, by their place. */
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

/** What a pixel's rays have in common. */
typedef struct pixel_rays {
    float origin[3];
    mat3 view_from_local;
    ray_shift shift;
} pixel_rays;

static pixel_rays rays_of_pixel(const nook_ao_pass *pass, uint32_t x, uint32_t y, double depth, const uint16_t code[2])
{
    pixel_rays rays = { .shift = ray_shift_of_pixel(x, y, pass->seed) };
    double normal[3];
    reference_decode_normal(code, normal);
    tangent_frame((vec3){ (float)normal[0], (float)normal[1], (float)normal[2] }, rays.view_from_local);
    ray_origin(pass, x, y, depth, normal, rays.origin);
    return rays;
}

/** Sum of rho over a packet. @param count  at most TRACER_PACKET */
static double trace_packet(const trace_work *work, pixel_rays *rays, const ray_point *points, uint32_t count)
{
    const nook_ao_pass *pass = work->pass;
    float directions[3][TRACER_PACKET] = { { 0.0f } }, distances[TRACER_PACKET];
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        vec3 local, direction;
        ray_point_direction(&points[i], &rays->shift, local);
        glm_mat3_mulv(rays->view_from_local, local, direction);
        for (int axis = 0; axis < 3; axis++)
            directions[axis][i] = direction[axis];
    }
    tracer_distances(work->tracer, rays->origin, (const float(*)[TRACER_PACKET])directions, count, (float)pass->r_max,
                     pass->falloff == NOOK_FALLOFF_HARD, distances);
    for (uint32_t i = 0; i < count; i++)
        sum += nook_falloff_evaluate((nook_falloff)pass->falloff, distances[i], pass->r_max, pass->falloff_tau);
    return sum;
}

static double trace_pixel(const trace_work *work, uint32_t x, uint32_t y, double depth, const uint16_t code[2])
{
    pixel_rays rays = rays_of_pixel(work->pass, x, y, depth, code);
    double sum = 0.0;
    for (uint32_t first = 0; first < work->rays; first += TRACER_PACKET) {
        uint32_t left = work->rays - first;
        sum += trace_packet(work, &rays, work->points + first, left < TRACER_PACKET ? left : TRACER_PACKET);
    }
    return 1.0 - sum / work->rays;
}

static void trace_rows(void *user, size_t first, size_t last, unsigned worker)
{
    (void)worker;
    const trace_work *work = user;
    uint32_t width = work->pass->width;
    for (size_t row = work->first_row + first; row < work->first_row + last; row++) {
        for (uint32_t x = work->pass->begin[0]; x < work->pass->end[0]; x++) {
            size_t i = row * width + x;
            double depth = work->depth[i];
            work->visibility[i] =
                depth > 0.0 ? (float)trace_pixel(work, x, (uint32_t)row, depth, work->normal + 2 * i) : 1.0f;
        }
    }
}

static void trace_image(trace_work *work, unsigned threads)
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

/** Everything the trace needs in one block: points, depth, visibility, normals. */
static nook_result trace_with_memory(const nook_ao_pass *pass, const reference_params *params, tracer *t, void *memory)
{
    size_t pixels = (size_t)pass->width * pass->height;
    ray_point *points = memory;
    float *depth = (float *)(void *)(points + params->rays), *visibility = depth + pixels;
    uint16_t *normal = (uint16_t *)(void *)(visibility + pixels);
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, depth, pixels * sizeof *depth);
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_UNSIGNED_SHORT, normal, pixels * 2 * sizeof *normal);
    nook_result result = params->sees == SEES_SCREEN ? show_screen(t, pass, depth, normal) : tracer_update(t, pass);
    if (result != NOOK_OK)
        return result;
    ray_points_fill(points, (uint32_t)params->rays);
    trace_work work = { .pass = pass,
                        .tracer = t,
                        .depth = depth,
                        .normal = normal,
                        .points = points,
                        .rays = (uint32_t)params->rays,
                        .visibility = visibility };
    trace_image(&work, (unsigned)params->threads);
    write_wanted(pass, visibility);
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
    void *memory = malloc((size_t)p->rays * sizeof(ray_point) + 3 * pixels * sizeof(float));
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
