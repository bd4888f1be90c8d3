#pragma once
// What every AO pass knows of the frame: struct frame_block of modules/ao/frame_block_internal.h, binding 0.
// View space: metres, camera at the origin, looking along -Z. Depth is the distance along -Z; 0 means no geometry.

layout(std140, binding = 0) uniform Frame {
    vec2 ray_scale, ray_offset;  // view ray of a pixel: (ndc * ray_scale + ray_offset, -1)
    ivec2 size;                  // of the trace, pixels
    ivec2 full_size;             // of the host's buffers, pixels
    int scale;                   // full pixels per trace pixel: 1, 2, 4
    float r_max;                 // metres
    int falloff;                 // falloff.glsl
    float falloff_tau;
    uint seed;
    int has_normal;              // 0: rebuild normals from depth
    int counting;                // counter.glsl
    float filter_radius;         // trace pixels
    float filter_depth;          // pixel footprints
    float filter_normal;         // exponent
    vec2 depth_to_distance;      // distance = x / (device depth - depth_background + y)
    float depth_background;      // device depth where nothing was drawn
    int bins_across;             // bins in a row of the picture; 0: there are none
    vec4 view_from_world[3];     // rotation only: columns
    ivec2 origin;                // trace pixel of a dispatch's first invocation
    ivec2 begin, end;            // trace pixels that are wanted: begin to end - 1
    ivec2 full_begin, full_end;  // full-resolution pixels that are wanted
    vec2 texel, full_texel;      // 1 / size, 1 / full_size
    float refine_weight;         // samples that weigh less do not stand for a pixel: refine.glsl
    int refine_reach;            // trace pixels
    int support;                 // samples that a filtered pixel of the trace is the mean of at least: support.glsl
} frame;

#ifdef DRAWN // not computed: the fragment shader says which pixel it is
ivec2 invocation_pixel();
#else
const int GROUP_HEIGHT = 8; // pixels, of every trace's work groups

// Which row of groups a work group traces: every fourth one, then those after them, ... llvmpipe gives each of its threads one run of
// work groups, and where the picture's upper half is less work than its lower one, a thread would wait for the other.
int group_row()
{
    int rows = int(gl_NumWorkGroups.y), row = int(gl_WorkGroupID.y);
    int second = (rows + 3) / 4, third = second + (rows + 2) / 4, fourth = third + (rows + 1) / 4; // where each kind of rows begins
    if (row >= fourth)
        return 4 * (row - fourth) + 3;
    if (row >= third)
        return 4 * (row - third) + 2;
    return row >= second ? 4 * (row - second) + 1 : 4 * row;
}

// The trace pixel of this invocation; it may lie outside of what is wanted.
ivec2 invocation_pixel()
{
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    place.y += (group_row() - int(gl_WorkGroupID.y)) * GROUP_HEIGHT;
    return frame.origin + place;
}
#endif

bool is_wanted(ivec2 pixel)
{
    return all(greaterThanEqual(pixel, frame.begin)) && all(lessThan(pixel, frame.end));
}

// The full-resolution pixel that trace pixel p stands for.
ivec2 full_pixel(ivec2 p)
{
    return min(p * frame.scale + frame.scale / 2, frame.full_size - 1);
}

// View ray with z = -1 through the centre of a full-resolution pixel (fractions allowed).
vec3 full_ray(vec2 pixel)
{
    vec2 ndc = (pixel + 0.5) / vec2(frame.full_size) * 2.0 - 1.0;
    return vec3(ndc * frame.ray_scale + frame.ray_offset, -1.0);
}

// View position of trace pixel p at a depth.
vec3 view_position(ivec2 p, float depth)
{
    return full_ray(vec2(full_pixel(p))) * depth;
}

// Trace pixel (with fraction; the centre of pixel p is p) where a view position in front of the camera is seen.
vec2 trace_pixel(vec3 position)
{
    vec2 ndc = (position.xy / -position.z - frame.ray_offset) / frame.ray_scale;
    vec2 full = (ndc * 0.5 + 0.5) * vec2(frame.full_size) - 0.5;
    return (full - float(frame.scale / 2)) / float(frame.scale);
}

// Metres that one full-resolution pixel covers at unit distance.
float pixel_footprint()
{
    return 2.0 * abs(frame.ray_scale.y) / float(frame.full_size.y); // negative in a flipped projection
}

uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// A number in [0, 1) by pixel, by `salt` and by the frame's seed.
float noise(ivec2 p, uint salt)
{
    uint h = hash(uint(p.x) + hash(uint(p.y) + hash(salt + hash(frame.seed))));
    return float(h >> 8) * (1.0 / 16777216.0);
}

// Two unit vectors that complete n to a right-handed frame (Duff et al. 2017, Building an orthonormal basis, revisited).
void tangent_frame(vec3 n, out vec3 t, out vec3 b)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}
