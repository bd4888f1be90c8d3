

#include "a.glsl"
