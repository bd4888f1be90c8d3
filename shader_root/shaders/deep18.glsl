#include "deep19.glsl"
