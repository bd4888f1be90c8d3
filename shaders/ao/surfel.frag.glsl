// Technique "volume", surfel volumes, path = raster: a fragment is a pixel in an occluder's box.
#define DRAWN
#include "ao/volume_surfel.glsl"
#include "ao/volume_box.glsl"
