#include "deep11.glsl"
