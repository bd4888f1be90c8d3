#include "deep33.glsl"
