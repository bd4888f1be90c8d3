#pragma once
// Surfel bricks: what they hold, and a ray's way through them. docs/surfel_bricks.md. All lengths are in voxels, so that no number
// depends on the scene's scale.
#include "ao/counter.glsl"
#include "ao/passage.glsl"
layout(binding = 5) uniform usamplerBuffer bricks;  // mask low, mask high, first surfel, distance to the next occupied brick
layout(binding = 6) uniform usamplerBuffer surfels; // two planes, or one and its box

const int BRICK = 4;
const float OFFSET_STEP = 0.87 / 127.0; // modules/bake/surfel_word.h
const float ALPHA_STEP = 1.0 / 63.0;
const uint SIDE_ABOVE = 1u, SIDE_WITHIN = 3u;
const float BOX_STEPS = 16.0, INTERVAL_STEPS = 6.0; // modules/bake/surfel_extent.h
const uint POINTS = 7u;
const float UNCUT = 8.0; // voxels, farther than any place that is asked about
// Voxels by which a plane reaches past where it ends inside of its voxel: what rounding may leave open there, and what an extent that is
// made of moments may cut off.
const float SIDE_SLACK = 0.04;
// A plane that stands for two sheets a quarter voxel apart lies half of that from either: what faces exactly like the receiver and is
// farther away is another sheet. A curved surface that turns by an angle on the half voxel from a plane's middle to where the receiver
// lies leaves that plane by a quarter of the angle.
const float OWN_FLAT = 0.15, OWN_CURVED = 0.25;
const float FACES_ALIKE = 0.6; // cosine from which a plane may be the receiver's own: the normals of a voxel's two planes differ
const float ACROSS = 0.1;      // cosine below which it stands upright on the receiver: to which side it leans is rounding
const float PARALLEL = 1e-6;   // cosine

// A ray from a fragment, as one volume sees it.
struct Ray {
    vec3 origin; // lifted off the surface
    vec3 point;  // on it
    vec3 normal; // unit
    vec3 along;  // unit
    float metre; // voxels along it
    float reach; // how far it goes
};

// xyz: unit normal; w: offset from the voxel's middle.
vec4 plane_of(uint word)
{
    float x = float(int(word << 24) >> 24) / 127.0, y = float(int(word << 16) >> 24) / 127.0;
    float z = 1.0 - abs(x) - abs(y), fold = max(-z, 0.0);
    vec3 normal = normalize(vec3(x + (x >= 0.0 ? -fold : fold), y + (y >= 0.0 ? -fold : fold), z));
    return vec4(normal, float(int(word << 8) >> 24) * OFFSET_STEP);
}

float alpha_of(uint word)
{
    return word >> 30 == SIDE_WITHIN ? 1.0 : float((word >> 24) & 63u) * ALPHA_STEP;
}

// Whether a place, from the voxel's middle, is in the box that a surfel's second word says its only plane lies in.
bool is_in_box(uint word, vec3 at)
{
    vec3 low = vec3(word & 15u, word >> 4 & 15u, word >> 8 & 15u);
    vec3 high = vec3(word >> 12 & 15u, word >> 16 & 15u, word >> 20 & 15u);
    // A side at a face of the voxel cuts nothing: the plane reaches on, as far as the ray's way through the voxel says.
    vec3 below = low / BOX_STEPS - (0.5 + SIDE_SLACK) - at - UNCUT * (1.0 - min(low, 1.0));
    vec3 above = at - (0.5 + SIDE_SLACK) + high / BOX_STEPS - UNCUT * (1.0 - min(high, 1.0));
    return max(max(max(below.x, below.y), below.z), max(max(above.x, above.y), above.z)) <= 0.0;
}

// The same for the interval of one of two planes.
bool is_in_interval(uint word, vec3 at)
{
    uint code = (word >> 24) & 63u;
    uint axis = (code * 49u) >> 10, row = (code * 37u) >> 8; // code / 21, code / 7: software GL divides slowly
    uint place = code - row * POINTS, other = place + row - axis * 3u + 1u;
    other -= other < POINTS ? 0u : POINTS;
    uint low = min(place, other), high = max(place, other);
    float along = (axis == 0u ? at.x : axis == 1u ? at.y : at.z) + 0.5;
    return (low == 0u || along >= float(low) / INTERVAL_STEPS - SIDE_SLACK) &&
           (high == POINTS - 1u || along <= float(high) / INTERVAL_STEPS + SIDE_SLACK);
}

// The surface that the fragment itself lies on never occludes it: a plane that faces like it, of which it is not far, and which the
// ray leaves behind. One that leans over it as the other plane of an edge does is told from what is really there only by the place where
// the ray meets it, h, and that is known to within the tolerance: what lies nearer than this to the start may lie behind it.
bool is_own(vec4 plane, vec3 point, vec3 normal, float slope, float h)
{
    float facing = dot(plane.xyz, normal), height = dot(plane.xyz, point) - plane.w, likeness = abs(facing);
    float most = min(params.own_distance, OWN_FLAT + OWN_CURVED * sqrt(max(1.0 - facing * facing, 0.0)));
    bool near = likeness > FACES_ALIKE ? abs(height) < most : likeness > ACROSS && h < params.tolerance;
    return near && (facing < 0.0 ? -slope : slope) > 0.0;
}

// Where the ray meets a plane of a voxel that it crosses from `enter` to `leave`, or -1. origin, point: from the voxel's middle. box: 0 for
// one of two planes.
float hit_plane(uint word, vec4 plane, vec4 other, uint box, Ray ray, vec3 origin, vec3 point, float enter, float leave)
{
    float slope = dot(plane.xyz, ray.along), h = (plane.w - dot(plane.xyz, origin)) / slope;
    bool hit = abs(slope) > PARALLEL && h > 0.0 && h < ray.reach && h >= enter - params.tolerance &&
               h <= leave + params.tolerance;
    if (!hit)
        return -1.0;
    uint side = word >> 30;
    vec3 at = origin + ray.along * h;
    if (side == SIDE_WITHIN) {
        hit = is_in_interval(word, at);
    } else if (side != 0u) {
        float beyond = dot(other.xyz, at) - other.w;
        hit = (side == SIDE_ABOVE ? beyond : -beyond) >= -SIDE_SLACK;
    } else if (box != 0u) {
        hit = is_in_box(box, at);
    }
    return hit && !is_own(plane, point, ray.normal, slope, h) ? h : -1.0;
}

// Where planes reach out of their voxels the same surface is met twice: it counts once.
void pass_plane(float h, float alpha, Ray ray, inout Passage passage)
{
    if (h < 0.0 || passage.transmittance == 0.0)
        return;
    pass_through(h, ray.metre, alpha, abs(h - passage.last) < params.tolerance, passage);
    passage.last = h;
}

// The planes of one voxel take their shares, the nearer one first.
void meet_surfel(uint index, vec3 middle, Ray ray, float enter, float leave, inout Passage passage)
{
    uvec2 words = fetch_record(surfels, int(index)).xy;
    vec3 origin = ray.origin - middle, point = ray.point - middle;
    bool two = words.y >> 24 != 0u;
    vec4 first = plane_of(words.x), second = two ? plane_of(words.y) : first;
    float a = hit_plane(words.x, first, second, two ? 0u : words.y, ray, origin, point, enter, leave), b = -1.0;
    if (two)
        b = hit_plane(words.y, second, first, 0u, ray, origin, point, enter, leave);
    float alpha_a = alpha_of(words.x), alpha_b = alpha_of(words.y);
    bool swapped = b >= 0.0 && b < a;
    pass_plane(swapped ? b : a, swapped ? alpha_b : alpha_a, ray, passage);
    pass_plane(swapped ? a : b, swapped ? alpha_a : alpha_b, ray, passage);
}

// Bit of a voxel in its brick's mask: Morton order, so that a byte of it is a block of 2 x 2 x 2.
uint bit_of(ivec3 v)
{
    return uint((v.x & 1) | (v.y & 1) << 1 | (v.z & 1) << 2 | (v.x & 2) << 2 | (v.y & 2) << 3 | (v.z & 2) << 4);
}

uint surfel_of(uvec4 brick, uint bit)
{
    uint below = (1u << (bit & 31u)) - 1u;
    uint before = bit < 32u ? uint(bitCount(brick.x & below)) : uint(bitCount(brick.x)) + uint(bitCount(brick.y & below));
    return brick.z + before;
}

// Walks a volume of `size` bricks, the first of which is number `base` of all: the outer loop meets one surfel a round, the inner one
// only walks, so that neighbours that walk together also meet together. From voxel to voxel by integers: the axis on which a region is
// left is stepped exactly, the others are clamped into the region, so that no rounding ever turns a ray back. A straight line
// crosses no more voxels than size.x + size.y + size.z bricks have along their sides: no loop is longer than that.
Passage walk(Ray ray, ivec3 size, int base)
{
    Passage passage = free_passage();
    vec3 inverse = 1.0 / mix(ray.along, vec3(1e-9), lessThan(abs(ray.along), vec3(1e-9)));
    vec3 forward = step(0.0, inverse), side = vec3(size * BRICK);
    vec3 a = -ray.origin * inverse, b = (side - ray.origin) * inverse, near = min(a, b);
    float t = max(max(near.x, near.y), max(near.z, 0.0)), end = min(least(max(a, b)), ray.reach);
    ivec3 voxel = clamp(ivec3(floor(ray.origin + ray.along * t)), ivec3(0), size * BRICK - 1);
    int most = line_voxels(size * BRICK), turns = 0;
    for (int meetings = 0; meetings < most; meetings++) {
        bool found = false;
        uint surfel = 0u;
        vec3 middle = vec3(0.0);
        float enter = t;
        for (; turns < most && t < end; turns++) {
            steps++;
            ivec3 at = voxel >> 2;
            uvec4 brick = fetch_record(bricks, base + (at.z * size.y + at.y) * size.x + at.x);
            uint bit = bit_of(voxel), word = bit < 32u ? brick.x : brick.y;
            vec3 corner = vec3(voxel); // of the region to cross: this voxel, an empty block of 2, or an empty cube of bricks
            float extent = 1.0;
            if ((brick.x | brick.y) == 0u) {
                int skip = int(brick.w);
                corner = vec3((at - (skip - 1)) * BRICK);
                extent = float((2 * skip - 1) * BRICK);
            } else if (((word >> (bit & 24u)) & 255u) == 0u) {
                corner = vec3(voxel & ~1);
                extent = 2.0;
            }
            vec3 edge = corner + forward * extent, exits = (edge - ray.origin) * inverse;
            float leave = least(exits);
            found = ((word >> (bit & 31u)) & 1u) != 0u;
            if (found) {
                surfel = surfel_of(brick, bit);
                middle = vec3(voxel) + 0.5;
            }
            vec3 next = clamp(floor(ray.origin + ray.along * leave), corner, corner + (extent - 1.0));
            voxel = ivec3(mix(next, edge + (forward - 1.0), lessThanEqual(exits, vec3(leave))));
            enter = t;
            t = any(greaterThanEqual(uvec3(voxel), uvec3(side))) ? 1e30 : leave;
            if (found)
                break;
        }
        if (!found)
            break;
        meet_surfel(surfel, middle, ray, enter, min(t, end), passage);
        if (passage.transmittance == 0.0)
            break;
    }
    return passage;
}
