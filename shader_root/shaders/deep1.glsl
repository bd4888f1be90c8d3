#include "deep2.glsl"
