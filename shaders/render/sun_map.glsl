// Where the sun's shadow map lies. Needs frame.glsl, lights.glsl.
#pragma once
// Rows of shadow_from_relative; the sun's axes in relative space, unit, with w: metres of a texel, nothing, depth of a texel.
struct SunMap {
    vec4 x, y, z;
    vec4 axis_x, axis_y, axis_z;
};
#if defined(BY_VERTEX) && !defined(VERTICES)
SunMap sun_map()
{
    return SunMap(lights.map_x, lights.map_y, lights.map_z, lights.axis_x, lights.axis_y, lights.axis_z);
}
#else
SunMap sun_map()
{
    mat4 rows = transpose(frame.shadow_from_relative);
    float depth_per_metre = length(rows[2].xyz);
    return SunMap(rows[0], rows[1], rows[2], vec4(normalize(rows[0].xyz), frame.shadow_texel),
                  vec4(normalize(rows[1].xyz), 0.0),
                  vec4(rows[2].xyz / depth_per_metre, frame.shadow_texel * depth_per_metre));
}
#endif
