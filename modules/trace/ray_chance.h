/** ray_chance.h - numbers of Embree's packets, and a chance of each ray: inside modules/trace only. */
#pragma once
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Embree's packets are arrays of N, one for each number of a ray or hit (rtcore_ray.h); its functions for them are C++. */
enum { RAY_ORIGIN = 0, RAY_NEAR = 3, RAY_DIRECTION = 4, RAY_FAR = 8, RAY_NUMBERS = 12 };
enum { HIT_NORMAL = 0, HIT_U = 3, HIT_V = 4, HIT_TRIANGLE = 5, HIT_GEOMETRY = 6, HIT_INSTANCE = 7 };

static inline float number_of(const void *packet, unsigned n, unsigned i, int which)
{
    float number;
    memcpy(&number, (const char *)packet + ((size_t)which * n + i) * sizeof number, sizeof number);
    return number;
}

static inline uint32_t bits_of(const void *packet, unsigned n, unsigned i, int which)
{
    uint32_t bits;
    memcpy(&bits, (const char *)packet + ((size_t)which * n + i) * sizeof bits, sizeof bits);
    return bits;
}

/* Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014: the finaliser. */
static inline uint64_t mix(uint64_t bits)
{
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
    return bits ^ bits >> 31;
}

/* In [0, 1), of a ray and a triangle, or what else it meets. */
static inline double chance(const void *ray, unsigned n, unsigned i, uint32_t triangle)
{
    uint64_t bits = triangle;
    for (int k = 0; k < 3; k++) {
        bits = mix(bits + 0x9e3779b97f4a7c15u + bits_of(ray, n, i, RAY_ORIGIN + k));
        bits = mix(bits + 0x9e3779b97f4a7c15u + bits_of(ray, n, i, RAY_DIRECTION + k));
    }
    return (double)(bits >> 11) * 0x1p-53;
}
