#pragma once
// What one volume leaves of a pixel's visibility, which both paths of the technique "volume" multiply: see volume_pass.glsl.
#include "ao/volume_pass.glsl"

// A pixel's rays.
struct Bundle {
    vec3 position, normal, tangent, bitangent;
    ivec2 pixel;
    int block;
    float shift; // of the jitter, by pixel
};

Bundle bundle_of(ivec2 pixel, vec3 position, vec3 normal)
{
    Bundle b;
    b.position = position;
    b.normal = normal;
    tangent_frame(normal, b.tangent, b.bitangent);
    b.pixel = pixel;
    b.block = block_of(pixel);
    b.shift = noise(pixel, 1u);
    return b;
}

// The paper's 1 - A. The last part of the rays has the factor; the sum over earlier ones waits in the image, and they give 1.
float visibility_past(Occluder o, Bundle b)
{
    Receiver r = receive(o, b.position, b.normal);
    if (!r.can_see)
        return 1.0;
    float sum = part.x == 0 ? 0.0 : imageLoad(kept_image, place).r;
    for (int j = part.x; j < part.y; j++) {
        vec3 d = direction(j, params.rays, b.block, b.tangent, b.bitangent, b.normal);
        float jitter = fract(b.shift + float(j) * 0.61803399);
        sum += occlusion_along(o, r, d, dot(d, b.normal), jitter);
    }
    if (part.y == params.rays)
        return 1.0 - sum / float(params.rays);
    imageStore(kept_image, place, vec4(sum));
    return 1.0;
}
