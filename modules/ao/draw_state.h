/**
 * draw_state.h - the part of GL's state that a pass which draws takes over inside of a record, and gives back.
 *
 * Records compute and leave what a host has set for its draws alone (docs/embedding.md); those few that draw go through here.
 */
#pragma once
#include "engine/gpu/gpu.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { NOOK_DRAW_SWITCHES = 9 };

/** What a host had. Colours, blending and viewports of draw buffers and layers other than the first are neither kept nor used. */
typedef struct nook_draw_state {
    int32_t framebuffer, read_framebuffer, vertex_array, viewport[4], scissor[4];
    int32_t blend_factors[4], blend_equations[2]; /**< Of colour, then of alpha; factors: source, destination. */
    int32_t logic_op, front_face, cull_face, polygon_mode, clip_origin, clip_depth;
    uint8_t colour_mask[4];
    uint8_t enabled[NOOK_DRAW_SWITCHES];
} nook_draw_state;

/**
 * Keeps GL's state and sets the plain one: no test, no blending, no culling, filled triangles, counter-clockwise in front, lower left
 * origin, all channels written. Framebuffer, viewport and vertex array are kept, and for the caller to set.
 */
void nook_draw_state_take(nook_gpu *gpu, nook_draw_state *out_kept);
void nook_draw_state_give_back(nook_gpu *gpu, const nook_draw_state *kept);

#ifdef __cplusplus
}
#endif
