// A technique that makes one mistake in each of the first three columns: tests/ao/test_counting.c.
#include "ao/screen.glsl"

float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    switch (pixel.x) {
    case 0: return uintBitsToFloat(0x7fc00000u); // NaN
    case 1: return 1.0001; // a negative visibility
    case 2: return -0.0001; // one above 1
    case 3: return 1.000001; // rounding
    }
    return 0.25;
}
