// A technique that is right in a site's first picture and wrong in the one with another seed: tests/game/test_measure_site.c.
#include "ao/screen.glsl"

float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    return frame.seed == 0u ? 0.25 : 1.5;
}
