#include "deep39.glsl"
