// Technique "ssao": Mittring 2007. A = mean over points around p of [the depth buffer hides the point] * rho(|hider - p|).
#include "ao/frame.glsl"
#include "ao/falloff.glsl"
#include "ao/counter.glsl"
#include "ao/directions.glsl"
#include "nook/octahedral.glsl"
#include "nook/params.glsl"
layout(local_size_x = 16, local_size_y = 8) in;
layout(std140, binding = 1) uniform Params {
#include "modules/ao_ssao/params.def"
} params;
layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 0, r32f) uniform writeonly image2D visibility_image;

const int KERNEL_SPHERE = 0;

// Unit direction, uniform over the hemisphere or sphere, from the cosine-weighted table: its z^2 is uniform in (0, 1).
vec3 uniform_direction(int sample_index, int block)
{
    vec3 local = texelFetch(directions, ivec2(sample_index, block), 0).xyz;
    float z = params.kernel == KERNEL_SPHERE ? 2.0 * local.z * local.z - 1.0 : local.z * local.z;
    float radius = max(length(local.xy), 1e-6);
    return vec3(local.xy / radius * sqrt(max(1.0 - z * z, 0.0)), z);
}

// How much the depth buffer occludes p through `point`.
float test_point(vec3 p, vec3 point, inout uint fetches)
{
    if (point.z >= 0.0)
        return 0.0;
    vec2 at = round(trace_pixel(point)); // close to the eye it may be larger than any int
    if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(frame.size)))))
        return 0.0;
    ivec2 q = ivec2(at);
    float depth = texelFetch(depth_texture, q, 0).r;
    fetches++;
    if (depth <= 0.0 || depth >= -point.z - params.bias * frame.r_max)
        return 0.0;
    return falloff(distance(view_position(q, depth), p));
}

float occlusion(ivec2 pixel, vec3 p, vec3 normal, inout uint fetches)
{
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    int block = direction_block(pixel);
    float shift = noise(pixel & 3, 2u), sum = 0.0;
    for (int i = 0; i < params.samples; i++) {
        vec3 local = uniform_direction(i, block);
        float radius = frame.r_max * pow(fract(shift + (float(i) + 0.5) * 0.61803399), 1.0 / 3.0); // uniform in the volume
        sum += test_point(p, p + radius * (tangent * local.x + bitangent * local.y + normal * local.z), fetches);
    }
    float mean = sum / float(params.samples);
    return params.kernel == KERNEL_SPHERE ? max(2.0 * mean - 1.0, 0.0) : mean;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, frame.size)))
        return;
    float depth = texelFetch(depth_texture, pixel, 0).r, visibility = 1.0;
    uint fetches = 0u;
    if (depth > 0.0) {
        vec3 normal = nook_octahedral_decode(texelFetch(normal_texture, pixel, 0).xy);
        visibility = clamp(1.0 - occlusion(pixel, view_position(pixel, depth), normal, fetches), 0.0, 1.0);
    }
    imageStore(visibility_image, pixel, vec4(visibility));
    count_fetches(fetches);
}
