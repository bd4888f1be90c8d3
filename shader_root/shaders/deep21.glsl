#include "deep22.glsl"
