#version 450
// Three cuts through a volume, side by side: across z, y and x. Lines show where the other two cut.
layout(binding = 0) uniform sampler3D atlas;
layout(location = 0) uniform ivec3 origin; // of the volume, voxels of the atlas
layout(location = 1) uniform ivec3 size;   // voxels
layout(location = 2) uniform vec3 cut;     // parts of the box
layout(location = 3) uniform vec4 place;   // of the view: x, y, width, height, pixels
layout(location = 0) out vec4 image;

const vec3 GROUND = vec3(0.09), EMPTY = vec3(0.16), FULL = vec3(0.93), LINE = vec3(0.95, 0.45, 0.1);

// The cut across `axis` in a square: which voxel, and whether a line runs there.
vec3 cut_at(int axis, vec2 at, float voxels_per_pixel)
{
    int u = axis == 0 ? 2 : 0, v = axis == 1 ? 2 : 1; // axes to the right and upwards
    vec2 extent = vec2(size[u], size[v]);
    vec2 voxel = at * voxels_per_pixel + 0.5 * extent;
    if (any(lessThan(voxel, vec2(0.0))) || any(greaterThanEqual(voxel, extent)))
        return GROUND;
    vec2 from_line = abs(voxel - vec2(cut[u], cut[v]) * extent) / voxels_per_pixel;
    ivec3 p;
    p[axis] = min(int(cut[axis] * float(size[axis])), size[axis] - 1);
    p[u] = int(voxel.x), p[v] = int(voxel.y);
    vec3 colour = mix(EMPTY, FULL, texelFetch(atlas, origin + p, 0).r);
    return min(from_line.x, from_line.y) < 0.75 ? mix(colour, LINE, 0.7) : colour;
}

void main()
{
    vec2 at = gl_FragCoord.xy - place.xy;
    bool wide = place.z >= place.w;
    float length = wide ? place.z : place.w, side = min(length / 3.0, wide ? place.w : place.z);
    float along = wide ? at.x : place.w - at.y; // from the left, or from the top
    int part = clamp(int(along / (length / 3.0)), 0, 2);
    float middle = (float(part) + 0.5) * length / 3.0;
    vec2 centre = wide ? vec2(middle, 0.5 * place.w) : vec2(0.5 * place.z, place.w - middle);
    float largest = float(max(max(size.x, size.y), size.z));
    image = vec4(cut_at(2 - part, at - centre, largest / (0.94 * side)), 1.0);
}
