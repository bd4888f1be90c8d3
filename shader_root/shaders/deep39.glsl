#include "deep40.glsl"
