// For test_box_weight.c: shaders/ao/box_weight.glsl of a list of boxes, seen from the origin of the plane z = 0.
#include "ao/box_weight.glsl"
layout(local_size_x = 64) in;
struct Box {
    vec4 low, high; // in units of the axes
    vec4 axes[3];
};
layout(std430, binding = 0) readonly buffer Boxes {
    Box boxes[];
};
layout(std430, binding = 1) writeonly buffer Weights {
    float weights[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(boxes.length()))
        weights[i] = box_weight(boxes[i].low.xyz, boxes[i].high.xyz, mat3(boxes[i].axes[0].xyz, boxes[i].axes[1].xyz, boxes[i].axes[2].xyz));
}
