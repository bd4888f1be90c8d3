#include "deep5.glsl"
