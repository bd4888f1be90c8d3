#include "deep34.glsl"
