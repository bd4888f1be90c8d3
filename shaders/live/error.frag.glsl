#version 450
// Visibility less the truth, by the colours of modules/measure/colour_map.c.
layout(binding = 0) uniform sampler2D visibility_texture; // of the frame's size, or one texel
layout(binding = 1) uniform sampler2D truth_texture; // visibility too
layout(binding = 2) uniform sampler2D depth_texture; // reversed-Z, 0 where nothing is drawn
layout(binding = 3) uniform sampler2D colours;       // one row, from -range to +range
layout(location = 0) uniform float range;
layout(location = 1) uniform vec3 no_geometry;
layout(location = 0) out vec4 image;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float error = texelFetch(visibility_texture, min(pixel, textureSize(visibility_texture, 0) - 1), 0).r - texelFetch(truth_texture, pixel, 0).r;
    int last = textureSize(colours, 0).x - 1;
    int at = int(round(clamp(0.5 + 0.5 * error / range, 0.0, 1.0) * float(last)));
    bool drawn = texelFetch(depth_texture, pixel, 0).r > 0.0;
    image = vec4(drawn ? texelFetch(colours, ivec2(at, 0), 0).rgb : no_geometry, 1.0);
}
