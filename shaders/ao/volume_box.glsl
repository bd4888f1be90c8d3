#pragma once
// main() of the technique "volume" with path = raster: what an occluder leaves of each pixel in its box. Blending multiplies it into the
// visibility, so that 1 changes nothing. See volume_pass.glsl and modules/ao_volume/boxes.h.
#include "ao/volume_factor.glsl"
flat in int occluder;
layout(location = 0) out float factor;

ivec2 invocation_pixel()
{
    return ivec2(gl_FragCoord.xy);
}

void main()
{
    ivec2 pixel = invocation_pixel();
    place = pixel;
    float depth = fetch_trace(depth_texture, pixel).r;
    factor = 1.0;
    Occluder o = occluder_at(occluder);
    vec3 position = view_position(pixel, depth);
    if (depth > 0.0 && is_near(o, to_voxel(o, position))) { // what is seen through the box or in front of it ends here
        vec3 normal = nook_octahedral_decode(fetch_trace(normal_texture, pixel).xy);
        factor = bounded(visibility_past(o, bundle_of(pixel, position, normal)));
    }
    add_counts();
}
