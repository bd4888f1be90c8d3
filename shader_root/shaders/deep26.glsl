#include "deep27.glsl"
