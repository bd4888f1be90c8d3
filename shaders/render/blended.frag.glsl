#version 450
// A blended surface, lit where it is drawn. Its ambient light is not occluded: the visibility is that of what lies behind.
#include "render/surface.glsl"
#include "render/shade.glsl"

layout(location = 0) out vec4 light;

void main()
{
    Surface s = surface_read();
    Lit lit;
    lit.relative = mat3(frame.world_from_view) * surface_position_view;
    lit.normal = s.normal;
    lit.geometric_normal = s.geometric_normal;
    lit.base_colour = s.base_colour;
    lit.metallic = s.metallic;
    lit.roughness = s.roughness;
    lit.visibility = s.occlusion;
    vec3 radiance = s.emissive + (s.unlit ? s.base_colour : shade(lit));
    light = vec4(min(radiance, vec3(65000.0)), clamp(s.alpha, 0.0, 1.0));
}
