#pragma once
// The union of volumes of which a ray passes a part, layer by layer; of the kind it takes
//   Passage walk_volume(Occluder o, Receiver r, vec3 d, float limit)   what the ray meets up to `limit` metres
#include "ao/volume_pass.glsl"
#include "ao/passage.glsl"
#include "ao/tile_list.glsl"

// Two volumes on one ray: each counts as one layer at the distance of its mean rho, and the nearer one is in front. Exact where one
// is opaque, where rho is hard, and for one plane in each; the order of the two does not matter.
Passage combine(Passage a, Passage b)
{
    float rho_a = a.occlusion / max(1.0 - a.transmittance, 1e-6), rho_b = b.occlusion / max(1.0 - b.transmittance, 1e-6);
    float occlusion = rho_a >= rho_b ? a.occlusion + a.transmittance * b.occlusion
                                     : b.occlusion + b.transmittance * a.occlusion;
    a.occlusion = occlusion;
    a.transmittance *= b.transmittance;
    a.end = min(a.end, b.end);
    return a;
}

// Rays one by one through all volumes. Uniform control flow. `sum` is that over the rays of earlier parts; rays are added one by one,
// so that the cut does not show in the result. A part without the last occluder has one ray only, which waits.
float sum_union(float sum, bool inside, vec3 position, vec3 normal, ivec2 pixel)
{
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    int block = block_of(pixel);
    ivec2 places = tile_places(part.z, part.w);
    Passage start = free_passage();
    if (part.z > 0) {
        vec4 kept = imageLoad(kept_image, place);
        start.occlusion = kept.x, start.transmittance = kept.y, start.end = kept.z;
    }
    for (int first = part.x; first < part.y; first += BATCH) {
        int batch = min(BATCH, part.y - first);
        Passage met[BATCH];
        for (int j = 0; j < BATCH; j++)
            met[j] = start;
        for (int chunk = places.x; chunk < places.y; chunk += CHUNK) {
            if (first == part.x || places.y - places.x > CHUNK)
                tile_list(chunk, places, part.zw);
            uint i = tile_next(inside ? 0u : tile_count, position);
            do {
                if (i < tile_count) {
                    Occluder o = occluder_at(tile_items[i]);
                    Receiver r = receive(o, position, normal);
                    for (int j = 0; j < BATCH; j++) { // a constant bound, so that met[] can live in registers
                        if (!r.can_see || j >= batch)
                            break;
                        vec3 d = direction(first + j, params.rays, block, tangent, bitangent, normal);
                        met[j] = combine(met[j], walk_volume(o, r, d, met[j].end));
                    }
                }
                i = tile_next(i + 1u, position);
            } while (i < tile_count);
        }
        if (part.w < occluder_count)
            imageStore(kept_image, place, vec4(met[0].occlusion, met[0].transmittance, met[0].end, 0.0));
        for (int j = 0; j < BATCH; j++)
            sum += j < batch && part.w == occluder_count ? met[j].occlusion : 0.0;
    }
    return sum;
}
