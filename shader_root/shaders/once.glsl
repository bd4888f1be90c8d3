#pragma once
#include "other.glsl"
uint once() { return 5u; }
