
#version 430 core
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Output { uint values[]; };
void main() { values[0] = __VERSION__; }
