#include "deep14.glsl"
