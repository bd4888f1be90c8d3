#include "deep1.glsl"
