#include "deep8.glsl"
