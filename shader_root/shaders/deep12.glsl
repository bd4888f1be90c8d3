#include "deep13.glsl"
