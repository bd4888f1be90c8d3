#pragma once
// Technique "volume", binary volumes: Papaioannou, Menexi, Papadopoulos 2010, section 5.1, errata C2, C5, C7, C8, C9 of
// docs/techniques.md.
#include "ao/volume_pass.glsl"
#include "ao/nearest_hit.glsl"

const int STEPPING_FIXED = 0;
const int GUARD_SLAB = 0, GUARD_SEEN = 2;
const float FILTER_PRECISION = 0.015; // voxels: hardware interpolates with 8-bit weights, three axes of 1/256 and a little

#ifdef CORNERS
layout(binding = 7) uniform usamplerBuffer corners; // corners.comp.glsl

ivec3 atlas_grid()
{
    return textureSize(volume_atlas, 0);
}

// The filtered volume at a voxel position. Here the mean of eight bits.
float density(Occluder o, vec3 voxel, ivec3 size)
{
    vec3 place = voxel - 0.5, cell = floor(place), far = place - cell, near = 1.0 - far;
    ivec3 at = ivec3(o.place.xyz + cell);
    ivec4 bits = ivec4(fetch_record(corners, (at.z * size.y + at.y) * size.x + at.x).r) >> ivec4(0, 1, 2, 3);
    vec4 mean = vec4(bits & 1) * near.z + vec4(bits >> 4 & 1) * far.z;
    vec2 line = mean.xy * near.y + mean.zw * far.y;
    return line.x * near.x + line.y * far.x;
}
#else
vec3 atlas_grid()
{
    return 1.0 / vec3(textureSize(volume_atlas, 0));
}

float density(Occluder o, vec3 voxel, vec3 texel)
{
    return fetch_filtered(volume_atlas, (o.place.xyz + voxel) * texel).r;
}
#endif

// A fragment as one occluder's voxels see it.
struct Receiver {
    vec3 voxel;  // position
    vec3 normal; // unit, voxel space
    float slab;  // voxels above the fragment's plane up to which its own voxels reach in the filtered volume
    float guard; // the same in metres along the view normal
    bool can_see; // some ray can hit
};

// The part of the way to the eye on which a point comes out of the voxels that it lies in; 0 where it lies in none or in too many.
// The point is seen, so that no surface lies between: what is full there is the fatness of voxels of other surfaces.
float way_out(Occluder o, vec3 voxel, vec3 way)
{
    const float STRIDE = 0.5; // of the layer of a surface, which is a voxel thick at threshold 0.5
    float eye = length(way), apart = 0.0;
    vec3 towards = way / max(eye, 1e-20);
    for (int i = 0; i < VOLUME_TURNS_OUT; i++, apart += STRIDE) {
        steps++;
        vec3 at = clamp(voxel + towards * apart, vec3(MARGIN), o.size.xyz - MARGIN);
        if (density(o, at, atlas_grid()) < params.threshold)
            break;
    }
    return apart < min(eye, float(VOLUME_TURNS_OUT) * STRIDE) ? apart / eye : 0.0;
}

// C7: voxels made by the fragment's own plane reach ((|nx|+|ny|+|nz|)/2 + 1 - threshold) voxels above it in the filtered
// volume, n in voxel space.
Receiver receive(Occluder o, vec3 position, vec3 normal)
{
    Receiver r;
    r.voxel = to_voxel(o, position);
    r.normal = normal_to_voxel(o, normal);
    float stretch = length(r.normal);
    r.normal /= stretch;
    r.slab = 0.5 * (abs(r.normal.x) + abs(r.normal.y) + abs(r.normal.z)) + (1.0 - params.threshold) + FILTER_PRECISION;
    r.guard = r.slab * stretch;
    // Highest point of the volume above the fragment's plane: below the slab there is nothing to hit.
    float top = dot(r.normal, 0.5 * o.size.xyz - r.voxel) + dot(abs(r.normal), 0.5 * o.size.xyz - MARGIN);
    r.can_see = top > r.slab && r.guard < frame.r_max;
    if (r.can_see && params.guard == GUARD_SEEN) {
        vec3 way = -direction_to_voxel(o, position);
        r.voxel += way * way_out(o, r.voxel + r.normal * r.slab, way);
    }
    return r;
}

// Path of a ray through one volume: along the top of the slab up to `leave`, then along the ray itself.
struct Path {
    vec3 lifted, across; // voxel = lifted + across * t, t < leave
    vec3 origin, along;  // voxel = origin + along * t
    float leave;         // metres
    float start, end;    // metres; empty when start >= end
};

Path make_path(Occluder o, Receiver r, vec3 d, float cosine)
{
    Path path;
    path.origin = r.voxel;
    path.along = direction_to_voxel(o, d);
    path.leave = r.guard / max(cosine, 1e-6);
    vec2 free = clip_to_volume(o, path.origin, path.along);
    path.start = max(free.x, path.leave);
    path.end = min(free.y, frame.r_max);
    if (params.guard == GUARD_SLAB)
        return path;
    path.lifted = r.voxel + r.normal * r.slab;
    path.across = path.along - r.normal * dot(r.normal, path.along);
    vec2 bound = clip_to_volume(o, path.lifted, path.across);
    float first = max(bound.x, r.guard), last = min(min(bound.y, path.leave), frame.r_max);
    bool below = first < last, above = path.start < path.end;
    path.end = above ? path.end : last;
    path.start = below ? first : path.start;
    return path;
}

// Distance of the first hit along d (unit, view space), or NO_HIT when there is none before `limit`. Where samples lie does not
// depend on the limit, so that the nearest of several volumes is the same in whatever order they come.
float march(Occluder o, Receiver r, vec3 d, float cosine, float limit, float jitter)
{
    Path path = make_path(o, r, d, cosine);
    if (!(path.start < path.end))
        return NO_HIT;
    // C9: a filtered layer of one voxel is 2 (1 - threshold) voxels thick; a longer step can jump over it.
    float shell = 2.0 * (1.0 - params.threshold) / length(path.along);
    float range = path.end - path.start;
    float needed = params.stepping == STEPPING_FIXED ? range * float(params.steps) / frame.r_max : range / shell;
    float count = clamp(ceil(needed), 1.0, float(params.steps));
    float dr = params.stepping == STEPPING_FIXED ? frame.r_max / float(params.steps) : range / count;
    // The mean hit lies dr/2 behind the filtered layer's front, the surface half a layer behind it.
    float correction = 0.5 * (shell - dr), last = min(path.end, limit - correction);
    float t = path.start + jitter * dr;
    for (int i = 0; i < int(count) && t < last; i++, t += dr) {
        steps++;
        vec3 voxel = t < path.leave ? path.lifted + path.across * t : path.origin + path.along * t;
        voxel = clamp(voxel, vec3(MARGIN), o.size.xyz - MARGIN);
        if (density(o, voxel, atlas_grid()) >= params.threshold)
            return max(t + correction, 0.0);
    }
    return NO_HIT;
}

// rho at the end of a ray of the full reach.
float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
{
    return falloff(march(o, r, d, cosine, frame.r_max, jitter));
}
