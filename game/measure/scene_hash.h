#pragma once
#include "engine/asset/scene.h"

/**
 * What a scene is, whatever its file is called: geometry, where it stands, materials, images, cameras and lights.
 * @return not affected by names or by the order of bytes in the file that do not change the picture
 */
uint64_t nook_scene_hash(const nook_scene *scene);
