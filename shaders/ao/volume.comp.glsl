// Technique "volume", binary volumes, path = compute: an invocation is a pixel.
#include "ao/volume_binary.glsl"
#include "ao/volume_nearest.glsl"
#include "ao/volume_main.glsl"
