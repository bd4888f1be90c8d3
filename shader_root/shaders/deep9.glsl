#include "deep10.glsl"
