layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f, binding = 0) uniform writeonly image2D result_image;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(result_image, pixel, vec4(float(pixel.x + 1000 * pixel.y) * SCALE));
}
