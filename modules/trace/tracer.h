/** tracer.h - Embree behind plain data: meshes once, instances every frame; or triangles of this frame alone. */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Triangles that rays can meet; owns what Embree built of them. */
typedef struct nook_tracer nook_tracer;

/** @param threads  that build; 0: all cores @return NOOK_E_DEVICE, NOOK_E_MEMORY */
nook_result nook_tracer_create(unsigned threads, nook_tracer **out_tracer);
void nook_tracer_destroy(nook_tracer *t); /**< NULL is allowed. */

/** Builds what changed since the last call: meshes by their id, instances always. @return NOOK_E_MEMORY */
nook_result nook_tracer_update(nook_tracer *t, const nook_ao_pass *pass);

/** Only these triangles, in view space, until the next of either call; the scene's meshes are kept. @return NOOK_E_MEMORY */
nook_result nook_tracer_update_triangles(nook_tracer *t, const float *positions, uint32_t vertex_count,
                                         const uint32_t *indices, uint32_t index_count);

/** As many rays as one traversal takes: packets of eight are native to AVX, and split up where there is none. */
enum { NOOK_TRACER_PACKET = 8 };

/**
 * Distances of the first triangle along unit rays from one point, view space; the closer the rays lie together, the faster.
 * Thread-safe between updates.
 * @param directions  x of all rays, y of all, z of all
 * @param count       of rays, at most NOOK_TRACER_PACKET
 * @param any         1: any triangle will do; the distance is then only a lower end of the truth (0)
 * @param out         count of them: infinity on a miss within (0, limit)
 */
void nook_tracer_distances(const nook_tracer *t, const float origin[3], const float directions[3][NOOK_TRACER_PACKET],
                           uint32_t count, float limit, int any, float *out);

/**
 * The same, always with the first triangle, and whose it is.
 * @param out_instances  count of them: into the pass's instances; UINT32_MAX on a miss, and for triangles of no instance
 */
void nook_tracer_hits(const nook_tracer *t, const float origin[3], const float directions[3][NOOK_TRACER_PACKET],
                      uint32_t count, float limit, float *out_distances, uint32_t *out_instances);

#ifdef __cplusplus
}
#endif
