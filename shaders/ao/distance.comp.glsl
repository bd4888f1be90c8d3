// Technique "volume", volumes of distances, path = compute: an invocation is a pixel.
#include "ao/volume_distance.glsl"
#include "ao/volume_nearest.glsl"
#include "ao/volume_main.glsl"
