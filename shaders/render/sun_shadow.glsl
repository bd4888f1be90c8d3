// The filtered shadow of the sun. Needs frame.glsl. Binding: texture 5, depth along the sun's direction, unfiltered.
#pragma once
layout(binding = 5) uniform sampler2D shadow_map;

// Weights of a cubic B-spline at the four texels around a point; f: its place between the middle two.
vec4 spline_weights(float f)
{
    float g = 1.0 - f;
    return vec4(g * g * g, 4.0 - 3.0 * f * f * (2.0 - f), 4.0 - 3.0 * g * g * (2.0 - g), f * f * f) / 6.0;
}

// 1 where the sun reaches the corner's four texels. `corner`: the common corner, texels. Order as textureGather's.
vec4 sun_reaches(vec2 corner, vec3 receiver, vec2 slope, float bias)
{
    const float size = float(textureSize(shadow_map, 0).x);
    vec4 blocker = textureGather(shadow_map, corner / size);
    vec2 offset = corner - receiver.xy;
    vec4 x = offset.x + vec4(-0.5, 0.5, 0.5, -0.5);
    vec4 y = offset.y + vec4(0.5, 0.5, -0.5, -0.5);
    // The receiver's own plane at each texel; never deeper than the receiver, or the far side of every sunlit corner
    // would count as its own blocker.
    vec4 plane = receiver.z + min(slope.x * x + slope.y * y, 0.0);
    return vec4(greaterThanEqual(blocker, plane - bias));
}

// Fraction of the sun that reaches a point. Flat receivers do not shadow themselves at any slope, because each texel is
// compared with the receiver's plane at that texel; what is left of the bias covers rounding and curved surfaces.
float sun_shadow(vec3 relative, vec3 geometric)
{
    const float size = float(textureSize(shadow_map, 0).x);
    mat3 rows = transpose(mat3(frame.shadow_from_relative));
    float depth_per_metre = length(rows[2]);
    // The normal in the sun's axes; z away from the sun, so a lit surface has z < 0.
    vec3 normal = vec3(dot(normalize(rows[0]), geometric), dot(normalize(rows[1]), geometric),
                       dot(rows[2], geometric) / depth_per_metre);
    // Near grazing light the point is lifted off its triangle, about to where the smooth surface would be that the
    // triangles stand for: a facet of a coarse curved mesh must not shadow the next.
    float grazing = 1.0 - clamp(-normal.z * 4.0, 0.0, 1.0);
    vec3 lifted = relative + geometric * (6.0 * frame.shadow_texel * grazing * grazing);
    vec3 receiver = (frame.shadow_from_relative * vec4(lifted, 1.0)).xyz;
    if (any(lessThan(receiver, vec3(0.0))) || any(greaterThan(receiver, vec3(1.0))))
        return 1.0;
    receiver.xy *= size;
    float texel = frame.shadow_texel * depth_per_metre; // a texel's width as depth
    vec2 slope = -normal.xy / min(normal.z, -0.02) * texel;
    float bias = texel * 0.2 + 0.1 * length(slope);

    vec2 base = floor(receiver.xy - 0.5);
    vec2 f = receiver.xy - 0.5 - base;
    vec4 wx = spline_weights(f.x), wy = spline_weights(f.y);
    float sum = 0.0;
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            vec4 reaches = sun_reaches(base + vec2(i, j) * 2.0, receiver, slope, bias);
            sum += wy[2 * j] * (reaches.w * wx[2 * i] + reaches.z * wx[2 * i + 1]);
            sum += wy[2 * j + 1] * (reaches.x * wx[2 * i] + reaches.y * wx[2 * i + 1]);
        }
    }
    return sum;
}
