#version 450
// Whole numbers of each pixel, by the colours of modules/measure/colour_map.c.
layout(binding = 0) uniform usampler2D counts;
layout(binding = 3) uniform sampler2D colours; // one row, from none to the strongest
layout(location = 0) uniform float strongest;  // count that has the last colour
layout(location = 0) out vec4 image;

void main()
{
    float count = float(texelFetch(counts, ivec2(gl_FragCoord.xy), 0).r);
    int last = textureSize(colours, 0).x - 1;
    image = vec4(texelFetch(colours, ivec2(int(round(clamp(count / strongest, 0.0, 1.0) * float(last))), 0), 0).rgb, 1.0);
}
