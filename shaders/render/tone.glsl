// From exposed radiance to what a screen shows.
#pragma once

// Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: rises everywhere, 0 stays 0.
vec3 tone_map(vec3 c)
{
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}

// From sRGB, by a cubic that is off by at most 0.0017.
vec3 srgb_decode(vec3 c)
{
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// sRGB, c in [0, 1]. The power 1 / 2.4 as a sum of roots: off by at most 0.0004, a tenth of a step of 8 bits (fitted to the least
// greatest error), and on software GL a quarter of the time.
vec3 srgb_encode(vec3 c)
{
    vec3 root = sqrt(c);
    vec3 curve = 0.833738 * root + 0.298119 * sqrt(root) - 0.0553096 * c - 0.0769054;
    return mix(c * 12.92, curve, greaterThan(c, vec3(0.0031308)));
}
