// Technique "volume", volumes of distances, path = raster: a fragment is a pixel in an occluder's box.
#define DRAWN
#include "ao/volume_distance.glsl"
#include "ao/volume_box.glsl"
