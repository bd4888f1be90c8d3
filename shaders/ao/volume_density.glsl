#pragma once
// Technique "volume", volumes of densities, walked voxel by voxel: docs/volume_kinds.md. All lengths of the walk are in voxels.
#include "ao/volume_pass.glsl"
#include "ao/passage.glsl"

// A ray that was out of dense voxels for this long has left a layer. Where it meets one flat it comes out between voxels of it: of
// cosine-weighted rays through tilted planes 3 to 8 % met one twice with 0.9, 0.1 % with 2.
const float GAP = 2.0;
// A layer's surface lies in the middle of a ray's way through it, but not deeper than this: where a ray runs along a wall.
const float DEEPEST = 1.5;

// A fragment as one occluder's voxels see it.
struct Receiver {
    vec3 voxel;   // position
    vec3 normal;  // unit, voxel space
    float own;    // voxels whose middles are no higher over the fragment's plane may be those of its own surface
    bool can_see; // some ray can hit
};

// A plane marks the voxels in which it crosses a line through their middle along an axis: those no farther from it than half of
// the normal's largest part, and what layers are told apart by (NOOK_LAYER_BIAS).
Receiver receive(Occluder o, vec3 position, vec3 normal)
{
    Receiver r;
    r.voxel = to_voxel(o, position);
    r.normal = normalize(normal_to_voxel(o, normal));
    bool medium = o.place.w > 0.0; // has no surface of its own: what lies around the fragment takes its part
    r.own = medium ? -1.0 : 0.5 * max(abs(r.normal.x), max(abs(r.normal.y), abs(r.normal.z))) + 0.002 + params.own_distance;
    float top = dot(r.normal, 0.5 * o.size.xyz - r.voxel) + dot(abs(r.normal), 0.5 * o.size.xyz - 1.5);
    r.can_see = top > r.own;
    return r;
}

// What a ray has met of a layer that it has not left yet, in voxels along the ray.
struct Layer {
    float first, last, alpha; // alpha 0: none
};

// From voxel to voxel: the axis on which one is left is stepped by an integer, so that no rounding turns a ray back. A straight line
// crosses no more voxels than the volume has along its three sides together (line_voxels): loops are no longer than that.
struct Line {
    vec3 origin, inverse;
    ivec3 size, base, ahead, voxel; // ahead: 1 where the line leaves a voxel by its upper face
    float at, out_at, metre;        // where the line comes into its voxel; where the volume ends
};

Line line_through(Occluder o, vec3 origin, vec3 d)
{
    vec3 along = direction_to_voxel(o, d);
    float metre = length(along);
    along /= metre;
    ivec3 size = ivec3(o.size.xyz);
    vec3 inverse = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 a = (1.0 - origin) * inverse, b = (vec3(size - 1) - origin) * inverse, near = min(a, b); // the outermost voxels are empty
    float at = max(max(near.x, near.y), max(near.z, 0.0));
    ivec3 voxel = clamp(ivec3(floor(origin + along * at)), ivec3(1), size - 2);
    return Line(origin, inverse, size, ivec3(o.place.xyz), ivec3(step(0.0, inverse)), voxel, at, least(max(a, b)), metre);
}

vec3 exits_of(Line line)
{
    return (vec3(line.voxel + line.ahead) - line.origin) * line.inverse;
}

void go_on(vec3 exits, float leave, inout Line line)
{
    line.voxel += (2 * line.ahead - 1) * ivec3(lessThanEqual(exits, vec3(leave)));
    bool out_of_it = any(lessThan(line.voxel, ivec3(1))) || any(greaterThan(line.voxel, line.size - 2));
    line.at = out_of_it ? 1e30 : leave;
}

void leave_layer(float metre, inout Layer layer, inout Passage passage)
{
    if (layer.alpha > 0.0)
        pass_through(layer.first + min(0.5 * (layer.last - layer.first), DEEPEST), metre, layer.alpha, false, passage);
    layer.alpha = 0.0;
}

// A layer counts once on a ray, with the largest alpha that the ray meets in it; one that begins within reach is walked to its end.
Passage walk_layers(Occluder o, Receiver r, vec3 d, float limit)
{
    Passage passage = free_passage();
    Layer layer = Layer(0.0, 0.0, 0.0);
    Line line = line_through(o, r.voxel, d);
    float end = min(line.out_at, min(frame.r_max, limit) * line.metre);
    int most = line_voxels(line.size);
    for (int turns = 0; turns < most && line.at < (layer.alpha > 0.0 ? line.out_at : end); turns++) {
        steps++;
        float alpha = fetch_texel(volume_atlas, line.base + line.voxel).r;
        vec3 exits = exits_of(line);
        float leave = max(least(exits), line.at);
        if (alpha > 0.0 && dot(vec3(line.voxel) + 0.5 - line.origin, r.normal) > r.own) {
            layer.first = layer.alpha > 0.0 ? layer.first : line.at;
            layer.last = leave;
            layer.alpha = max(layer.alpha, alpha);
        } else if (leave - layer.last >= GAP) {
            leave_layer(line.metre, layer, passage);
        }
        if (passage.transmittance == 0.0 || (layer.alpha == 1.0 && leave - layer.first > 2.0 * DEEPEST))
            break;
        go_on(exits, leave, line);
    }
    leave_layer(line.metre, layer, passage);
    return passage;
}

// Through a medium: each voxel takes its part of what is left, at the middle of the ray's way through it. What lets less through than a
// step of 8 bits ends the ray.
Passage walk_medium(Occluder o, Receiver r, vec3 d, float limit)
{
    Passage passage = free_passage();
    Line line = line_through(o, r.voxel, d);
    float end = min(line.out_at, min(frame.r_max, limit) * line.metre);
    int most = line_voxels(line.size);
    for (int turns = 0; turns < most && line.at < end && passage.transmittance > 1.0 / 512.0; turns++) {
        steps++;
        float depth = o.place.w * fetch_texel(volume_atlas, line.base + line.voxel).r;
        vec3 exits = exits_of(line);
        float leave = max(least(exits), line.at), last = min(leave, end);
        float taken = passage.transmittance * (1.0 - exp(-depth * (last - line.at)));
        passage.occlusion += taken * falloff(0.5 * (line.at + last) / line.metre);
        passage.transmittance -= taken;
        go_on(exits, leave, line);
    }
    return passage;
}

Passage walk_volume(Occluder o, Receiver r, vec3 d, float limit)
{
    if (o.place.w > 0.0)
        return walk_medium(o, r, d, limit);
    return walk_layers(o, r, d, limit);
}

// What a ray of the full reach meets.
float occlusion_along(Occluder o, Receiver r, vec3 d, float cosine, float jitter)
{
    return walk_volume(o, r, d, frame.r_max).occlusion;
}
