// Technique "hsao": see modules/ao_hsao/hsao.h. With elevation e above the tangent plane, equation 1 over one azimuth gives
// A = sin^2(e) for everything below e blocked (cosine weighted; classic HBAO's sin(e) lacks the cosine: erratum C18).
#include "ao/screen.glsl"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_hsao/params.def"
} params;

// Below the horizon of one azimuth (`along`, in the tangent plane). out_height: square of the sine of the horizon.
float below_horizon(vec3 p, vec3 n, vec3 along, float jitter, out float out_height)
{
    float bias = sin(radians(params.bias)), height = bias * bias, sum = 0.0;
    for (int i = 0; i < params.steps; i++) {
        Sample s = look_at(p + along * (frame.r_max * (float(i) + jitter) / float(params.steps)));
        vec3 v = s.position - p;
        float apart = length(v), rise = dot(v, n);
        if (!s.seen || apart <= 0.0 || apart >= frame.r_max || rise <= 0.0)
            continue;
        float square = (rise / apart) * (rise / apart);
        if (square > height) {
            sum += (square - height) * falloff(apart);
            height = square;
        }
    }
    out_height = height;
    return sum;
}

// One ray above the horizon: the falloff where it first passes behind a surface within reach, else 0. A texel holds the
// surface at its centre, not where the ray crosses it: what rises less than a texel above the receiver's plane is that plane.
float march_above(vec3 p, vec3 n, vec3 d, float jitter)
{
    for (int i = 0; i < params.ray_steps; i++) {
        float t = frame.r_max * (float(i) + jitter) / float(params.ray_steps);
        vec3 point = p + d * t;
        Sample s = look_at(point);
        vec3 v = s.position - p;
        float texel = -s.position.z * pixel_footprint() * float(frame.scale);
        if (s.seen && s.position.z > point.z && dot(v, n) > texel && length(v) < frame.r_max)
            return falloff(t);
    }
    return 0.0;
}

// Items are azimuths.
float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    vec3 tangent, bitangent;
    tangent_frame(n, tangent, bitangent);
    float turn = noise(pixel, 3u), jitter = noise(pixel, 4u), lift = noise(pixel, 5u), sum = 0.0;
    for (int k = part.x; k < part.y; k++) {
        float angle = 6.2831853 * (float(k) + turn) / float(params.directions), height;
        vec3 along = tangent * cos(angle) + bitangent * sin(angle);
        float first = 0.05 + 0.95 * fract(jitter + float(k) * 0.61803399); // never p itself
        sum += below_horizon(p, n, along, first, height);
        for (int m = 0; m < params.rays; m++) {
            float part = (float(m) + fract(lift + float(k) * 0.75487767)) / float(params.rays);
            float square = mix(height, 1.0, part); // cosine weighted: sin^2 of the elevation is uniform
            vec3 d = along * sqrt(1.0 - square) + n * sqrt(square);
            sum += (1.0 - height) / float(params.rays) * march_above(p, n, d, first);
        }
    }
    return sum / float(params.directions);
}
