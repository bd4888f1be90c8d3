// Technique "hbao": see modules/ao_hbao/hbao.h. A = mean over azimuths of the sum over rises (sin h_new - sin h_old) rho(d): solid
// angle without the cosine of equation 1 (erratum C18). sin of the elevation is the cosine of the angle from the line of sight.
#include "ao/half_slice.glsl"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_hbao/params.def"
} params;

// Blocked part of one azimuth.
float blocked_part(HalfSlice h, vec3 p, float jitter)
{
    float horizon = max(h.tangent - radians(params.bias), 0.0), sum = 0.0;
    for (int i = 0; i < params.steps; i++) {
        Sample s = look_along(h, p, (float(i) + jitter) / float(params.steps));
        if (!s.inside)
            break;
        vec3 v = s.position - p;
        float apart = length(v), angle = slice_angle(h, v);
        if (s.seen && apart > 0.0 && apart < frame.r_max && angle < horizon) {
            sum += (cos(angle) - cos(horizon)) * falloff(apart);
            horizon = angle;
        }
    }
    return sum;
}

// Sum over all azimuths when nothing blocks: their number when it is even, as opposite ones make up for each other.
float open_parts(vec3 p, vec3 n, float turn)
{
    Azimuths a = azimuths(p, n);
    float sum = 0.0;
    for (int k = 0; k < params.directions; k++) {
        float outward = outward_at(a, 6.2831853 * (float(k) + turn) / float(params.directions));
        sum += 1.0 + outward / length(vec2(a.up, outward)); // 1 - cos(tangent)
    }
    return sum;
}

// Items are azimuths.
float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    vec2 jitter = tile_jitter(pixel);
    float sum = 0.0;
    for (int k = part.x; k < part.y; k++) {
        float angle = 6.2831853 * (float(k) + jitter.x) / float(params.directions);
        sum += blocked_part(half_slice(p, n, angle), p, fract(jitter.y + float(k) * 0.61803399));
    }
    return sum / max(open_parts(p, n, jitter.x), 1e-6);
}
