/** shape.h - what a mesh is like, as far as the planner wants to know. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Whether triangles are the whole surface of a convex solid: every edge has its opposite, and every corner lies behind every triangle's
 * plane, but for 1e-5 of the longest side. Such a body takes no ray that starts on it.
 * @param positions  xyz, finite
 * @param indices    index_count of them, a multiple of 3
 * @return false also for what would take too long to find out: more than some 2,000 triangles
 */
bool nook_plan_is_convex(const float *positions, const uint32_t *indices, size_t index_count);

#ifdef __cplusplus
}
#endif
