// Joint bilateral upscaling of the filtered trace (Kopf et al. 2007): of the four trace pixels around each full-resolution pixel,
// bilinear weights times how much each lies on the pixel's surface; where none does, all around have a say. Defines: HAS_NORMAL,
// the host gives normals; to rebuild them too, just in case, would cost a software driver as much as if all were rebuilt. BILINEAR,
// only the four have a say, by weights without exponentials; an invocation then upscales the block of pixels between four trace pixels,
// so that each of these is read once for all of them. REFINE, what weighs too little is listed for refine.glsl.
#include "ao/upscale.glsl"
#include "ao/host.glsl"
#ifdef REFINE
#include "ao/refine_list.glsl"
#endif
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 2) uniform sampler2D filtered_trace; // xyz: normal times depth, 0 without geometry; w: visibility
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

#ifdef BILINEAR
// The sums of both kinds of weight: those of filter.comp.glsl, nearly, and by the plane alone. Where no sample lies on the pixel's own
// surface (the bottom of a joint that the trace has jumped over) the second is the answer, unless refine_around.comp.glsl gives one; where
// none sees anything the pixel is open.
// `weight`: how much of the four lies on the surface, 0 to 1.
float upscaled(Corner corners[4], vec2 part, Guide guide, out float weight)
{
    Mean strict = Mean(1.0, 0.0, 0.0), loose = Mean(1.0, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        Corner corner = corners[i];
        vec2 near = mix(1.0 - part, part, vec2(i & 1, i >> 1));
        Fit fit = fit_of(guide, corner);
        float window = fit.seen ? near.x * near.y + 1e-4 : 0.0, on_surface = fit.facing / fit.spread;
        add(strict, corner.visibility, on_surface >= WEIGHT_MIN ? on_surface * window : 0.0);
#ifndef REFINE
        add(loose, corner.visibility, window / (1.0 + fit.square));
#endif
    }
    weight = strict.weights;
    if (!(strict.weights > 0.0))
        strict = loose;
    return strict.reference + (strict.weights > 0.0 ? strict.sum / strict.weights : 0.0);
}

// @return whether too little of the trace lies on its surface
bool upscale_pixel(Corner corners[4], vec2 part, ivec2 p)
{
    float depth = distance_at(p), result = 1.0, weights = 1e30;
    if (depth > 0.0) {
        vec3 position = full_ray(vec2(p)) * depth;
        result = bounded(upscaled(corners, part, make_guide(position, guide_normal(p, position)), weights));
    }
    imageStore(visibility_out, p, vec4(result));
#ifdef COUNTING
    add_seen(depth);
#endif
    return weights < frame.refine_weight;
}

// The pixels whose trace_centre() lies between `base` and the trace pixel above and to the right of it; modules/ao/passes.c counts them.
void main()
{
    int side = frame.scale;
    ivec2 base = (frame.full_begin + side / 2) / side - 1 + ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = base * side + side / 2;
    if (any(greaterThanEqual(first, frame.full_end)))
        return;
    Corner corners[4];
    for (int i = 0; i < 4; i++)
        corners[i] = read_corner(filtered_trace, clamp(base + ivec2(i & 1, i >> 1), ivec2(0), frame.size - 1));
#ifdef COUNTING
    ivec2 inside = min(first + side, frame.full_size) - max(first, ivec2(0)); // of the picture, also where only a part is wanted
    uint shared_units = fetches * FETCH_UNITS / uint(inside.x * inside.y);
#endif
    uint unmet = 0u;
    for (int y = 0; y < side; y++) {
        for (int x = 0; x < side; x++) {
            ivec2 p = first + ivec2(x, y);
            if (any(lessThan(p, frame.full_begin)) || any(greaterThanEqual(p, frame.full_end)))
                continue;
#ifdef COUNTING
            uint before = fetches;
#endif
            if (upscale_pixel(corners, vec2(x, y) / float(side), p))
                unmet |= 1u << (y * side + x);
#ifdef COUNTING
            if ((frame.counting & COUNT_PIXELS) != 0)
                add_to_pixels(p, 1, shared_units + (fetches - before) * FETCH_UNITS);
#endif
        }
    }
#ifdef REFINE
    list_block(first, side, unmet);
#endif
#ifdef COUNTING
    if ((frame.counting & COUNT_SUMS) != 0)
        add_to_sums();
#endif
}
#else
// The four around a point, bilinear. A lone one on the surface counts also where it is the farthest.
void add_corners(inout Mean mean, Guide guide, vec2 centre)
{
    ivec2 base = ivec2(floor(centre));
    vec2 part = centre - vec2(base);
    for (int i = 0; i < 4; i++) {
        ivec2 step = ivec2(i & 1, i >> 1), q = clamp(base + step, ivec2(0), frame.size - 1);
        vec2 near = mix(1.0 - part, part, vec2(step));
        vec4 texel = fetch_trace(filtered_trace, q);
        add(mean, texel.w, weight_on_surface(guide, q, texel.xyz) * (near.x * near.y + 1e-4));
    }
}

// Those of 5x5 around a point. A loop that a software driver leaves at once where nothing is wanted: it would run the inside of an
// if in any case.
void add_around(inout Mean mean, Guide guide, vec2 centre)
{
    ivec2 base = ivec2(round(centre)) - 2;
#ifdef REFINE
    int wanted = 0; // refine_around.comp.glsl does that
#else
    int wanted = mean.weights > 0.0 ? 0 : 25;
#endif
    for (int i = 0; i < wanted; i++) {
        ivec2 q = base + ivec2(i % 5, i / 5), inside = clamp(q, ivec2(0), frame.size - 1);
        vec2 covered = clamp(2.5 - abs(vec2(q) - centre), 0.0, 1.0);
        vec4 texel = fetch_trace(filtered_trace, inside);
        float weight = weight_around(guide, inside, texel.xyz) * covered.x * covered.y;
        add(mean, texel.w, q == inside ? weight : 0.0);
    }
}

float upscaled(vec2 centre, Guide guide, out float weights)
{
    Mean mean = Mean(1.0, 0.0, 0.0);
    add_corners(mean, guide, centre);
    weights = mean.weights;
    add_around(mean, guide, centre);
    return mean.reference + (mean.weights > 0.0 ? mean.sum / mean.weights : 0.0);
}

void main()
{
    ivec2 p = frame.full_begin + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.full_end)))
        return;
    float depth = distance_at(p), result = 1.0, weights = 1e30;
    if (depth > 0.0) {
        vec3 position = full_ray(vec2(p)) * depth;
        result = bounded(upscaled(trace_centre(p), make_guide(position, guide_normal(p, position)), weights));
    }
    imageStore(visibility_out, p, vec4(result));
#ifdef COUNTING
    add_seen(depth);
#endif
#ifdef REFINE
    if (weights < frame.refine_weight)
        list_block(p, 1, 1u);
#endif
    add_counts_of(p, 1);
}
#endif
