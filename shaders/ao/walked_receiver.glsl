#pragma once
// A fragment as one occluder's voxels see it, for the kinds whose rays are walked from the surface: surfels, distances.
#include "ao/occluders.glsl"

struct Receiver {
    vec3 voxel;   // position
    vec3 normal;  // unit, voxel space
    bool can_see; // some ray can hit
};

// The volume's outermost `margin` voxels hold nothing, and what is lower than `least` above the fragment's plane is not met.
Receiver receive_above(Occluder o, vec3 position, vec3 normal, float margin, float least)
{
    Receiver r;
    r.voxel = to_voxel(o, position);
    r.normal = normalize(normal_to_voxel(o, normal));
    float top = dot(r.normal, 0.5 * o.size.xyz - r.voxel) + dot(abs(r.normal), 0.5 * o.size.xyz - margin);
    r.can_see = top > least;
    return r;
}
