#version 450
// The voxels of one volume where its body stands: each pixel's ray from voxel to voxel (Amanatides, Woo 1987).
layout(binding = 0) uniform sampler3D atlas;
layout(location = 0) uniform ivec3 origin;   // of the volume, voxels of the atlas
layout(location = 1) uniform ivec3 size;     // voxels
layout(location = 2) uniform vec3 voxel_x;   // columns of voxel from view; (0, 0, 0) at the outer corner of the volume
layout(location = 3) uniform vec3 voxel_y;
layout(location = 4) uniform vec3 voxel_z;
layout(location = 5) uniform vec3 start;     // voxels: the eye
layout(location = 6) uniform vec4 rays;      // view ray of a pixel: (ndc * xy, -1); zw: size of the frame, pixels
layout(location = 7) uniform vec3 light;     // unit, view space
layout(location = 8) uniform float threshold;// density of a full voxel
layout(location = 0) out vec4 image;

const vec3 COLOUR = vec3(0.95, 0.62, 0.25);

void main()
{
    vec2 ndc = gl_FragCoord.xy / rays.zw * 2.0 - 1.0;
    mat3 voxel_from_view = mat3(voxel_x, voxel_y, voxel_z);
    vec3 along = voxel_from_view * vec3(ndc * rays.xy, -1.0);
    vec3 safe = mix(along, vec3(1e-20), lessThan(abs(along), vec3(1e-20)));
    vec3 a = -start / safe, b = (vec3(size) - start) / safe, near = min(a, b), far = max(a, b);
    float enter = max(max(max(near.x, near.y), near.z), 0.0), leave = min(min(far.x, far.y), far.z);
    if (enter >= leave)
        discard;
    vec3 at = start + along * enter;
    ivec3 voxel = clamp(ivec3(floor(at)), ivec3(0), size - 1), step = ivec3(sign(safe));
    vec3 next = (vec3(voxel) + vec3(greaterThan(step, ivec3(0))) - start) / safe, delta = abs(1.0 / safe);
    int axis = near.x >= near.y && near.x >= near.z ? 0 : near.y >= near.z ? 1 : 2;
    int turns = size.x + size.y + size.z;
    for (int i = 0; i < turns; i++) {
        if (texelFetch(atlas, origin + voxel, 0).r >= threshold) {
            vec3 normal = vec3(0.0);
            normal[axis] = -float(step[axis]);
            vec3 shown = normalize(transpose(voxel_from_view) * normal); // a face's normal moves by the inverse transpose
            float rim = (voxel.x + voxel.y + voxel.z) % 2 == 0 ? 1.0 : 0.9;   // neighbours can be told apart
            image = vec4(COLOUR * rim * (0.35 + 0.65 * max(dot(shown, light), 0.0)), 1.0);
            return;
        }
        axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        voxel[axis] += step[axis];
        next[axis] += delta[axis];
        if (voxel[axis] < 0 || voxel[axis] >= size[axis])
            break;
    }
    discard;
}
