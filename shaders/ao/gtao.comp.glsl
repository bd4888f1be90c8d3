// Technique "gtao": see modules/ao_gtao/gtao.h. In a slice through the line of sight, with angle t from it and the normal's part
// (out, up) in the slice, equation 1 is 1/pi times the integral of rho (up cos t + out sin t) |sin t| dt over azimuths in [0, pi].
#include "ao/half_slice.glsl"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_gtao/params.def"
} params;

// Integral of (up cos t + out sin t) sin t from 0 to `angle`: the paper's 1/4 (-cos(2h - n) + cos n + 2h sin n) times the length
// of the projected normal, without the angle n.
float arc(HalfSlice h, float angle)
{
    float s = sin(angle);
    return 0.5 * (h.up * s * s + h.outward * (angle - s * cos(angle)));
}

// Behind something thin the horizon falls again towards `angle`. What stays blocked keeps its mean falloff.
void lower_horizon(HalfSlice h, float angle, inout float horizon, inout float sum)
{
    float lowered = mix(horizon, min(angle, h.tangent), params.thickness), open = arc(h, h.tangent);
    sum *= clamp((open - arc(h, lowered)) / max(open - arc(h, horizon), 1e-9), 0.0, 1.0);
    horizon = lowered;
}

// Blocked part of the integral. What raises the horizon is met somewhere between the sample that shows it and the one before: a
// rise counts with the mean of their falloffs, or with its own where the one before lies farther away.
float blocked_arc(HalfSlice h, vec3 p, float jitter)
{
    float horizon = h.tangent, before = 0.0, sum = 0.0;
    for (int i = 0; i < params.steps; i++) {
        Sample s = look_along(h, p, pow((float(i) + jitter) / float(params.steps), params.spacing));
        if (!s.inside)
            break;
        vec3 v = s.position - p;
        float apart = s.seen ? length(v) : frame.r_max, angle = s.seen ? slice_angle(h, v) : h.tangent;
        if (angle >= horizon) {
            if (params.thickness > 0.0 && horizon < h.tangent)
                lower_horizon(h, angle, horizon, sum);
        } else if (apart > 0.0 && apart < frame.r_max) {
            sum += (arc(h, horizon) - arc(h, angle)) * 0.5 * (falloff(min(before, apart)) + falloff(apart));
            horizon = angle;
        }
        before = apart;
    }
    return sum;
}

// Integral over all slices when nothing blocks: arc(tangent) of both halves is up + outward atan(outward / up). For many slices it is
// their number, but a few in which the normal happens to lie may hold 1.57 times that.
float open_arcs(vec3 p, vec3 n, float turn)
{
    Azimuths a = azimuths(p, n);
    float sum = 0.0;
    for (int k = 0; k < params.slices; k++) {
        float outward = outward_at(a, 3.14159265 * (float(k) + turn) / float(params.slices));
        sum += a.up + outward * atan(outward, a.up);
    }
    return sum;
}

// Items are slices.
float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    vec2 jitter = tile_jitter(pixel);
    float sum = 0.0;
    for (int k = part.x; k < part.y; k++) {
        float angle = 3.14159265 * (float(k) + jitter.x) / float(params.slices);
        float first = fract(jitter.y + float(k) * 0.61803399);
        sum += blocked_arc(half_slice(p, n, angle), p, first);
        sum += blocked_arc(half_slice(p, n, angle + 3.14159265), p, 1.0 - first);
    }
    return sum / max(open_arcs(p, n, jitter.x), 1e-6);
}
