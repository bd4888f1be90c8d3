#include "deep9.glsl"
