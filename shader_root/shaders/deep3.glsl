#include "deep4.glsl"
