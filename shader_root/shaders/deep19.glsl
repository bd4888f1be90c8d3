#include "deep20.glsl"
