#pragma once
// What the shaders of the technique "volume" share, one for each kind of volume: what is bound, and which part of the work a dispatch
// does. volume_main.glsl has their main(), which takes of the kind
//   struct Receiver { ...; bool can_see; }                                a fragment as one occluder sees it
//   Receiver receive(Occluder o, vec3 position, vec3 normal)
//   float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
//   float sum_union(float sum, bool inside, vec3 position, vec3 normal, ivec2 pixel)
//   image2D kept_image                                                    what waits for the next dispatch; multiply: x is a sum
#include "ao/frame.glsl"
#include "ao/falloff.glsl"
#include "ao/counter.glsl"
#include "ao/directions.glsl"
#include "ao/tile_list.glsl"
#include "nook/octahedral.glsl"
#include "nook/params.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 1) uniform Params {
#include "modules/ao_volume/params.def"
} params;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 0, r32f) uniform image2D visibility_image;
// Groups of the dispatches that do everything again, carefully: x stays 0 unless loops were ended.
layout(std430, binding = 5) buffer Again {
    uint groups_x, groups_y, groups_z;
} again;
// Rays x to y - 1 of occluders z to w - 1: this dispatch's part of the work, see modules/ao_volume/cut_internal.h.
layout(location = 0) uniform ivec4 part;
layout(location = 1) uniform int occluder_count; // of all parts

const int COMBINE_MULTIPLY = 0;
const int BATCH = 8; // rays whose hits are held in registers

// A number for each ray of a batch. Not an array: that a loop indexes would lie in memory, and a software driver writes there lane by
// lane, with a jump for each.
struct Batch {
    vec4 low, high;
};

float batch_get(Batch batch, int j)
{
    vec4 four = j < 4 ? batch.low : batch.high;
    vec2 two = (j & 2) == 0 ? four.xy : four.zw;
    return (j & 1) == 0 ? two.x : two.y;
}

void batch_set(inout Batch batch, int j, float value)
{
    batch.low = mix(batch.low, vec4(value), equal(ivec4(j), ivec4(0, 1, 2, 3)));
    batch.high = mix(batch.high, vec4(value), equal(ivec4(j), ivec4(4, 5, 6, 7)));
}
