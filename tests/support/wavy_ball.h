/**
 * wavy_ball.h - a closed mesh without any symmetry of the grid, half of it a mask with holes.
 */
#pragma once
#include "modules/bake/voxelize.h"

enum {
    WAVY_RINGS = 40,
    WAVY_SIDES = 80,
    WAVY_POINTS = (WAVY_RINGS + 1) * (WAVY_SIDES + 1),
    WAVY_INDICES = 6 * WAVY_RINGS * WAVY_SIDES
};

/** Semiaxes of 0.8, 0.7 and 1 m when it has no waves. */
typedef struct test_wavy_ball {
    float points[WAVY_POINTS][3], uvs[WAVY_POINTS][2];
    uint32_t indices[WAVY_INDICES];
    uint8_t texels[16];
    nook_alpha_part part; /**< The last half of the triangles. */
    nook_alphas alphas;
} test_wavy_ball;

/** @param waves  a part of the radius @return release with free() */
test_wavy_ball *test_make_wavy_ball(float waves);
nook_triangles test_wavy_ball_triangles(const test_wavy_ball *ball); /**< Borrows it. */
