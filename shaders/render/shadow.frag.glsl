#version 450
// Defines: MASKED cuts holes where the material's alpha does.
layout(location = 0) in vec2 shadow_uv;
layout(location = 1) in vec4 shadow_colour;
#include "render/material.glsl"

void main()
{
#ifdef MASKED
    if (material_base_colour(shadow_uv, shadow_colour).a < drawn.emissive_cutoff.w)
        discard;
#endif
}
