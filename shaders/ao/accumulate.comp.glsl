// After a trace with ao.accumulate: what was traced becomes part of the mean of what was traced before at its surface (reuse.comp.glsl decides
// whether there is any). Of the first n traces it is their mean; where more
// follow, as the camera moves, each is 1/n of it.
#include "ao/counter.glsl"
#include "ao/ages.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 4) uniform sampler2D carried_texture;
layout(binding = 7) uniform usampler2D age_texture;
layout(binding = 0, r32f) uniform image2D visibility_image;

void main()
{
    ivec2 pixel = invocation_pixel();
    if (!is_wanted(pixel))
        return;
    uint ages = texelFetch(age_texture, pixel, 0).r, traces = mean_of(ages);
    if (since_of(ages) == 0u && traces > 1u) {
        float traced = imageLoad(visibility_image, pixel).r, carried = fetch_trace(carried_texture, pixel).r;
        imageStore(visibility_image, pixel, vec4(carried + (traced - carried) / float(traces)));
    }
    add_counts();
}
