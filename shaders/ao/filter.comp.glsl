// Joint bilateral filter (Papaioannou et al. 2010, section 6; Kopf et al. 2007): samples of the trace around each pixel, weighted
// by distance to the pixel's plane and by normal. ao.filter chooses which: none, the nearest sample; with DISC defined the paper's
// 17-sample Gaussian disc, narrowed along the depth gradient so that it stays on the surface; with TILE the 4x4 pixels that share one set
// of rays. For full-resolution pixels it upscales in the same pass; with AT_TRACE defined it filters the trace's own, and
// upscale.comp.glsl comes after it; with SUPPORT it lists those that it finds too few samples for: support.glsl.
#include "ao/guide.glsl"
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 2) uniform sampler2D depth_trace_texture;
layout(binding = 3) uniform sampler2D normal_trace;
layout(binding = 4) uniform sampler2D visibility_trace_texture;
#ifdef AT_TRACE
layout(binding = 0, rgba32f) uniform writeonly image2D filtered_out; // as upscale.comp.glsl reads it
#ifdef SUPPORT
#include "ao/support.glsl"
#endif
#else
layout(binding = 0) uniform sampler2D depth_full;
layout(binding = 1) uniform sampler2D normal_full;
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;
#endif

// A golden-angle disc: radius sqrt((i + 0.5) / 16); the 17th sample is the centre.
const int RING = 16;
const float GOLDEN_ANGLE = 2.39996323;
const float SLANT_MIN = 0.5; // a disc of 4 pixels then still covers the 4x4 pixels that share one set of rays

struct Mean {
    float reference, sum, weights;
};

float trace_depth(ivec2 q)
{
    return fetch_trace(depth_trace_texture, q).r;
}

float trace_visibility(ivec2 q)
{
    return fetch_trace(visibility_trace_texture, q).r;
}

float guide_weight(Guide guide, ivec2 q, float depth)
{
    float plane = plane_distance(guide, view_position(q, depth));
    float facing = max(dot(guide.normal, nook_octahedral_decode(fetch_trace(normal_trace, q).xy)), 0.0);
    return exp(-plane * plane) * pow(max(facing, 1e-6), frame.filter_normal);
}

void add_sample(inout Mean mean, Guide guide, ivec2 q, float window)
{
    if (window <= 0.0 || any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
        return;
    float depth = trace_depth(q);
    float weight = depth > 0.0 ? guide_weight(guide, q, depth) : 0.0;
    if (!(weight >= WEIGHT_MIN)) // nor has one that is not a number
        return;
    mean.sum += window * weight * (trace_visibility(q) - mean.reference);
    mean.weights += window * weight;
}

// When no sample lies on the pixel's own surface (the bottom of a joint that the trace has jumped over), one alone would show
// its noise: all around have a say, those near the pixel's plane most.
void add_around(inout Mean mean, Guide guide, vec2 centre)
{
    ivec2 base = ivec2(round(centre));
    for (int i = 0; i < 25; i++) {
        ivec2 q = base + ivec2(i % 5 - 2, i / 5 - 2);
        if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, frame.size)))
            continue;
        float depth = trace_depth(q);
        vec2 covered = clamp(2.5 - abs(vec2(q) - centre), 0.0, 1.0);
        float weight = covered.x * covered.y / (1.0 + pow(plane_distance(guide, view_position(q, depth)), 2.0));
        if (!(depth > 0.0 && weight > 0.0))
            continue;
        float visibility = trace_visibility(q);
        if (mean.weights == 0.0)
            mean.reference = visibility; // the one given may have seen nothing
        mean.sum += weight * (visibility - mean.reference);
        mean.weights += weight;
    }
}

// Disc to ellipse: the surface's slant shortens it along the gradient of depth.
mat2 ellipse(vec3 normal, vec3 position)
{
    vec3 to_eye = -normalize(position);
    float slant = clamp(dot(normal, to_eye), SLANT_MIN, 1.0);
    vec2 gradient = normal.xy - to_eye.xy * dot(normal, to_eye);
    float size = length(gradient);
    vec2 along = size > 1e-4 ? gradient / size : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    return outerProduct(along, along) * slant + outerProduct(across, across);
}

// Of the four trace samples that enclose `centre`, the one that lies best on the guide's plane; nearer ones first.
ivec2 nearest_sample(vec2 centre, Guide guide)
{
    ivec2 base = ivec2(floor(centre)), best = clamp(ivec2(round(centre)), ivec2(0), frame.size - 1);
    float best_weight = 0.0;
    for (int i = 0; i < 4; i++) {
        ivec2 q = clamp(base + ivec2(i & 1, i >> 1), ivec2(0), frame.size - 1);
        float depth = trace_depth(q);
        if (depth <= 0.0)
            continue;
        vec2 apart = vec2(q) - centre;
        float weight = (guide_weight(guide, q, depth) + 1e-6) / (1.0 + dot(apart, apart));
        if (weight > best_weight) {
            best_weight = weight;
            best = q;
        }
    }
    return best;
}

// The paper's: 17 samples, Gaussian.
void add_disc(inout Mean mean, Guide guide, vec2 centre, ivec2 p)
{
    mat2 shape = ellipse(guide.normal, guide.position) * frame.filter_radius;
    float turn = noise(p & 3, 7u) * 6.2831853;
    for (int i = 0; i <= RING; i++) {
        float radius = i == RING ? 0.0 : sqrt((float(i) + 0.5) / float(RING));
        float angle = float(i) * GOLDEN_ANGLE + turn;
        ivec2 q = ivec2(round(centre + shape * (radius * vec2(cos(angle), sin(angle)))));
        add_sample(mean, guide, q, exp(-radius * radius));
    }
}

// A box of exactly 4x4 trace pixels, its rim shared with the neighbours: all 16 blocks of directions.glsl with equal weight.
void add_tile(inout Mean mean, Guide guide, vec2 centre)
{
    ivec2 base = ivec2(round(centre));
    for (int i = 0; i < 25; i++) {
        ivec2 q = base + ivec2(i % 5 - 2, i / 5 - 2);
        vec2 covered = clamp(2.5 - abs(vec2(q) - centre), 0.0, 1.0);
        add_sample(mean, guide, q, covered.x * covered.y);
    }
}

// @param support  samples that it is the mean of, by their weight
float filtered(vec2 centre, Guide guide, ivec2 p, out float support)
{
#ifdef AT_TRACE
    ivec2 start = p;
#else
    ivec2 start = frame.scale == 1 ? p : nearest_sample(centre, guide);
#endif
    Mean mean = Mean(trace_visibility(start), 0.0, 0.0);
#if defined(DISC)
    add_disc(mean, guide, centre, p);
    if (mean.weights <= 0.0)
        add_tile(mean, guide, centre); // a wide disc can miss what lies close by
#elif defined(TILE)
    add_tile(mean, guide, centre);
#endif
    support = mean.weights;
#if defined(DISC) || defined(TILE)
    if (mean.weights <= 0.0)
        add_around(mean, guide, centre);
#endif
    return mean.weights > 0.0 ? mean.reference + mean.sum / mean.weights : mean.reference;
}

#ifdef AT_TRACE
void main()
{
    ivec2 p = frame.begin + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.end)))
        return;
    float depth = trace_depth(p), result = 1.0, support = 1e9;
    vec3 normal = vec3(0.0);
    if (depth > 0.0) {
        normal = nook_octahedral_decode(fetch_trace(normal_trace, p).xy);
        result = bounded(filtered(vec2(p), make_guide(view_position(p, depth), normal), p, support));
    }
    imageStore(filtered_out, p, vec4(normal * depth, result));
#ifdef SUPPORT
    list_unsupported(p, support);
#endif
    add_counts_of(p * frame.scale, frame.scale);
}
#else
void main()
{
    ivec2 p = frame.full_begin + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, frame.full_end)))
        return;
    float depth = fetch_full(depth_full, p).r, result = 1.0, support;
    if (depth > 0.0) {
        vec3 normal = nook_octahedral_decode(fetch_full(normal_full, p).xy);
        result = bounded(filtered(trace_centre(p), make_guide(full_ray(vec2(p)) * depth, normal), p, support));
    }
    imageStore(visibility_out, p, vec4(result));
    add_counts_of(p, 1);
}
#endif
