#pragma once
// Technique "volume", surfel volumes: docs/surfel_bricks.md.
#include "ao/volume_pass.glsl"
#include "ao/walked_receiver.glsl"
#include "ao/surfel.glsl"

Receiver receive(Occluder o, vec3 position, vec3 normal)
{
    return receive_above(o, position, normal, 0.0, 0.0);
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
