#include "deep16.glsl"
