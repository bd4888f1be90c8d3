#include "deep35.glsl"
