// Joint bilateral upscaling of the filtered trace (Kopf et al. 2007): of the four trace pixels around each full-resolution pixel,
// bilinear weights times how much each lies on the pixel's surface. Where none does, all around have a say.
#include "ao/guide.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

// Bilinear; the sample that counts most is the one that the others are counted from.
float upscaled(vec2 centre, Guide guide)
{
    ivec2 base = ivec2(floor(centre));
    vec2 part = centre - vec2(base);
    float weights[4], values[4], best = 0.0;
    int chosen = -1;
    for (int i = 0; i < 4; i++) {
        ivec2 step = ivec2(i & 1, i >> 1), q = clamp(base + step, ivec2(0), frame.size - 1);
        vec2 near = mix(1.0 - part, part, vec2(step));
        float depth = fetch(depth_trace, q).r;
        weights[i] = depth > 0.0 ? guide_weight(guide, q, depth) : 0.0;
        if (!(weights[i] >= WEIGHT_MIN)) // nor has one that is not a number
            weights[i] = 0.0;
        weights[i] *= near.x * near.y + 1e-4; // a lone neighbour on the surface counts also where it is the farthest
        values[i] = weights[i] > 0.0 ? fetch(visibility_trace, q).r : 0.0;
        if (weights[i] > best) {
            best = weights[i];
            chosen = i;
        }
    }
    if (chosen < 0) {
        ivec2 nearest = clamp(ivec2(round(centre)), ivec2(0), frame.size - 1);
        Mean mean = Mean(fetch(visibility_trace, nearest).r, 0.0, 0.0);
        add_around(mean, guide, centre);
        return mean.weights > 0.0 ? mean.reference + mean.sum / mean.weights : mean.reference;
    }
    float sum = 0.0, total = 0.0;
    for (int i = 0; i < 4; i++) {
        sum += weights[i] > 0.0 ? weights[i] * (values[i] - values[chosen]) : 0.0;
        total += weights[i];
    }
    return values[chosen] + sum / total;
}

void main()
{
    ivec2 p = frame.full_begin + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.full_end)))
        return;
    float depth = fetch(depth_full, p).r, result = 1.0;
    if (depth > 0.0)
        result = bounded(upscaled(trace_centre(p), guide_full(p, depth)));
    imageStore(visibility_out, p, vec4(result));
    add_counts_of(p, 1);
}
