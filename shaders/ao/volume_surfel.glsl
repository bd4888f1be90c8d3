#pragma once
// Technique "volume", surfel volumes: docs/surfel_bricks.md.
#include "ao/volume_pass.glsl"
#include "ao/surfel.glsl"

// A fragment as one occluder's voxels see it.
struct Receiver {
    vec3 voxel;  // position
    vec3 normal; // unit, voxel space
    bool can_see; // some ray can hit
};

Receiver receive(Occluder o, vec3 position, vec3 normal)
{
    Receiver r;
    r.voxel = to_voxel(o, position);
    r.normal = normalize(normal_to_voxel(o, normal));
    // Highest point of the volume above the fragment's plane: below that there is nothing to hit.
    float top = dot(r.normal, 0.5 * o.size.xyz - r.voxel) + dot(abs(r.normal), 0.5 * o.size.xyz);
    r.can_see = is_near(o, r.voxel) && top > 0.0;
    return r;
}

Passage walk_volume(Occluder o, Receiver r, vec3 d, float limit)
{
    vec3 along = direction_to_voxel(o, d);
    float metre = length(along);
    Ray ray = Ray(r.voxel + r.normal * params.lift, r.voxel, r.normal, along / metre, metre,
                  min(frame.r_max, limit) * metre);
    return walk(ray, (ivec3(o.size.xyz) + (BRICK - 1)) / BRICK, int(o.place.x) + int(o.place.y) * 65536);
}

// What a ray of the full reach meets.
float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
{
    return walk_volume(o, r, d, frame.r_max).occlusion;
}
