// The box in which an occluder may darken something, is_near() of occluders.glsl: 36 vertices an instance, no buffers. Back faces are
// drawn, which a ray from the camera leaves the box through once, wherever the camera stands; so only those are cut off that lie behind it.
#define DRAWN
#include "ao/occluders.glsl"
layout(location = 0) uniform ivec4 part; // z: the first instance's occluder
flat out int occluder;

// Columns: voxels to metres of the view.
mat3 view_from_voxel(Occluder o)
{
    return mat3(o.normal_from_view[0].xyz, o.normal_from_view[1].xyz, o.normal_from_view[2].xyz);
}

// Voxels from the middle to the box's sides. A pixel whose ray passes by within a pixel of the trace is in: rays of pixels at the
// picture's edge are not quite where a rasteriser samples them, and it rounds.
vec3 half_extent(Occluder o, mat3 axes)
{
    vec3 half_size = 0.5 * o.size.xyz - MARGIN + reach_of(o, frame.r_max);
    float farthest = max(dot(abs(vec3(axes[0].z, axes[1].z, axes[2].z)), half_size) - o.centre.z, 0.0);
    vec2 pixel = 2.0 * abs(frame.ray_scale) / vec2(frame.full_size) * float(frame.scale);
    return half_size + reach_of(o, farthest * max(pixel.x, pixel.y));
}

// -1 or 1 along each axis. Two triangles a face, counter-clockwise from outside, or from inside when the box is mirrored.
vec3 corner(int vertex, bool mirrored)
{
    int face = vertex / 6, axis = face >> 1, side = face & 1, k = vertex % 6;
    int at = k < 3 ? k : 6 - k; // 0 1 2, 3 2 1
    if ((side == 0) != mirrored)
        at = (at & 1) << 1 | at >> 1;
    vec3 place;
    place[axis] = float(2 * side - 1);
    place[(axis + 1) % 3] = float(2 * (at & 1) - 1);
    place[(axis + 2) % 3] = float((at & 2) - 1);
    return place;
}

// trace_pixel() of frame.glsl for a rasteriser, whose samples lie in the middle of pixels. No plane is near or far: z is 0.
vec4 clip_position(vec3 view)
{
    float w = -view.z, step = float(frame.scale);
    vec2 ndc = (view.xy - frame.ray_offset * w) / frame.ray_scale, size = vec2(frame.size), full = vec2(frame.full_size);
    vec2 shift = ((full - 1.0 - 2.0 * float(frame.scale / 2)) / step + 1.0) / size - 1.0;
    return vec4(ndc * full / (step * size) + shift * w, 0.0, w);
}

void main()
{
    occluder = part.z + gl_InstanceID;
    Occluder o = occluder_at(occluder);
    mat3 axes = view_from_voxel(o);
    bool mirrored = (determinant(axes) < 0.0) != (frame.ray_scale.x * frame.ray_scale.y < 0.0);
    gl_Position = clip_position(o.centre.xyz + axes * (corner(gl_VertexID, mirrored) * half_extent(o, axes)));
}
