// Before a trace: which of its pixels take over what was traced in the frames before, and which are listed to be traced.
// docs/techniques.md, Reuse. Occluders here are those that have moved, as they are and as they were. Define: BOUNDED, what moves may change
// a value by reuse.error, and occluders stand there once, with the boxes that they have been in; else what is near them is traced. Define:
// ACCUMULATE, what is traced becomes part of a mean (accumulate.comp.glsl).
#include "ao/tile_list.glsl"
#include "ao/ages.glsl"
#include "ao/counter.glsl"
#ifdef BOUNDED
#include "ao/box_weight.glsl"
#endif
#include "nook/octahedral.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 1) uniform Reuse { // struct reuse_block of modules/ao/reuse.c
    vec4 before_from_view[3]; // rows; view space of the last frame
    vec4 view_from_before[3];
    vec2 ray_scale, ray_offset; // of the last frame: frame.glsl
    int period;                 // frames
    int turn;                   // number of this frame, modulo period
    int has_before;             // 0: everything is traced
    int stands;                 // both frames are seen alike: a pixel is its own predecessor
    int moved_count;
    float error;                // by which what moves may change a value at the most
    int window;                 // frames of which boxes are known, this one too
    int most;                   // traces that a value is the mean of at most
} reuse;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 4) uniform sampler2D depth_before;
layout(binding = 5) uniform sampler2D normal_before;
layout(binding = 6) uniform sampler2D visibility_before;
layout(binding = 7) uniform usampler2D age_before;
layout(binding = 0, r32f) uniform writeonly image2D visibility_image;
layout(binding = 1, r16ui) uniform writeonly uimage2D age_image; // ages.glsl
#ifdef ACCUMULATE
const bool ACCUMULATES = true;
layout(binding = 3, r32f) uniform writeonly image2D carried_image; // what is traced here becomes part of
#else
const bool ACCUMULATES = false;
#endif
layout(std430, binding = 3) buffer Tiles { // tiles.glsl
    uint groups_x, groups_y, groups_z, count;
    Tile tiles[];
} left;
shared uint listed_bits[2];

// How far the predecessor may lie off the pixel's plane, trace pixels; how much its normal may lean; and how far from the pixel it
// would be seen now, trace pixels: more where surfaces were seen flatter or from farther off.
const float PLANE_MOST = 0.5, FACING_LEAST = 0.95, APART_MOST = 1.0;

vec3 rows_apply(vec4 rows[3], vec4 v)
{
    return vec3(dot(rows[0], v), dot(rows[1], v), dot(rows[2], v));
}

// Where the last trace saw a view position, in its pixels.
vec2 place_before(ivec2 pixel, vec3 before)
{
    vec2 full = ((before.xy / -before.z - reuse.ray_offset) / reuse.ray_scale * 0.5 + 0.5) * vec2(frame.full_size) - 0.5;
    return reuse.stands != 0 ? vec2(pixel) : (full - float(frame.scale / 2)) / float(frame.scale);
}

// Is what the last trace's pixel q stood for a point of the same surface, seen in the same place?
bool same_surface(ivec2 pixel, ivec2 q, vec3 before, vec3 normal)
{
    float depth = fetch_trace(depth_before, q).r;
    vec2 ndc = (vec2(full_pixel(q)) + 0.5) / vec2(frame.full_size) * 2.0 - 1.0;
    vec3 found = vec3(ndc * reuse.ray_scale + reuse.ray_offset, -1.0) * depth;
    vec3 normal_then = rows_apply(reuse.before_from_view, vec4(normal, 0.0));
    float plane = abs(dot(normal_then, found - before)) / (-before.z * pixel_footprint() * float(frame.scale));
    float facing = dot(normal_then, nook_octahedral_decode(fetch_trace(normal_before, q).xy));
    vec3 now = rows_apply(reuse.view_from_before, vec4(found, 1.0));
    vec2 apart = abs(trace_pixel(now) - vec2(pixel));
    return depth > 0.0 && plane <= PLANE_MOST && facing >= FACING_LEAST && now.z < 0.0 &&
           all(lessThanEqual(apart, vec2(APART_MOST))); // false for NaN
}

// The pixel of the last trace nearest to a point's place there, when it stood for the point's surface. The others around it may too, but
// lie farther off: taken frame after frame, they carried the black of a contact up a plinth.
bool predecessor(ivec2 pixel, vec3 before, vec3 normal, out ivec2 q)
{
    vec2 nearest = round(place_before(pixel, before));
    bool inside = before.z < 0.0 && all(greaterThanEqual(nearest, vec2(0.0))) && all(lessThan(nearest, vec2(frame.size)));
    q = inside ? ivec2(nearest) : pixel; // not for NaN
    return inside && same_surface(pixel, q, before, normal);
}

#ifndef BOUNDED
// May an occluder darken the point? It is near, and part of its box is above the point's plane.
bool may_darken(Occluder o, vec3 position, vec3 normal)
{
    vec3 voxel = to_voxel(o, position), n = normal_to_voxel(o, normal);
    return is_near(o, voxel) && dot(n, 0.5 * o.size.xyz - voxel) + dot(abs(n), 0.5 * o.size.xyz) > 0.0;
}

// Uniform control flow. @return 1 or 0
float change_since(bool wanted, int since, vec3 position, vec3 normal)
{
    bool found = false;
    for (int chunk = 0; chunk < reuse.moved_count; chunk += CHUNK) {
        tile_list(chunk, ivec2(0, reuse.moved_count), ivec2(0, reuse.moved_count));
        uint count = wanted ? tile_count : 0u;
        for (uint i = 0u; i < count && !found; i++)
            found = may_darken(occluder_at(tile_items[i]), position, normal);
    }
    return found ? 1.0 : 0.0;
}
#else
// What an occluder that has moved in the last frames can have changed since the one `since` frames ago at the most: the part of the sky that
// the box takes in which it was all the time.
float change_by(int moved, int since, vec3 position, mat3 plane_from_view)
{
    int row = reuse.moved_count * OCCLUDER_ROWS + (moved * (reuse.window - 1) + since - 1) * 2;
    vec4 low = texelFetch(occluder_rows, row);
    if (low.w == 0.0)
        return 0.0;
    Occluder o = occluder_at(moved);
    vec3 voxel = to_voxel(o, position), reach = reach_of(o, frame.r_max);
    low.xyz -= voxel;
    vec3 high = texelFetch(occluder_rows, row + 1).xyz - voxel;
    if (any(greaterThan(low.xyz, reach)) || any(lessThan(high, -reach)))
        return 0.0;
    if (all(lessThanEqual(low.xyz, vec3(0.0))) && all(greaterThanEqual(high, vec3(0.0))))
        return 1.0;
    mat3 axes = plane_from_view * mat3(o.normal_from_view[0].xyz, o.normal_from_view[1].xyz, o.normal_from_view[2].xyz);
    return box_weight(low.xyz, high, axes);
}

// Uniform control flow. @return what all of them can have changed together; no more than reuse.error is right
float change_since(bool wanted, int since, vec3 position, vec3 normal)
{
    float sum = 0.0;
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    mat3 plane_from_view = transpose(mat3(tangent, bitangent, normal));
    for (int chunk = 0; chunk < reuse.moved_count; chunk += CHUNK) {
        tile_list(chunk, ivec2(0, reuse.moved_count), ivec2(0, reuse.moved_count));
        uint count = wanted ? tile_count : 0u;
        for (uint i = 0u; i < count && sum <= reuse.error; i++)
            sum += change_by(tile_items[i], since, position, plane_from_view);
    }
    return sum;
}
#endif

// A tile's pixels come in turns. One that is traced out of turn is traced again when its tile's turn comes, so that each frame keeps
// its share of the work.
uint age_out_of_turn()
{
    ivec2 tile = tile_first() / TILE_SIZE;
    return uint(reuse.turn + reuse.period - (tile.x + tile.y * ((reuse.period + 1) / 2)) % reuse.period) % uint(reuse.period);
}

void list_pixels(bool traced)
{
    uint own = gl_LocalInvocationIndex;
    if (own < 2u)
        listed_bits[own] = 0u;
    barrier();
    if (traced)
        atomicOr(listed_bits[own / 32u], 1u << (own % 32u));
    barrier();
    if (own == 0u && (listed_bits[0] | listed_bits[1]) != 0u) {
        uint number = atomicAdd(left.count, 1u);
        atomicMax(left.groups_x, min(number + 1u, TILES_IN_ROW));
        atomicMax(left.groups_y, number / TILES_IN_ROW + 1u);
        left.tiles[number] = Tile(uvec2(tile_first()), uvec2(listed_bits[0], listed_bits[1]),
                                  uintBitsToFloat(uvec2(tile_depth_min, tile_depth_max)), uvec2(0u));
    }
}

#ifdef ACCUMULATE
// Is what is seen, from where it was seen then, the same to the last bit? Then its mean of as many traces as it may have stays, for as long as
// nothing moves: it is as good as it gets, and does not flicker. A surface that creeps has other bits.
bool is_as_it_was(ivec2 pixel, float depth)
{
    return reuse.stands != 0 && fetch_trace(depth_before, pixel).r == depth &&
           fetch_trace(normal_before, pixel).xy == fetch_trace(normal_texture, pixel).xy;
}
#endif

void main()
{
    ivec2 pixel = invocation_pixel(), q;
    bool on_image = is_wanted(pixel);
    float depth = on_image ? fetch_trace(depth_texture, pixel).r : 0.0, visibility = 1.0;
    bool seen = depth > 0.0, traced = seen;
    uint age = age_out_of_turn(), since = 0u, traces = 0u;
    vec3 position = view_position(pixel, depth);
    vec3 normal = on_image ? nook_octahedral_decode(fetch_trace(normal_texture, pixel).xy) : vec3(0.0, 0.0, 1.0);
    vec3 before = rows_apply(reuse.before_from_view, vec4(position, 1.0));
    uint ages = 0u; // of the predecessor
    if (seen && reuse.has_before != 0 && predecessor(pixel, before, normal, q)) {
        visibility = fetch_trace(visibility_before, q).r;
        ages = texelFetch(age_before, q, 0).r;
        age = age_of(ages) + 1u;
        since = since_of(ages) + 1u;
        traces = mean_of(ages);
        traced = age >= uint(reuse.period);
        age = traced ? 0u : age;
    }
    bool wanted = traces > 0u && (ACCUMULATES || !traced); // what is traced is a part of a mean, too
    float change = tile_begin(depth, position) ? change_since(wanted, int(since), position, normal) : 0.0;
    if (wanted && !(change <= reuse.error)) { // also NaN
        age = traced ? age : age_out_of_turn();
        traced = true;
        traces = 0u;
    }
#ifdef ACCUMULATE
    if (wanted && change == 0.0 && traces == uint(reuse.most) && is_as_it_was(pixel, depth)) {
        age = age_of(ages);
        since = since_of(ages);
        traced = false;
    }
#endif
    if (traced) {
        since = 0u;
        traces = min(traces + 1u, uint(reuse.most));
    }
    if (on_image) {
        imageStore(visibility_image, pixel, vec4(visibility));
        imageStore(age_image, pixel, uvec4(ages_packed(age, since, traces)));
#ifdef ACCUMULATE
        imageStore(carried_image, pixel, vec4(visibility));
#endif
    }
    list_pixels(traced);
    add_counts();
}
