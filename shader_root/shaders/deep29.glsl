#include "deep30.glsl"
