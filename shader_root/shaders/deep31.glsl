#include "deep32.glsl"
