#pragma once
// The host's own depth and normals, sampled nearest, as the techniques see them: distance along -Z and view normals.
#include "ao/frame.glsl"
#include "ao/counter.glsl"
#include "nook/octahedral.glsl"
layout(binding = 0) uniform sampler2D device_depth;
layout(binding = 1) uniform sampler2D normal_world;

// Squares of these distances are still floats; what lies beyond (a depth buffer that holds rubbish) counts as not seen.
const float NEAREST = 1e-15, FARTHEST = 1e15;

// 0 where nothing is seen, and outside of the image.
float distance_at(ivec2 p)
{
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, frame.full_size)))
        return 0.0;
    float d = fetch_full(device_depth, p).r;
    float distance = frame.depth_to_distance.x / ((d - frame.depth_background) + frame.depth_to_distance.y);
    bool seen = d != frame.depth_background && distance > NEAREST && distance < FARTHEST; // false for NaN
    return seen ? distance : 0.0;
}

// The side of p along `direction` that leaves the surface least: a neighbour may lie on another object. In units of the
// distance to p, so that neither a tiny nor a huge world leaves the range of floats.
vec3 slope(ivec2 p, float centre, ivec2 direction)
{
    float before = distance_at(p - direction), after = distance_at(p + direction);
    bool use_after = before <= 0.0 || (after > 0.0 && abs(after - centre) < abs(centre - before));
    float other = use_after ? after : before;
    if (other <= 0.0)
        other = centre;
    ivec2 neighbour = use_after ? p + direction : p - direction;
    vec3 difference = full_ray(vec2(neighbour)) * (other / centre) - full_ray(vec2(p));
    return use_after ? difference : -difference;
}

vec3 rebuilt_normal(ivec2 p, float depth)
{
    if (depth <= 0.0)
        return vec3(0.0, 0.0, 1.0);
    vec3 rebuilt = cross(slope(p, depth, ivec2(1, 0)), slope(p, depth, ivec2(0, 1)));
    if (frame.ray_scale.x * frame.ray_scale.y < 0.0) // a flipped projection
        rebuilt = -rebuilt;
    float size = dot(rebuilt, rebuilt);
    return size > 0.0 && size < 1e30 ? rebuilt * inversesqrt(size) : vec3(0.0, 0.0, 1.0);
}

// The host's. @return false: it is no direction
bool given_normal(ivec2 p, out vec3 normal)
{
    vec3 world = nook_octahedral_decode(fetch_full(normal_world, p).xy);
    mat3 rotation = mat3(frame.view_from_world[0].xyz, frame.view_from_world[1].xyz, frame.view_from_world[2].xyz);
    vec3 view = rotation * world;
    float size = dot(view, view);
    normal = view * inversesqrt(size);
    return size > 0.25 && size < 4.0; // false for NaN
}

vec3 normal_at(ivec2 p, float depth)
{
    vec3 normal;
    if (frame.has_normal != 0 && given_normal(p, normal))
        return normal;
    return rebuilt_normal(p, depth);
}

// The same for shaders with a program for each: define HAS_NORMAL, the host gives normals.
vec3 guide_normal(ivec2 p, vec3 position)
{
#ifdef HAS_NORMAL
    vec3 normal;
    return given_normal(p, normal) ? normal : -normalize(position);
#else
    return rebuilt_normal(p, -position.z);
#endif
}
