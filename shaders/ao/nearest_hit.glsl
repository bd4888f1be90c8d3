#pragma once
// What kinds of volumes share in which a ray ends where it first meets something.
// What waits for the next dispatch: union, a ray's nearest hit so far; multiply, the sum over an occluder's rays so far.
layout(binding = 1, r32f) uniform image2D kept_image;

const float NO_HIT = 1e30;
