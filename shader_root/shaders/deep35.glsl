#include "deep36.glsl"
