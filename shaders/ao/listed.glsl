#pragma once
// Whose points a program traces: those of the trace's pixels, or with LISTED defined those of a list (refine.glsl), or with EITHER defined
// now these and now those: a program for each would have to be compiled, which takes a software driver a third of a second.
#include "ao/frame.glsl"
#if defined(LISTED) || defined(EITHER)
#include "ao/refine.glsl"
#endif
#if defined(EITHER)
layout(location = 2) uniform bool of_list;
#elif defined(LISTED)
const bool of_list = true;
#else
const bool of_list = false;
#endif
