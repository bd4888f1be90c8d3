#pragma once
// A ray that layers stop a part of: what it has met. docs/surfel_bricks.md, docs/volume_kinds.md.
#include "ao/falloff.glsl"
// What waits for the next dispatch: union, what a ray has met so far; multiply, in x the sum over an occluder's rays so far.
layout(binding = 1, rgba32f) uniform image2D kept_image;

const float OPAQUE = 0.02; // transmittance below which a ray ends, and its last hit takes what is left

// Occlusion so far, what still gets through, and where nothing does any more (metres).
struct Passage {
    float occlusion, transmittance, end;
    float last, covered; // the last layer that was met: where (voxels), and its alpha
};

Passage free_passage()
{
    return Passage(0.0, 1.0, 1e30, -1e30, 0.0);
}

// A layer takes its share at h voxels. `again`: it is the last one, met again, and counts once, with the larger alpha.
void pass_through(float h, float metre, float alpha, bool again, inout Passage passage)
{
    float covered = again ? passage.covered : 0.0;
    float through = (1.0 - max(alpha, covered)) / (1.0 - covered);
    passage.covered = max(alpha, covered);
    float left = passage.transmittance * through, taken = passage.transmittance - left;
    if (left < OPAQUE) {
        taken = passage.transmittance;
        left = 0.0;
        passage.end = h / metre;
    }
    passage.occlusion += taken * falloff(h / metre);
    passage.transmittance = left;
}

float least(vec3 v)
{
    return min(v.x, min(v.y, v.z));
}
