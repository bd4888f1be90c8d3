#version 450
// Light of the G-buffer, or the sky where it is empty. Writes exposed radiance, RGBA16F; with TO_IMAGE defined what the screen
// shows of it, RGBA8, when nothing blended comes over it.
#include "render/frame.glsl"
#include "render/shade.glsl"
#include "render/gbuffer_read.glsl"
#include "render/tone.glsl"

layout(location = 0) out vec4 result;

void main()
{
    float depth = read_pixel(depth_texture).r;
    vec3 radiance;
    if (depth == 0.0) {
        radiance = sky_radiance(normalize(pixel_ray()));
    } else {
        Lit s = read_surface(depth);
        bool unlit = read_pixel(material_texture).a > 0.5;
        radiance = read_pixel(emissive_texture).rgb + (unlit ? s.base_colour : shade(s));
    }
#ifdef TO_IMAGE
    result = vec4(srgb_encode(tone_map(radiance)), 1.0);
#else
    result = vec4(min(radiance, vec3(65000.0)), 1.0); // the largest half float is 65504
#endif
}
