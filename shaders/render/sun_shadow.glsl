// The filtered shadow of the sun. Needs frame.glsl. Binding: texture 5, depth along the sun's direction, unfiltered.
#pragma once
layout(binding = 5) uniform sampler2D shadow_map;

// Weights of a cubic B-spline at the four texels around a point; f: its place between the middle two.
vec4 spline_weights(float f)
{
    float g = 1.0 - f;
    return vec4(g * g * g, 4.0 - 3.0 * f * f * (2.0 - f), 4.0 - 3.0 * g * g * (2.0 - g), f * f * f) / 6.0;
}

// What the filter knows of the receiver, in texels and the map's depth.
struct Receiver {
    vec3 position;
    vec2 slope; // depth per texel of its plane
    float bias; // what lies less than this before the plane is the receiver itself
    float reach; // what lies more than this behind the plane is something else
};

// Four texels around a common corner, in textureGather's order: x added to `sum` weighs those that the sun reaches,
// y those that say something about the receiver's surface.
void gather(Receiver receiver, vec2 corner, vec4 weights, inout vec2 sum)
{
    const float size = float(textureSize(shadow_map, 0).x);
    vec4 blocker = textureGather(shadow_map, corner / size);
    vec2 offset = corner - receiver.position.xy;
    vec4 x = offset.x + vec4(-0.5, 0.5, 0.5, -0.5);
    vec4 y = offset.y + vec4(0.5, 0.5, -0.5, -0.5);
    vec4 plane = receiver.slope.x * x + receiver.slope.y * y; // the receiver's own plane at each texel
    // Compared with the plane, but never deeper than the receiver: or the far side of every sunlit corner would count as
    // its own blocker.
    vec4 lit = vec4(greaterThanEqual(blocker, receiver.position.z + min(plane, 0.0) - receiver.bias));
    // A texel that sees past the edge of the surface knows nothing of it; counted as lit it would draw bright lines into
    // the corners of closed rooms, whose walls end where the surface does.
    vec4 known = vec4(lessThanEqual(blocker, receiver.position.z + plane + receiver.reach));
    sum += vec2(dot(weights, lit * known), dot(weights, known));
}

// Fraction of the sun that reaches a point. Flat receivers do not shadow themselves at any slope, because each texel is
// compared with the receiver's plane at that texel; what is left of the bias covers rounding and curved surfaces.
float sun_shadow(vec3 relative, vec3 geometric)
{
    mat3 rows = transpose(mat3(frame.shadow_from_relative));
    float depth_per_metre = length(rows[2]);
    float texel = frame.shadow_texel * depth_per_metre; // a texel's width as depth
    // The normal in the sun's axes; z away from the sun, so a lit surface has z < 0.
    vec3 normal = vec3(dot(normalize(rows[0]), geometric), dot(normalize(rows[1]), geometric),
                       dot(rows[2], geometric) / depth_per_metre);
    float cosine = max(-normal.z, 0.02);
    // Near grazing light the point is lifted off its triangle, about to where the smooth surface would be that the
    // triangles stand for: a facet of a coarse curved mesh must not shadow the next.
    float grazing = 1.0 - clamp(-normal.z * 4.0, 0.0, 1.0);
    float lift = 6.0 * grazing * grazing; // texels
    vec3 lifted = relative + geometric * (lift * frame.shadow_texel);

    Receiver receiver;
    receiver.position = (frame.shadow_from_relative * vec4(lifted, 1.0)).xyz;
    if (any(lessThan(receiver.position, vec3(0.0))) || any(greaterThan(receiver.position, vec3(1.0))))
        return 1.0;
    receiver.position.xy *= float(textureSize(shadow_map, 0).x);
    receiver.slope = normal.xy / cosine * texel;
    receiver.bias = 0.2 * texel + 0.1 * length(receiver.slope);
    receiver.reach = (1.0 + lift / cosine) * texel + length(receiver.slope);

    vec2 base = floor(receiver.position.xy - 0.5);
    vec2 f = receiver.position.xy - 0.5 - base;
    vec4 wx = spline_weights(f.x), wy = spline_weights(f.y);
    vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; j += 2) {
        for (int i = 0; i < 4; i += 2) {
            vec4 weights = vec4(wx[i], wx[i + 1], wx[i + 1], wx[i]) * vec4(wy[j + 1], wy[j + 1], wy[j], wy[j]);
            gather(receiver, base + vec2(i, j), weights, sum);
        }
    }
    return sum.y > 0.001 ? sum.x / sum.y : 1.0;
}
