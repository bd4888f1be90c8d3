// What lighting takes that is one for the whole picture, as outputs of lighting.vert.glsl: llvmpipe fetches a uniform for each pixel on its
// own, in 25 instructions a number, and an output of the vertices once for all. Defines: BY_VERTEX, the number of point lights, none of
// them a spot; VERTICES, this is that shader.
#pragma once
#ifdef BY_VERTEX
#ifdef VERTICES
out ByVertex
#else
in ByVertex
#endif
{
    flat vec4 sun_direction, sun_colour, ambient_top, ambient_bottom; // as in lights.glsl
    flat vec4 map_x, map_y, map_z, axis_x, axis_y, axis_z;            // SunMap of sun_map.glsl
    flat vec4 position_fade[BY_VERTEX + 1], colour[BY_VERTEX + 1];    // one more, as there are no empty arrays
}
#ifdef VERTICES
handed;
#else
lights;
#endif
#endif
