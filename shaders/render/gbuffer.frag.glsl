#version 450
// Writes the G-buffer. Defines: MASKED cuts at the material's alpha; those of surface.glsl.
#include "render/surface.glsl"
#include "nook/octahedral.glsl"
#ifdef QUICK
#define ENCODE nook_octahedral_encode_any
#else
#define ENCODE nook_octahedral_encode
#endif

layout(location = 0) out vec4 base_colour;      // SRGB8_ALPHA8
layout(location = 1) out vec2 normal;           // RG16
layout(location = 2) out vec2 geometric;        // RG16
layout(location = 3) out vec4 material_numbers; // RGBA8: metallic, roughness, occlusion, 1 = unlit
layout(location = 4) out vec3 emissive;         // R11F_G11F_B10F

void main()
{
    Surface s = surface_read();
#ifdef MASKED
    if (s.alpha < drawn.emissive_cutoff.w)
        discard;
#endif
    base_colour = vec4(s.base_colour, 1.0);
    normal = ENCODE(s.normal);
    geometric = ENCODE(s.geometric_normal);
    material_numbers = vec4(s.metallic, s.roughness, s.occlusion, s.unlit ? 1.0 : 0.0);
    emissive = min(s.emissive, vec3(64000.0)); // the largest number of the format is 64512
}
