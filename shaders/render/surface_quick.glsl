// Both normals of a quick frame, of any length: who reads one divides by it. The triangle's is that of the positions of neighbouring
// pixels, right to about 1e-4. As few varyings and uniforms as can be: the first cost at every vertex, the second llvmpipe fetches for
// every pixel on its own.
#pragma once

// Moves a normal by its image. side: -1 where its back is seen; turn: -1 where the positions run the other way. Tangents from screen
// derivatives, as tangent_frame() of surface.glsl has them for meshes that bring none.
vec3 mapped_normal(vec3 normal, float side, float turn, vec3 position_x, vec3 position_y)
{
    vec3 bump = texture(normal_image, surface_uv).xyz * 2.0 - 1.0;
    bump.xy *= drawn.normal_scale;
    vec2 uv_x = dFdx(surface_uv), uv_y = dFdy(surface_uv);
    vec3 across_y = cross(position_y, normal), across_x = cross(normal, position_x);
    vec3 along_u = across_y * uv_x.x + across_x * uv_y.x;
    vec3 along_v = across_y * uv_x.y + across_x * uv_y.y;
    float area = max(dot(along_u, along_u), dot(along_v, along_v));
    float scale = area > 0.0 ? turn * sqrt(dot(normal, normal) / area) : 0.0; // the longer one becomes as long as the normal
    return normal * (side * bump.z) + (along_u * bump.x - along_v * bump.y) * scale;
}

void surface_normals(out vec3 shading, out vec3 geometric)
{
    vec3 position_x = dFdx(surface_position_relative), position_y = dFdy(surface_position_relative);
    vec3 plane = cross(position_x, position_y);
    float turn = dot(plane, surface_position_relative) > 0.0 ? -1.0 : 1.0; // -1: of planes seen from their edge, nearly
    geometric = plane * turn;
    vec3 normal = dot(surface_normal_world, surface_normal_world) > 0.0 ? surface_normal_world : geometric;
    float side = dot(normal, geometric) < 0.0 ? -1.0 : 1.0;
    shading = has_image(MATERIAL_NORMAL_IMAGE) ? mapped_normal(normal, side, turn, position_x, position_y) : normal * side;
}
