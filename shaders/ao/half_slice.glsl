#pragma once
// Half planes through the receiver and the eye, bounded by the line of sight: what gtao and hbao search for horizons. One holds
// every point that the picture shows on a straight line away from the receiver's pixel. Angles in it are measured at the
// receiver: 0 is towards the eye, pi away from it; a surface in the depth buffer blocks all that lies at larger angles.
#include "ao/screen.glsl"
#include "ao/blocks.glsl"

struct HalfSlice {
    vec3 view;     // unit, towards the eye
    vec3 along;    // unit, across the line of sight
    vec3 across;   // unit, across the plane
    vec3 shear;    // along the receiver's plane, one unit of `across`
    float up, outward; // the normal's part along `view`, > 0, and along `along`
    float tangent; // angle at which the receiver's plane leaves
    float reach;   // metres along `along` within which the picture can show what is within r_max
};

// `angle` is the azimuth around the line of sight: uniform azimuths make uniform slices of the sphere of directions. Around -Z,
// the axis of the papers, they would not hold the eye except in the middle of the picture.
HalfSlice half_slice(vec3 p, vec3 n, float angle)
{
    HalfSlice h;
    vec3 tangent, bitangent;
    h.view = normalize(-p);
    tangent_frame(h.view, tangent, bitangent);
    h.along = tangent * cos(angle) + bitangent * sin(angle);
    h.across = cross(h.view, h.along);
    h.up = max(dot(n, h.view), 1e-6); // a normal that leans away from the eye counts as seen edge-on
    h.outward = dot(n, h.along);
    h.tangent = atan(h.up, -h.outward);
    float lean = dot(n, h.across);
    h.shear = (h.across - n * lean) / max(1.0 - lean * lean, 1e-6);
    float near = min(frame.r_max / length(p), 0.97); // the sphere's outline in the picture; from inside of it there is none
    h.reach = frame.r_max / sqrt(1.0 - near * near);
    return h;
}

// The azimuths of half planes, seen from the receiver: what of them is open above its plane when nothing blocks.
struct Azimuths {
    float up;  // the normal's part towards the eye, > 0
    vec2 lean; // its parts across the line of sight
};

Azimuths azimuths(vec3 p, vec3 n)
{
    vec3 view = normalize(-p), tangent, bitangent;
    tangent_frame(view, tangent, bitangent);
    return Azimuths(max(dot(n, view), 1e-6), vec2(dot(n, tangent), dot(n, bitangent)));
}

// HalfSlice.outward at an azimuth.
float outward_at(Azimuths a, float angle)
{
    return dot(a.lean, vec2(cos(angle), sin(angle)));
}

// The depth buffer at a part of the reach, but not nearer than the next texel.
Sample look_along(HalfSlice h, vec3 p, float part)
{
    float texel = -p.z * abs(pixel_footprint()) * float(frame.scale);
    return look_at(p + h.along * mix(min(texel, h.reach), h.reach, part));
}

// Angle of a seen point v, relative to the receiver. Texels seldom lie on the plane: each is moved there along the receiver's
// own plane, so that the receiver's plane itself is at the angle `tangent` from wherever it was read. One that this takes
// across the line of sight belongs to the other half.
float slice_angle(HalfSlice h, vec3 v)
{
    v -= h.shear * dot(v, h.across);
    float outward = dot(v, h.along);
    return outward > 0.0 ? atan(outward, dot(v, h.view)) : 3.14159265;
}

// Two numbers in [0, 1) that turn the azimuths and move the samples of a pixel: even over a tile in each and both, as the 4 x 4
// patterns of the papers; other ones in every frame.
vec2 tile_jitter(ivec2 pixel)
{
    float block = float(block_of(pixel));
    return fract(vec2(noise(ivec2(0), 3u), noise(ivec2(0), 4u)) + block * vec2(1.0, 7.0) / float(BLOCKS));
}
