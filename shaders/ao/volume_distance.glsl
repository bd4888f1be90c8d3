#pragma once
// Technique "volume", volumes of distances, sphere traced: docs/volume_kinds.md. All lengths of the walk are in voxels.
#include "ao/volume_pass.glsl"
#include "ao/walked_receiver.glsl"
#include "ao/nearest_hit.glsl"

const float RANGE = 255.0 / 32.0;     // that a byte holds: NOOK_DISTANCES_PER_VOXEL
const float FILTER_PRECISION = 0.015; // hardware interpolates with 8-bit weights, three axes of 1/256 and a little
// A filtered distance is at most this much larger than the true one: the eight centres are sqrt(sum f (1 - f)) <= sqrt(3)/2 away.
const float EXCESS = 0.8661 + FILTER_PRECISION;
// On a plane it is 1/2 at the most, h over it sqrt(h^2 + 1/4): below SURFACE within MIN_STEP / 2 of every plane, so that no sample
// needs to lie nearer to the next one than MIN_STEP.
const float MIN_STEP = 1.0 / float(VOLUME_TURNS_PER_VOXEL);
const float SURFACE = 0.5591 + FILTER_PRECISION; // sqrt(MIN_STEP^2 / 4 + 1/4)

// The surface lies ahead as far as the distance and how fast it fell say; a ray that meets it flatter than this cosine is taken for one
// that does not: over few samples so flat a fall is no measure.
const float FLATTEST = 0.4;

Receiver receive(Occluder o, vec3 position, vec3 normal)
{
    return receive_above(o, position, normal, MARGIN, params.lift);
}

// Where samples lie does not depend on the limit, so that the nearest of several volumes is the same in whatever order they come.
// A line within a volume is shorter than its three sides together, and no step is shorter than MIN_STEP.
float march(Occluder o, Receiver r, vec3 d, float cosine, float limit, float jitter)
{
    vec3 along = direction_to_voxel(o, d);
    float metre = length(along);
    vec2 inside = clip_to_volume(o, r.voxel, along) * metre;
    along /= metre;
    float rise = max(dot(along, r.normal), 1e-6);
    float t = max(inside.x, params.lift / rise), end = min(inside.y, min(frame.r_max, limit) * metre);
    vec3 texel = 1.0 / vec3(textureSize(volume_atlas, 0));
    float before = 1e30, far = 1.0; // of the sample before; none: as if it had fallen straight
    int most = VOLUME_TURNS_PER_VOXEL * line_voxels(ivec3(o.size.xyz));
    for (int turns = 0; turns < most && t < end; turns++) {
        steps++;
        vec3 voxel = clamp(r.voxel + along * t, vec3(MARGIN), o.size.xyz - MARGIN);
        float distance = fetch_filtered(volume_atlas, (o.place.xyz + voxel) * texel).r * RANGE;
        if (distance < min(SURFACE, params.own_share * (rise * t - params.lift)))
            return (t + distance / clamp((before - distance) / far, FLATTEST, 1.0)) / metre;
        before = distance;
        far = max(distance - EXCESS, MIN_STEP);
        t += far;
    }
    return NO_HIT;
}

// rho at the end of a ray of the full reach.
float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
{
    return falloff(march(o, r, d, cosine, frame.r_max, jitter));
}
