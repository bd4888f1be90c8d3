#include "deep3.glsl"
