#pragma once
// The union of volumes in which a ray ends where it first meets something; of the kind it takes
//   float march(Occluder o, Receiver r, vec3 d, float cosine, float limit, float jitter)   metres to the first hit, or NO_HIT
#include "ao/volume_pass.glsl"
#include "ao/nearest_hit.glsl"
#include "ao/tile_list.glsl"

// Exact for any number of volumes: rho of the nearest hit, ray by ray. Uniform control flow. `sum` is that over the rays of earlier
// parts; rays are added one by one, so that the cut does not show in the result. A part without the last occluder has one ray
// only, whose nearest hit waits.
float sum_union(float sum, bool inside, vec3 position, vec3 normal, ivec2 pixel)
{
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    int block = block_of(pixel);
    ivec2 places = tile_places(part.z, part.w);
    float shift = noise(pixel, 1u), start = part.z > 0 ? imageLoad(kept_image, place).r : frame.r_max;
    for (int first = part.x; first < part.y; first += BATCH) {
        int last = min(first + BATCH, part.y);
        Batch nearest = Batch(vec4(start), vec4(start));
        for (int chunk = places.x; chunk < places.y; chunk += CHUNK) {
            if (first == part.x || places.y - places.x > CHUNK)
                tile_list(chunk, places, part.zw);
            uint i = tile_next(inside ? 0u : tile_count, position);
            do {
                if (i < tile_count) {
                    Occluder o = occluder_at(tile_items[i]);
                    Receiver r = receive(o, position, normal);
                    for (int ray = first; r.can_see && ray < last; ray++) {
                        vec3 d = direction(ray, params.rays, block, tangent, bitangent, normal);
                        float jitter = fract(shift + float(ray) * 0.61803399);
                        float before = batch_get(nearest, ray - first);
                        batch_set(nearest, ray - first, min(before, march(o, r, d, dot(d, normal), before, jitter)));
                    }
                }
                i = tile_next(i + 1u, position);
            } while (i < tile_count);
        }
        if (part.w < occluder_count)
            imageStore(kept_image, place, vec4(nearest.low.x));
        for (int ray = first; ray < last; ray++) // not from 0 to a batch: compilers would write that out for each ray
            sum += part.w == occluder_count ? falloff(batch_get(nearest, ray - first)) : 0.0;
    }
    return sum;
}
