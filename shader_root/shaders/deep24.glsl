#include "deep25.glsl"
