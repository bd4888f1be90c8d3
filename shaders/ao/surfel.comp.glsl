// Technique "volume", surfel volumes, path = compute: an invocation is a pixel.
#include "ao/volume_surfel.glsl"
#include "ao/volume_layers.glsl"
#include "ao/volume_main.glsl"
