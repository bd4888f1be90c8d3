#include "deep31.glsl"
