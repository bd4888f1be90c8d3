#include "deep26.glsl"
