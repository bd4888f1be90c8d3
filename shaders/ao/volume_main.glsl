#pragma once
// main() of the technique "volume": see volume_pass.glsl.
#include "ao/volume_pass.glsl"

// The paper's: product of the volumes' visibilities; darkens where volumes overlap, lights where they do not (C5). `visibility` is
// that of earlier parts. A part that does not hold all rays holds one occluder only; the last of such parts has its factor.
float multiply_visibilities(float visibility, bool inside, vec3 position, vec3 normal, ivec2 pixel)
{
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    int block = block_of(pixel);
    float shift = noise(pixel, 1u);
    for (int chunk = part.z; chunk < part.w; chunk += CHUNK) {
        tile_list(chunk, part.w);
        for (uint i = 0u; inside && i < tile_count; i++) {
            Occluder o = occluder_at(tile_items[i]);
            Receiver r = receive(o, position, normal);
            if (!r.can_see)
                continue;
            float sum = part.x == 0 ? 0.0 : imageLoad(kept_image, pixel).r;
            for (int j = part.x; j < part.y; j++) {
                vec3 d = direction(j, params.rays, block, tangent, bitangent, normal);
                float jitter = fract(shift + float(j) * 0.61803399);
                sum += occlusion_along(o, r, d, dot(d, normal), jitter);
            }
            if (part.y < params.rays)
                imageStore(kept_image, pixel, vec4(sum));
            else
                visibility *= 1.0 - sum / float(params.rays);
        }
    }
    return visibility;
}

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
    ivec2 pixel = invocation_pixel();
    bool on_image = is_wanted(pixel), multiply = params.combine == COMBINE_MULTIPLY;
    float depth = on_image ? fetch_trace(depth_texture, pixel).r : 0.0;
    // Between parts the image holds the product so far, or the sum of rho so far.
    bool is_first = part.x == 0 && part.z == 0, is_last = part.y == params.rays && part.w == occluder_count;
    float result = is_first || !on_image ? (multiply ? 1.0 : 0.0) : imageLoad(visibility_image, pixel).r;
    if (tile_begin(depth)) {
        vec3 position = view_position(pixel, depth);
        vec3 normal = on_image ? nook_octahedral_decode(fetch_trace(normal_texture, pixel).xy) : vec3(0.0, 0.0, 1.0);
        if (multiply)
            result = multiply_visibilities(result, depth > 0.0, position, normal, pixel);
        else
            result = sum_union(result, depth > 0.0, position, normal, pixel);
        if (loops_were_ended())
            again.groups_x = gl_NumWorkGroups.x;
    }
    if (is_last && !multiply)
        result = 1.0 - result / float(params.rays);
    if (is_last)
        result = depth > 0.0 ? bounded(result) : 1.0;
    if (on_image)
        imageStore(visibility_image, pixel, vec4(result));
    add_counts();
}
