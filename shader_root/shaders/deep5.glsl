#include "deep6.glsl"
