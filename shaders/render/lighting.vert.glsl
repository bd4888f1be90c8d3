#version 450
// One triangle that covers the screen, with what is one for the whole picture: see by_vertex.glsl, which has the define.
#define VERTICES
#include "render/frame.glsl"
#include "render/lights.glsl"
#include "render/sun_map.glsl"

noperspective out vec4 ray_near; // relative_ray() of the pixel, z_near
noperspective out vec2 place;    // of the pixel, 0 to 1

void main()
{
    vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(ndc, 0.0, 1.0);
    place = ndc * 0.5 + 0.5;
    ray_near = vec4(relative_ray(place * frame.size), frame.z_near);
    handed.sun_direction = lights.sun_direction;
    handed.sun_colour = lights.sun_colour;
    handed.ambient_top = lights.ambient_top;
    handed.ambient_bottom = lights.ambient_bottom;
    const SunMap map = sun_map();
    handed.map_x = map.x;
    handed.map_y = map.y;
    handed.map_z = map.z;
    handed.axis_x = map.axis_x;
    handed.axis_y = map.axis_y;
    handed.axis_z = map.axis_z;
    for (int i = 0; i < BY_VERTEX; i++) {
        handed.position_fade[i] = lights.points[i].position_fade;
        handed.colour[i] = lights.points[i].colour_inner;
    }
    handed.position_fade[BY_VERTEX] = handed.colour[BY_VERTEX] = vec4(0.0);
}
