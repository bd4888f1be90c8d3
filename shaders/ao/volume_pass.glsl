#pragma once
// What the shaders of the technique "volume" share, two for each kind of volume: what is bound, and which part of the work a dispatch or
// a draw does. A kind, volume_KIND.glsl, has
//   struct Receiver { ...; bool can_see; }                                a fragment as one occluder that is_near sees it
//   Receiver receive(Occluder o, vec3 position, vec3 normal)
//   float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
//   image2D kept_image                                                    what waits for the next part; multiply: x is a sum
// Their main() is in volume_main.glsl, which computes (path = compute), and in volume_box.glsl, which is drawn (path = raster: DRAWN).
#include "ao/frame.glsl"
#include "ao/falloff.glsl"
#include "ao/counter.glsl"
#include "ao/directions.glsl"
#include "ao/occluders.glsl"
#include "nook/octahedral.glsl"
#include "nook/params.glsl"
#include "modules/ao_volume/limits.def"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_volume/params.def"
} params;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
// Rays x to y - 1 of occluders z to w - 1: this part of the work, see modules/ao_volume/cut_internal.h.
layout(location = 0) uniform ivec4 part;
layout(location = 1) uniform int occluder_count; // of all parts

ivec2 place; // of this invocation's point in the images that are written

// A straight line crosses no more voxels of a volume than this.
int line_voxels(ivec3 size)
{
    return size.x + size.y + size.z;
}

const int BATCH = VOLUME_RAYS_AT_ONCE;

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
