/** fixtures.h - what makes the scenes of the rows in fixtures.def; called by nook_verify_scene_make alone. */
#pragma once
#include "game/verify/scene.h"

#define NOOK_VERIFY_FIXTURE(row, name, points, camera_points, quick_points, what) \
    void nook_verify_make_##name(uint32_t point, double extent, nook_verify_scene *scene);
#include "game/verify/fixtures.def"
#undef NOOK_VERIFY_FIXTURE
