layout(local_size_x = 8) in;
#include "nook/good.glsl"
#include "shaders/nook/bad.glsl"
void main() { }
