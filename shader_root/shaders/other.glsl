#pragma once
#include "once.glsl"
uint other() { return 6u; }
