#pragma once
// Technique "hao": Reinbothe, Boubekeur, Alexa 2009, section 6, errata C3, C4, C7 and C9 of docs/techniques.md. Voxel space: the first voxel of the
// grid is (0, 0, 0) to (1, 1, 1); it is turned and scaled from view space, but not sheared, so that a unit vector stays one when divided by
// its scale.
#include "ao/receiver.glsl"
#include "ao/directions.glsl"
#include "ao/slicemap.glsl"
layout(std140, binding = 1) uniform Params {
#include "modules/ao_hao/params.def"
} params;
layout(std140, binding = 2) uniform Grid { // grid_block of modules/ao_hao/hao.c
    vec4 voxel_from_view[3]; // rows
    ivec4 size;              // voxels
    vec4 tile;               // xyz: where the noise's tile has voxel (0, 0, 0); w: metres a voxel
} grid;
layout(binding = 2) uniform usampler3D along_z; // columns (x, y)

const int SLICEMAPS_ONE = 0;
const int NOISE_SPACE = 0;
const int GUARD_NONE = 0;
const float ROUNDED = 0.02;       // voxels: a rasteriser's corners lie at steps of 1/256, and ties are taken a thousandth early
const float NOISE_TILE = 256.0;   // voxels
const float TURN = 6.2831853;

// Of a voxel inside of the grid.
bool is_full(ivec3 voxel);

bool is_full_along_z(ivec3 voxel)
{
    return has_layer(fetch_texel(along_z, ivec3(voxel.xy, voxel.z / SLICEMAP_BITS)), voxel.z);
}

bool is_full_at(vec3 at)
{
    vec3 voxel = floor(at);
    if (!(all(greaterThanEqual(voxel, vec3(0.0))) && all(lessThan(voxel, vec3(grid.size.xyz)))))
        return false;
    return is_full(ivec3(voxel));
}

vec3 to_voxels(vec3 v)
{
    return vec3(dot(grid.voxel_from_view[0].xyz, v), dot(grid.voxel_from_view[1].xyz, v),
                dot(grid.voxel_from_view[2].xyz, v));
}

// Noise that hangs in the world: by cells about as large as a pixel there, and by the normal, so that the faces at an edge differ.
vec3 noise_at(vec3 at, vec3 normal, float footprint)
{
    float cells = exp2(clamp(-ceil(log2(footprint)), -8.0, 12.0)); // of a voxel's side, a power of 2
    vec3 place = at + grid.tile.xyz;
    uvec3 cell = uvec3((place - floor(place / NOISE_TILE) * NOISE_TILE) * cells);
    uvec3 facing = uvec3(round(normal * 4.0) + 4.0);
    uint h = hash(cell.x + hash(cell.y + hash(cell.z + hash(facing.x + 16u * facing.y + 256u * facing.z + hash(frame.seed)))));
    uint second = hash(h + 1u), third = hash(h + 2u);
    return vec3(uvec3(h, second, third) >> 8) * (1.0 / 16777216.0);
}

// A direction around (0, 0, 1), cosine weighted within the cone of params.spread: the set's, shifted by noise in the unit square that its
// points come from (Cranley, Patterson 1976), which keeps them even.
vec3 ray(int index, int block, vec2 shift)
{
    vec2 across = local_direction(index, params.rays, block).xy;
    float square = dot(across, across), moved = fract(square + shift.x);
    float angle = TURN * shift.y, c = cos(angle), s = sin(angle);
    across = vec2(c * across.x - s * across.y, s * across.x + c * across.y) * sqrt(moved / square);
    across *= sin(params.spread * TURN / 4.0);
    return vec3(across, sqrt(max(1.0 - dot(across, across), 0.0)));
}

struct Receiver {
    vec3 at, normal; // voxels
    float guard;     // voxels: height over its plane that no voxel of the plane reaches
    float reach;     // voxels: r_max
};

Receiver receiver_of(vec3 at, vec3 normal)
{
    vec3 extent = abs(normal);
    // A full voxel's middle is no farther from the plane than the line by which it was found is long: half along that axis.
    float found = params.slicemaps == SLICEMAPS_ONE ? extent.z : max(extent.x, max(extent.y, extent.z));
    float guard = 0.5 * (extent.x + extent.y + extent.z + found) + ROUNDED;
    return Receiver(at, normal, params.guard == GUARD_NONE ? 0.0 : guard, frame.r_max / grid.tile.w);
}

// The part of a ray, in voxels from its start, that lies in the grid, a little widened: rays are lifted by up to the guard.
vec2 inside_grid(Receiver r, vec3 d)
{
    vec3 slope = mix(d, vec3(1e-9), lessThan(abs(d), vec3(1e-9)));
    vec3 a = (vec3(-2.0) - r.at) / slope, b = (vec3(grid.size.xyz) + 2.0 - r.at) / slope;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(0.0, max(near.x, max(near.y, near.z))), min(r.reach, min(far.x, min(far.y, far.z))));
}

// rho at the first full voxel among those looked up on a ray. A test meets the layer of a surface, one voxel thick, anywhere in it where
// tests are farther apart than that, and in its front part where they are not.
float occlusion_along(Receiver r, vec3 d, float jitter)
{
    vec2 range = inside_grid(r, d);
    float apart = (range.y - range.x) / float(params.tests), rise = dot(d, r.normal);
    if (!(apart > 0.0))
        return 0.0;
    for (int i = 0; i < params.tests; i++) {
        steps++;
        float t = range.x + apart * (float(i) + jitter);
        vec3 at = r.at + d * t + r.normal * max(r.guard - rise * t, 0.0);
        if (is_full_at(at))
            return falloff((t + 0.5 * max(1.0 - apart, 0.0)) * grid.tile.w);
    }
    return 0.0;
}

// Items are rays.
float occlusion(ivec2 pixel, vec3 p, vec3 n)
{
    if (grid.size.x == 0)
        return 0.0;
    vec3 at = to_voxels(p) + vec3(grid.voxel_from_view[0].w, grid.voxel_from_view[1].w, grid.voxel_from_view[2].w);
    vec3 normal = to_voxels(n) * grid.tile.w, tangent, bitangent;
    bool of_tile = params.noise != NOISE_SPACE;
    float footprint = -p.z * pixel_footprint() * float(frame.scale) / grid.tile.w;
    vec3 shift = of_tile ? vec3(0.0, 0.0, noise(pixel, 1u)) : noise_at(at, normal, footprint);
    int block = of_tile ? block_of(pixel) : 0;
    float sum = 0.0;
    Receiver r = receiver_of(at, normal);
    if (r.guard >= r.reach)
        return 0.0; // all within r_max is the own surface's
    tangent_frame(normal, tangent, bitangent);
    for (int j = part.x; j < part.y; j++) {
        vec3 local = ray(j, block, shift.xy);
        vec3 d = tangent * local.x + bitangent * local.y + normal * local.z;
        sum += occlusion_along(r, d, fract(shift.z + float(j) * 0.61803399));
    }
    return sum / float(params.rays);
}
