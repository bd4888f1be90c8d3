#include "deep38.glsl"
