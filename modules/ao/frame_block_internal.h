#pragma once
#include <stdint.h>

/** Block Frame of shaders/ao/frame.glsl, std140: the same fields in the same order. */
typedef struct frame_block {
    float ray_scale[2], ray_offset[2];
    int32_t size[2];
    int32_t full_size[2];
    int32_t scale;
    float r_max;
    int32_t falloff;
    float falloff_tau;
    uint32_t seed;
    int32_t has_normal;
    int32_t counting;
    float filter_radius;
    float filter_depth;
    float filter_normal;
    float depth_to_distance[2];
    float depth_background;
    int32_t bins_across;
    int32_t padding[2];        /**< A vec4 starts at a multiple of 16 bytes. */
    float view_from_world[12]; /**< Three columns of four. */
    int32_t origin[2];         /**< Trace pixel of a dispatch's first invocation. */
    int32_t begin[2], end[2];  /**< Trace pixels that are wanted. */
    int32_t full_begin[2], full_end[2];
    float texel[2], full_texel[2]; /**< 1 / size, 1 / full_size. */
    float refine_weight;
    int32_t refine_reach;
    int32_t support;
    int32_t padding_end[3]; /**< A block's size is a multiple of 16 bytes. */
} frame_block;
