// Technique "volume", volumes of densities, path = raster: a fragment is a pixel in an occluder's box.
#define DRAWN
#include "ao/volume_density.glsl"
#include "ao/volume_box.glsl"
