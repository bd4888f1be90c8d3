#include "deep23.glsl"
