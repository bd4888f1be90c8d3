#include "modules/trace/pixel_rays.h"
#include "engine/core/surface.h"
#include "engine/core/vector.h"
#include "modules/ao/falloff.h"
#include "modules/ao/sampling.h"
#include "modules/trace/pixel.h"
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

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
    nook_pixel_position(pass, x, y, depth, p);
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
    nook_ray_shift shift;
    const float (*directions)[4]; /**< Around +Z, or NULL. */
} pixel_rays;

static pixel_rays rays_of_pixel(const nook_trace_work *work, uint32_t x, uint32_t y, double depth,
                                const uint16_t code[2])
{
    pixel_rays rays = { .shift = nook_ray_shift_of_pixel(x, y, work->seed) };
    if (work->directions)
        rays.directions = work->directions + (size_t)nook_direction_block(x, y) * work->count;
    double normal[3];
    nook_pixel_normal(code, normal);
    tangent_frame((vec3){ (float)normal[0], (float)normal[1], (float)normal[2] }, rays.view_from_local);
    ray_origin(work->pass, x, y, depth, normal, rays.origin);
    return rays;
}

/** Directions of a packet. @param count  at most NOOK_TRACER_PACKET */
static void aim(const nook_trace_work *work, pixel_rays *rays, uint32_t first, uint32_t count,
                float directions[3][NOOK_TRACER_PACKET])
{
    for (uint32_t i = 0; i < count; i++) {
        vec3 local, direction;
        if (rays->directions)
            memcpy(local, rays->directions[first + i], sizeof local);
        else
            nook_ray_point_direction(&work->points[first + i], &rays->shift, local);
        glm_mat3_mulv(rays->view_from_local, local, direction);
        for (int axis = 0; axis < 3; axis++)
            directions[axis][i] = direction[axis];
    }
}

static double rho(const nook_ao_pass *pass, float distance)
{
    return nook_falloff_evaluate((nook_falloff)pass->falloff, distance, pass->r_max, pass->falloff_tau);
}

/** Sum of rho over a packet. @param count  at most NOOK_TRACER_PACKET */
static double trace_packet(const nook_trace_work *work, pixel_rays *rays, uint32_t first, uint32_t count)
{
    const nook_ao_pass *pass = work->pass;
    float directions[3][NOOK_TRACER_PACKET] = { { 0.0f } }, distances[NOOK_TRACER_PACKET];
    double sum = 0.0;
    aim(work, rays, first, count, directions);
    nook_tracer_distances(work->triangles, rays->origin, (const float(*)[NOOK_TRACER_PACKET])directions, count,
                          (float)pass->r_max, pass->falloff == NOOK_FALLOFF_HARD, distances);
    for (uint32_t i = 0; i < count; i++)
        sum += rho(pass, distances[i]);
    return sum;
}

static uint32_t packet_at(const nook_trace_work *work, uint32_t first)
{
    return work->count - first < NOOK_TRACER_PACKET ? work->count - first : NOOK_TRACER_PACKET;
}

static double trace_pixel(const nook_trace_work *work, uint32_t x, uint32_t y, double depth, const uint16_t code[2])
{
    pixel_rays rays = rays_of_pixel(work, x, y, depth, code);
    double sum = 0.0;
    for (uint32_t first = 0; first < work->count; first += NOOK_TRACER_PACKET)
        sum += trace_packet(work, &rays, first, packet_at(work, first));
    return 1.0 - sum / work->count;
}

void nook_trace_pixels(const nook_trace_work *work, uint32_t begin, uint32_t end, uint32_t y, float *out_row)
{
    for (uint32_t x = begin; x < end; x++) {
        size_t i = (size_t)y * work->pass->width + x;
        double depth = work->depth[i];
        out_row[x] = depth > 0.0 ? (float)trace_pixel(work, x, y, depth, work->normal + 2 * i) : 1.0f;
    }
}

double nook_trace_shares(const nook_trace_work *work, uint32_t x, uint32_t y, double *shares)
{
    size_t at = (size_t)y * work->pass->width + x;
    double depth = work->depth[at], sum = 0.0;
    if (!(depth > 0.0))
        return 1.0;
    pixel_rays rays = rays_of_pixel(work, x, y, depth, work->normal + 2 * at);
    for (uint32_t first = 0; first < work->count; first += NOOK_TRACER_PACKET) {
        float directions[3][NOOK_TRACER_PACKET] = { { 0.0f } }, distances[NOOK_TRACER_PACKET];
        uint32_t instances[NOOK_TRACER_PACKET], count = packet_at(work, first);
        aim(work, &rays, first, count, directions);
        nook_tracer_hits(work->triangles, rays.origin, (const float(*)[NOOK_TRACER_PACKET])directions, count,
                         (float)work->pass->r_max, distances, instances);
        for (uint32_t i = 0; i < count; i++) {
            double part = rho(work->pass, distances[i]) / work->count;
            sum += part;
            if (instances[i] < work->pass->instance_count)
                shares[instances[i]] += part;
        }
    }
    return 1.0 - sum;
}
