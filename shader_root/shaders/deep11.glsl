#include "deep12.glsl"
