#include "deep17.glsl"
