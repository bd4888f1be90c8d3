#include "deep29.glsl"
