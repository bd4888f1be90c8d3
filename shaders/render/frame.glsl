// What every pass knows about the frame. Relative space: world axes, origin at the camera.
#pragma once
layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_view;
    mat4 world_from_view;      // rotation only: view to relative space
    mat4 shadow_from_relative; // to [0, 1]^3 of the shadow map
    vec2 ray_scale;            // view ray = (ndc * ray_scale, -1)
    float z_near;
    float shadow_texel;        // metres
    float depth_near;          // metres, for the depth view
    float depth_far;
    vec2 size;                 // pixels
} frame;

// Relative direction through a pixel, 1 long along the view axis.
vec3 relative_ray(vec2 pixel)
{
    vec2 ndc = pixel / frame.size * 2.0 - 1.0;
    return mat3(frame.world_from_view) * vec3(ndc * frame.ray_scale, -1.0);
}

// Metres along the view axis from reversed-Z depth; depth > 0.
float view_distance(float depth)
{
    return frame.z_near / depth;
}
