
#include "nook/nothing.glsl"
