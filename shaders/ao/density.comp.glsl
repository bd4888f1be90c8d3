// Technique "volume", volumes of densities, path = compute: an invocation is a pixel.
#include "ao/volume_density.glsl"
#include "ao/volume_layers.glsl"
#include "ao/volume_main.glsl"
