/** overlay_internal.h - how the overlay's triangles reach the GPU. Inside engine/overlay only. */
#pragma once
#include "engine/gpu/gpu.h"

#ifdef __cplusplus
extern "C" {
#endif

/** As ImDrawVert: position in pixels, texture coordinates, RGBA8. */
typedef struct overlay_vertex {
    float position[2], uv[2];
    uint32_t colour;
} overlay_vertex;

/** Triangles of one texture within one rectangle. */
typedef struct overlay_command {
    float clip[4];    /**< Left, top, right, bottom, pixels from the top left. */
    uint32_t texture; /**< GL name. */
    uint32_t first_index, index_count;
    uint32_t first_vertex;
} overlay_command;

/** One vertex and one index buffer, which grow and never shrink. */
typedef struct overlay_painter {
    nook_gpu *gpu;
    nook_texture font; /**< RGBA8. */
    nook_buffer vertices, indices;
    uint32_t vertex_array;
    nook_framebuffer target; /**< Between begin and end. */
    float size[2];           /**< What commands and vertices count pixels of: stretched over the target. */
} overlay_painter;

/** @return NOOK_E_NOT_FOUND, NOOK_E_DEVICE: its shaders do not build */
nook_result overlay_painter_create(nook_gpu *gpu, overlay_painter *out_painter);
void overlay_painter_destroy(overlay_painter *painter); /**< Zeroed ones are allowed. */
/** Replaces the font's texture. @return NOOK_E_MEMORY, NOOK_E_RANGE: the old one stays */
nook_result overlay_painter_set_font(overlay_painter *painter, const void *rgba8, uint32_t width, uint32_t height);

/**
 * Makes room and sets GL's state.
 * @param size  width and height that positions are given in
 * @return NOOK_E_MEMORY, NOOK_E_NOT_FOUND, NOOK_E_DEVICE: draw nothing then
 */
nook_result overlay_painter_begin(overlay_painter *painter, nook_framebuffer target, const float size[2],
                                  uint32_t vertex_count, uint32_t index_count);
/** Uploads a piece of both buffers; must fit in what begin was told. */
void overlay_painter_upload(overlay_painter *painter, const overlay_vertex *vertices, uint32_t first_vertex,
                            uint32_t vertex_count, const uint16_t *indices, uint32_t first_index, uint32_t index_count);
void overlay_painter_draw(overlay_painter *painter, const overlay_command *command);
/** GL's defaults again. */
void overlay_painter_end(overlay_painter *painter);

#ifdef __cplusplus
}
#endif
