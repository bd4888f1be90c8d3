#include "deep21.glsl"
