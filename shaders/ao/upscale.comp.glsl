// Joint bilateral upscaling of the filtered trace (Kopf et al. 2007): of the four trace pixels around each full-resolution pixel,
// bilinear weights times how much each lies on the pixel's surface. Where none does, all around have a say. Define: HAS_NORMAL,
// the host gives normals; to rebuild them too, just in case, would cost a software driver as much as if all were rebuilt.
#include "ao/guide.glsl"
#include "ao/host.glsl"
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 2) uniform sampler2D filtered_trace; // xyz: normal times depth, 0 without geometry; w: visibility
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

float trace_depth(ivec2 q)
{
    return length(fetch(filtered_trace, q).xyz);
}

float trace_visibility(ivec2 q)
{
    return fetch(filtered_trace, q).w;
}

// filter.comp.glsl's weight in one exponential. 0 where there is no geometry.
float sample_weight(Guide guide, ivec2 q, vec3 normal_depth)
{
    const float LOG2_E = 1.44269504;
    float square = dot(normal_depth, normal_depth), inverse = inversesqrt(max(square, 1e-37));
    float plane = plane_distance(guide, view_position(q, square * inverse));
    float facing = max(dot(guide.normal, normal_depth) * inverse, 1e-6);
    float weight = exp2(log2(facing) * frame.filter_normal - plane * plane * LOG2_E);
    return square > 0.0 && weight >= WEIGHT_MIN ? weight : 0.0; // nor has one a say that is not a number
}

// Bilinear; the sample that counts most is the one that the others are counted from.
float upscaled(vec2 centre, Guide guide)
{
    ivec2 base = ivec2(floor(centre));
    vec2 part = centre - vec2(base);
    float weights[4], values[4], best = 0.0, reference = 0.0;
    for (int i = 0; i < 4; i++) {
        ivec2 step = ivec2(i & 1, i >> 1), q = clamp(base + step, ivec2(0), frame.size - 1);
        vec2 near = mix(1.0 - part, part, vec2(step));
        vec4 texel = fetch(filtered_trace, q);
        // A lone neighbour on the surface counts also where it is the farthest.
        weights[i] = sample_weight(guide, q, texel.xyz) * (near.x * near.y + 1e-4);
        values[i] = texel.w;
        reference = weights[i] > best ? values[i] : reference;
        best = max(best, weights[i]);
    }
    if (best <= 0.0) {
        ivec2 nearest = clamp(ivec2(round(centre)), ivec2(0), frame.size - 1);
        Mean mean = Mean(trace_visibility(nearest), 0.0, 0.0);
        add_around(mean, guide, centre);
        return mean.weights > 0.0 ? mean.reference + mean.sum / mean.weights : mean.reference;
    }
    float sum = 0.0, total = 0.0;
    for (int i = 0; i < 4; i++) {
        sum += weights[i] * (values[i] - reference);
        total += weights[i];
    }
    return reference + sum / total;
}

vec3 guide_normal(ivec2 p, vec3 position)
{
#ifdef HAS_NORMAL
    vec3 normal;
    return given_normal(p, normal) ? normal : -normalize(position);
#else
    return rebuilt_normal(p, -position.z);
#endif
}

void main()
{
    ivec2 p = frame.full_begin + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.full_end)))
        return;
    float depth = distance_at(p), result = 1.0;
    if (depth > 0.0) {
        vec3 position = full_ray(vec2(p)) * depth;
        result = bounded(upscaled(trace_centre(p), make_guide(position, guide_normal(p, position))));
    }
    imageStore(visibility_out, p, vec4(result));
    if ((frame.counting & COUNT_SUMS) != 0 && depth > 0.0)
        atomicAdd(counter.seen, 1u);
    add_counts_of(p, 1);
}
