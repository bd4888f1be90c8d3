// The filtered shadow of the sun. Needs frame.glsl, lights.glsl. Binding: texture 5, depth along the sun's direction, unfiltered.
#pragma once
#include "render/sun_map.glsl"
layout(binding = 5) uniform sampler2D shadow_map;

// Weights of a cubic B-spline at the four texels around a point; f: its place between the middle two.
vec4 spline_weights(float f)
{
    float g = 1.0 - f;
    return vec4(g * g * g, 4.0 - 3.0 * f * f * (2.0 - f), 4.0 - 3.0 * g * g * (2.0 - g), f * f * f) / 6.0;
}

const float INWARD = 8.0; // half of a spline's texels are 0.24 texels off its middle on average
const float INWARD_MAX = 2.0; // texels

// What the filter knows of the receiver, in texels and the map's depth.
struct Receiver {
    vec3 position;
    vec2 slope; // depth per texel of its plane
    float height; // depth from the position to the plane, which it may be lifted off
    float bias; // what lies less than this before the plane is the receiver itself
    float same; // what lies this near the plane is on it
    float reach; // what lies more than this behind the plane is something else
};

// Sums over the filter's texels, weighed by the spline.
struct Gathered {
    float lit; // those that the sun reaches
    float known; // those that say something about the receiver's surface
    float seen; // those that show the surface itself
    vec2 inward; // the offsets of the known ones: towards the inside of the surface, 0 where it is all around
};

// Adds four texels around a common corner.
void gather(Receiver receiver, vec2 corner, vec4 weights, inout Gathered sum)
{
    const float size = float(textureSize(shadow_map, 0).x);
    vec4 blocker = textureGather(shadow_map, corner / size);
    vec2 offset = corner - receiver.position.xy;
    vec4 x = offset.x + vec4(-0.5, 0.5, 0.5, -0.5);
    vec4 y = offset.y + vec4(0.5, 0.5, -0.5, -0.5);
    // The receiver's own plane at each texel.
    vec4 plane = receiver.height + receiver.slope.x * x + receiver.slope.y * y;
    // Compared with the plane, but never deeper than the position: or the far side of every sunlit corner would count as
    // its own blocker.
    vec4 lit = vec4(greaterThanEqual(blocker, receiver.position.z + min(plane, 0.0) - receiver.bias));
    // A texel that sees past the edge of the surface knows nothing of it; counted as lit it would draw bright lines into
    // the corners of closed rooms, whose walls end where the surface does.
    vec4 known = weights * vec4(lessThanEqual(blocker, receiver.position.z + plane + receiver.reach));
    sum.lit += dot(known, lit);
    sum.seen += dot(weights, vec4(lessThan(abs(blocker - receiver.position.z - plane), vec4(receiver.same))));
    sum.known += dot(known, vec4(1.0));
    sum.inward += vec2(dot(known, x), dot(known, y));
}

Gathered filter_shadow(Receiver receiver)
{
    vec2 base = floor(receiver.position.xy - 0.5);
    vec2 f = receiver.position.xy - 0.5 - base;
    vec4 wx = spline_weights(f.x), wy = spline_weights(f.y);
    Gathered sum = Gathered(0.0, 0.0, 0.0, vec2(0.0));
    for (int j = 0; j < 4; j += 2) {
        for (int i = 0; i < 4; i += 2) {
            vec4 weights = vec4(wx[i], wx[i + 1], wx[i + 1], wx[i]) * vec4(wy[j + 1], wy[j + 1], wy[j], wy[j]);
            gather(receiver, base + vec2(i, j), weights, sum);
        }
    }
    return sum;
}

// Fraction of the sun that reaches a point. Flat receivers do not shadow themselves at any slope, because each texel is
// compared with the receiver's plane at that texel; what is left of the bias covers rounding and curved surfaces.
// There must be a sun.
float sun_shadow(vec3 relative, vec3 geometric)
{
    const SunMap map = sun_map();
    float texel = map.axis_z.w;
    // The normal in the sun's axes; z away from the sun, so a lit surface has z < 0.
    vec3 normal = vec3(dot(map.axis_x.xyz, geometric), dot(map.axis_y.xyz, geometric), dot(map.axis_z.xyz, geometric));
    float cosine = max(-normal.z, 0.02);
    // Near grazing light the point is lifted off its triangle, about to where the smooth surface would be that the
    // triangles stand for: a facet of a coarse curved mesh must not shadow the next.
    float grazing = 1.0 - clamp(-normal.z * 4.0, 0.0, 1.0);
    float lift = 6.0 * grazing * grazing; // texels
    vec4 lifted = vec4(relative + geometric * (lift * map.axis_x.w), 1.0);

    Receiver receiver;
    receiver.position = vec3(dot(map.x, lifted), dot(map.y, lifted), dot(map.z, lifted));
    if (any(lessThan(receiver.position, vec3(0.0))) || any(greaterThan(receiver.position, vec3(1.0))))
        return 1.0;
    receiver.position.xy *= float(textureSize(shadow_map, 0).x);
    receiver.slope = normal.xy / cosine * texel;
    receiver.height = lift / cosine * texel;
    receiver.bias = 0.2 * texel + 0.1 * length(receiver.slope) / (1.0 + lift);
    receiver.same = 0.01 * receiver.bias;
    receiver.reach = texel + length(receiver.slope);

    // Where the surface ends in the map it may meet a blocker, as a wall meets its ceiling, and under a texel from there
    // the bias takes the one for the other. Unless the map shows the surface itself, such an edge takes its light from
    // inside, where the whole filter lies on the surface: about two texels from an edge that halves the filter.
    Gathered sum = Gathered(0.0, 0.0, 0.0, vec2(0.0)); // compilers do not know that there is a first turn
    float doubt = 0.0;
    // A loop, because a software driver leaves a loop when no pixel wants more, but runs the inside of an if for all. How
    // often at the most is a number that compilers do not know, or they would unroll it.
    const int turns = 2 * int(lights.sun_direction.w);
    for (int turn = 0; turn < turns; turn++) {
        Gathered found = filter_shadow(receiver);
        if (turn > 0) {
            if (found.known > 0.5 * sum.known) {
                sum.lit = mix(sum.lit, found.lit, doubt);
                sum.known = mix(sum.known, found.known, doubt);
            }
            break;
        }
        sum = found;
        vec2 inward = sum.inward * INWARD;
        float far = length(inward);
        doubt = 1.0 - smoothstep(0.1, 0.4, sum.seen / max(sum.known, 0.001));
        if (!(far > 0.05 && doubt > 0.0))
            break;
        inward *= min(1.0, INWARD_MAX / far);
        receiver.position += vec3(inward, dot(receiver.slope, inward));
    }
    return sum.known > 0.001 ? sum.lit / sum.known : 1.0;
}
