// Pixels that the four samples around hardly stand for, from more of them: a strip of a surface that is thinner than a pixel of the trace is
// met by some of them, if not by those next to it. Near ones count most; what lies on other surfaces decides where there is nothing else.
// Defines: HAS_NORMAL; TRACED, they are traced afterwards, as many as there is room for.
#include "ao/upscale.glsl"
#include "ao/host.glsl"
#include "ao/refine.glsl"
layout(local_size_x = 64) in;
layout(binding = 2) uniform sampler2D filtered_trace; // as upscale.comp.glsl reads it
layout(binding = 0, r32f) uniform writeonly image2D visibility_out;

const float OTHERS = 1e-3; // what samples on other surfaces weigh, against those on the pixel's own

// Trace pixels; modules/ao/region.c leaves 4 around what is wanted. 0 where all are traced, and nobody will see what was found.
int reach_wanted()
{
#ifdef TRACED
    if (candidates.count <= listed.capacity)
        return 0;
#endif
    return frame.refine_reach;
}

float found_around(ivec2 p, Guide guide)
{
    Mean mean = Mean(1.0, 0.0, 0.0);
    int reach = reach_wanted();
    float part = 1.0 / float(max(reach, 1));
    vec2 centre = trace_centre(p);
    ivec2 base = ivec2(floor(centre)) + 1;
    for (int y = -reach; y < reach; y++) {
        int inset = reach > 1 && (y == -reach || y == reach - 1) ? 1 : 0; // the four at the corners weigh next to nothing
        for (int x = inset - reach; x < reach - inset; x++) {
            ivec2 q = base + ivec2(x, y), inside = clamp(q, ivec2(0), frame.size - 1);
            vec2 near = max(1.0 - abs(vec2(q) - centre) * part, 0.0);
            Corner found = read_corner(filtered_trace, inside);
            Fit fit = fit_of(guide, found);
            near = q == inside && fit.seen ? near * near : vec2(0.0);
            float share = near.x * near.y / min(fit.spread, 1e30);
            add(mean, found.visibility, share * (fit.facing + OTHERS));
        }
    }
    return mean.reference + (mean.weights > 0.0 ? mean.sum / mean.weights : 0.0);
}

void main()
{
    for (uint i = gl_GlobalInvocationID.x; i < candidates.count; i += stride()) {
        ivec2 p = unpack_pixel(candidates.pixels[i]);
        vec3 position = full_ray(vec2(p)) * distance_at(p);
        float found = bounded(found_around(p, make_guide(position, guide_normal(p, position))));
        imageStore(visibility_out, p, vec4(found));
        add_counts_of(p, 1);
        fetches = outside = 0u;
    }
}
