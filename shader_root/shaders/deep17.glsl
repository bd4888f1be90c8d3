#include "deep18.glsl"
