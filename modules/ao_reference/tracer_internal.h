/** tracer_internal.h - Embree behind plain data: meshes once, instances every frame; or triangles of this frame alone. */
#pragma once
#include "modules/ao/technique.h"

typedef struct tracer tracer;

/** @param threads  that build; 0: all cores @return NOOK_E_DEVICE, NOOK_E_MEMORY */
nook_result tracer_create(unsigned threads, tracer **out_tracer);
void tracer_destroy(tracer *t); /**< NULL is allowed. */

/** Builds what changed since the last call: meshes by their id, instances always. @return NOOK_E_MEMORY */
nook_result tracer_update(tracer *t, const nook_ao_pass *pass);

/** Only these triangles, in view space, until the next of either call; the scene's meshes are kept. @return NOOK_E_MEMORY */
nook_result tracer_update_triangles(tracer *t, const float *positions, uint32_t vertex_count, const uint32_t *indices,
                                    uint32_t index_count);

/** As many rays as one traversal takes: packets of eight are native to AVX, and split up where there is none. */
enum { TRACER_PACKET = 8 };

/**
 * Distances of the first triangle along unit rays from one point, view space; the closer the rays lie together, the faster.
 * Thread-safe between updates.
 * @param directions  x of all rays, y of all, z of all
 * @param count       of rays, at most TRACER_PACKET
 * @param any         1: any triangle will do; the distance is then only a lower end of the truth (0)
 * @param out         count of them: infinity on a miss within (0, limit)
 */
void tracer_distances(const tracer *t, const float origin[3], const float directions[3][TRACER_PACKET], uint32_t count,
                      float limit, int any, float *out);

/**
 * The same, always with the first triangle, and whose it is.
 * @param out_instances  count of them: into the pass's instances; UINT32_MAX on a miss, and for triangles of no instance
 */
void tracer_hits(const tracer *t, const float origin[3], const float directions[3][TRACER_PACKET], uint32_t count,
                 float limit, float *out_distances, uint32_t *out_instances);
