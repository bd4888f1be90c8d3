#include "deep24.glsl"
