#include "deep28.glsl"
