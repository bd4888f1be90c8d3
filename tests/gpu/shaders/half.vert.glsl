layout(location = 0) uniform float depth_device;

// Two triangles over x in [-1, 0], y in [-1, 1].
void main()
{
    const vec2 corners[6] = vec2[6](vec2(-1, -1), vec2(0, -1), vec2(0, 1), vec2(-1, -1), vec2(0, 1), vec2(-1, 1));
    gl_Position = vec4(corners[gl_VertexID], depth_device, 1.0);
}
