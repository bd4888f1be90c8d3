// For a view of the work: the volumes that may darken each pixel, as volume.comp.glsl tests them before it marches.
#include "ao/frame.glsl"
#include "ao/tile_list.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 0, r32ui) uniform writeonly uimage2D counts;
layout(location = 0) uniform int occluder_count;

void main()
{
    ivec2 pixel = invocation_pixel();
    float depth = is_wanted(pixel) ? texelFetch(depth_texture, pixel, 0).r : 0.0;
    uint count = 0u;
    vec3 position = view_position(pixel, depth);
    if (tile_begin(depth, position)) {
        for (int chunk = 0; chunk < occluder_count; chunk += CHUNK) {
            tile_list(chunk, ivec2(0, occluder_count), ivec2(0, occluder_count));
            for (uint i = 0u; depth > 0.0 && i < tile_count; i++) {
                Occluder o = occluder_at(tile_items[i]);
                count += uint(is_near(o, to_voxel(o, position)));
            }
        }
    }
    if (is_wanted(pixel))
        imageStore(counts, pixel, uvec4(count));
}
