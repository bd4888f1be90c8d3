#include "deep15.glsl"
