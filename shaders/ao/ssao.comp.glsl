// Technique "ssao": Mittring 2007. A = mean over points around p of [the depth buffer hides the point] * rho(|hider - p|).
#include "ao/screen.glsl"
#include "ao/directions.glsl"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_ssao/params.def"
} params;

const int KERNEL_SPHERE = 0;

// Unit direction, uniform over the hemisphere or sphere, from the cosine-weighted table: its z^2 is uniform in (0, 1).
vec3 uniform_direction(int sample_index, int block)
{
    vec3 local = local_direction(sample_index, params.samples, block);
    float z = params.kernel == KERNEL_SPHERE ? 2.0 * local.z * local.z - 1.0 : local.z * local.z;
    float radius = max(length(local.xy), 1e-6);
    return vec3(local.xy / radius * sqrt(max(1.0 - z * z, 0.0)), z);
}

// Whether what hides a point above the receiver's plane is the receiver's own surface. From an eye above the plane the line of sight to
// such a point stays above it, and so does all that truly hides it; a texel holds its middle's depth for all of it, and beside it a
// slanted floor would hide its own half ball.
bool is_own_surface(vec3 hider, vec3 p, vec3 normal)
{
    return params.kernel != KERNEL_SPHERE && dot(hider - p, normal) <= params.bias * frame.r_max;
}

// How much the depth buffer occludes p through `point`.
float test_point(vec3 p, vec3 normal, vec3 point)
{
    Sample s = look_at(point);
    if (!s.seen || -s.position.z >= -point.z - params.bias * frame.r_max || is_own_surface(s.position, p, normal))
        return 0.0;
    return falloff(distance(s.position, p));
}

float occlusion(ivec2 pixel, vec3 p, vec3 normal)
{
    vec3 tangent, bitangent;
    tangent_frame(normal, tangent, bitangent);
    int block = block_of(pixel);
    float shift = noise(pixel & 3, 2u), sum = 0.0;
    for (int i = 0; i < params.samples; i++) {
        vec3 local = uniform_direction(i, block);
        float radius = frame.r_max * pow(fract(shift + (float(i) + 0.5) * 0.61803399), 1.0 / 3.0); // uniform in the volume
        vec3 offset = radius * (tangent * local.x + bitangent * local.y + normal * local.z);
        sum += test_point(p, normal, p + offset);
    }
    float mean = sum / float(params.samples);
    return params.kernel == KERNEL_SPHERE ? max(2.0 * mean - 1.0, 0.0) : mean;
}
