#pragma once
// main() of the technique "volume" with path = compute: see volume_pass.glsl. Beside the kind it takes
//   float sum_union(float sum, bool inside, vec3 position, vec3 normal, ivec2 pixel)
// or, with MULTIPLY defined, nothing more. Not a branch: a program with both takes 1.8 times as long to compile.
#include "ao/volume_factor.glsl"
#include "ao/tile_list.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32f) uniform image2D visibility_image;
#include "ao/point.glsl"
// Groups of the dispatches that do everything again, carefully: none unless loops were ended.
layout(std430, binding = 5) buffer Again {
    uint groups_x, groups_y, groups_z;
} again;

#ifdef MULTIPLY
const bool multiply = true;

// The paper's: product of the volumes' visibilities; darkens where volumes overlap, lights where they do not (C5). `visibility` is
// that of earlier parts. A part that does not hold all rays holds one occluder only.
float multiply_visibilities(float visibility, bool inside, vec3 position, vec3 normal, ivec2 pixel)
{
    Bundle bundle = bundle_of(pixel, position, normal);
    ivec2 places = tile_places(part.z, part.w);
    for (int chunk = places.x; chunk < places.y; chunk += CHUNK) {
        tile_list(chunk, places, part.zw);
        uint i = tile_next(inside ? 0u : tile_count, position);
        do {
            if (i < tile_count)
                visibility *= visibility_past(occluder_at(tile_items[i]), bundle);
            i = tile_next(i + 1u, position);
        } while (i < tile_count);
    }
    return visibility;
}
#else
const bool multiply = false;
#endif

// Has llvmpipe ended this invocation's loops? It lets each go on for one turn then; here is one that wants two, in a number that
// compilers do not know, or they would unroll it.
bool loops_were_ended()
{
    int wanted = occluder_count > 0 ? 2 : 1, turns = 0;
    while (turns < wanted)
        turns++;
    return turns < wanted;
}

void main()
{
    Point point = point_of_invocation();
    bool on_image = point.wanted;
    float depth = point.depth;
    place = point.place;
    // Between parts the image holds the product so far, or the sum of rho so far.
    bool is_first = part.x == 0 && part.z == 0, is_last = part.y == params.rays && part.w == occluder_count;
    float result = is_first || !on_image ? (multiply ? 1.0 : 0.0) : imageLoad(visibility_image, place).r;
    if (tile_begin(depth, point.position)) {
        vec3 normal = normal_of(point);
#ifdef MULTIPLY
        result = multiply_visibilities(result, depth > 0.0, point.position, normal, point.pixel);
#else
        result = sum_union(result, depth > 0.0, point.position, normal, point.pixel);
#endif
        if (loops_were_ended()) {
            again.groups_x = gl_NumWorkGroups.x;
            again.groups_y = gl_NumWorkGroups.y;
        }
    }
    if (is_last && !multiply)
        result = 1.0 - result / float(params.rays);
    if (is_last)
        result = depth > 0.0 ? bounded(result) : 1.0;
    if (on_image)
        imageStore(visibility_image, place, vec4(result));
    add_counts_of(point);
}
