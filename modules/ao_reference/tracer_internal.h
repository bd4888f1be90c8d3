/** tracer_internal.h - Embree behind plain data: meshes once, instances every frame; or triangles of this frame alone. */
#pragma once
#include "modules/ao/technique.h"

typedef struct tracer tracer;

/** @return NOOK_E_DEVICE, NOOK_E_MEMORY */
nook_result tracer_create(tracer **out_tracer);
void tracer_destroy(tracer *t); /**< NULL is allowed. */

/** Builds what changed since the last call: meshes by their id, instances always. @return NOOK_E_MEMORY */
nook_result tracer_update(tracer *t, const nook_ao_pass *pass);

/** Only these triangles, in view space, until the next of either call; the scene's meshes are kept. @return NOOK_E_MEMORY */
nook_result tracer_update_triangles(tracer *t, const float *positions, uint32_t vertex_count, const uint32_t *indices,
                                    uint32_t index_count);

/**
 * Distance of the first triangle along a unit ray, view space. Thread-safe between updates.
 * @param any  1: any triangle will do; the distance is then only a lower end of the truth (0)
 * @return infinity on a miss within (0, limit)
 */
float tracer_distance(const tracer *t, const float origin[3], const float direction[3], float limit, int any);
