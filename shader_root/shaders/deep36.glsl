#include "deep37.glsl"
