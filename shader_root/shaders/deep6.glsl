#include "deep7.glsl"
