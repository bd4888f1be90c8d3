// Unit vectors as two unsigned normalised 16-bit numbers (RG16): Meyer et al., "On floating-point normal vectors", 2010.
//
// The stored number is v * 32767 + 32768 of 65535, so that -1, 0 and +1 are exact and the six axes survive the
// round trip unchanged. A plain v * 0.5 + 0.5 has no zero, and every axis-aligned wall would lean by 1e-5.
#pragma once

vec2 nook_octahedral_wrap(vec2 v)
{
    return (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

// Unit vector to [0, 1]^2, for a target of format RG16.
vec2 nook_octahedral_encode(vec3 n)
{
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 v = n.z >= 0.0 ? n.xy : nook_octahedral_wrap(n.xy);
    return (v * 32767.0 + 32768.0) / 65535.0;
}

// The same of a vector of any length, to the last digit or so, with one division.
vec2 nook_octahedral_encode_any(vec3 n)
{
    const float ONE = 32767.0 / 65535.0;
    vec2 v = n.xy * (ONE / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-30));
    vec2 wrapped = (ONE - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    return (n.z >= 0.0 ? v : wrapped) + 32768.0 / 65535.0;
}

// What an RG16 texture returns, unfiltered, to a unit vector.
vec3 nook_octahedral_decode(vec2 t)
{
    vec2 v = (round(t * 65535.0) - 32768.0) / 32767.0;
    vec3 n = vec3(v, 1.0 - abs(v.x) - abs(v.y));
    if (n.z < 0.0)
        n.xy = nook_octahedral_wrap(n.xy);
    return normalize(n);
}
