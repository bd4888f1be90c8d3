#version 450
// Pixels of the trace that are computed as one (8 x 4 of a work group: 32 lanes) go on until the last of them is done. The part of their
// lanes' steps in which a lane waits, 1 - mean / most, by the colours of modules/measure/colour_map.c: 0 none, the last colour all. Of
// totals: lanes that take turns in waiting wait more than it says.
layout(binding = 0) uniform usampler2D counts; // steps of each full-size pixel
layout(binding = 3) uniform sampler2D colours; // one row
layout(location = 0) uniform int scale;        // full-size pixels of a pixel of the trace
layout(location = 1) uniform ivec4 part;       // of the picture: its first pixels and those behind its last
layout(location = 0) out vec4 image;

const ivec2 LANES = ivec2(8, 4);

void main()
{
    ivec2 first = ivec2(gl_FragCoord.xy) / scale / LANES * LANES;
    float sum = 0.0, most = 0.0, lanes = 0.0;
    for (int i = 0; i < LANES.x * LANES.y; i++) {
        ivec2 pixel = (first + ivec2(i % LANES.x, i / LANES.x)) * scale, inside = max(pixel, part.xy);
        if (any(greaterThanEqual(inside, min(pixel + scale, part.zw))))
            continue; // of another view, or of none
        float steps = float(texelFetch(counts, inside, 0).r);
        sum += steps;
        most = max(most, steps);
        lanes += 1.0;
    }
    float waiting = most > 0.0 ? 1.0 - sum / (lanes * most) : 0.0;
    int last = textureSize(colours, 0).x - 1;
    image = vec4(texelFetch(colours, ivec2(int(round(waiting * float(last))), 0), 0).rgb, 1.0);
}
