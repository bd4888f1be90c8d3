#include "tests/support/wavy_ball.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

test_wavy_ball *test_make_wavy_ball(float waves)
{
    test_wavy_ball *b = calloc(1, sizeof *b);
    assert_non_null(b);
    for (uint32_t i = 0; i < WAVY_POINTS; i++) {
        float down = 3.14159265f * (float)(i / (WAVY_SIDES + 1)) / WAVY_RINGS;
        float around = 6.2831853f * (float)(i % (WAVY_SIDES + 1) % WAVY_SIDES) / WAVY_SIDES;
        float radius = 1.0f + waves * sinf(9.0f * down) * cosf(7.0f * around) * sinf(down);
        b->points[i][0] = 0.8f * radius * sinf(down) * cosf(around);
        b->points[i][1] = 0.7f * radius * sinf(down) * sinf(around);
        b->points[i][2] = radius * cosf(down);
        b->uvs[i][0] = 30.0f * (float)(i % (WAVY_SIDES + 1)) / WAVY_SIDES,
        b->uvs[i][1] = 15.0f * (float)(i / (WAVY_SIDES + 1)) / WAVY_RINGS;
    }
    for (uint32_t i = 0; i < WAVY_RINGS * WAVY_SIDES; i++) {
        uint32_t low = i / WAVY_SIDES * (WAVY_SIDES + 1) + i % WAVY_SIDES, high = low + WAVY_SIDES + 1;
        const uint32_t cell[] = { low, high, low + 1, low + 1, high, high + 1 };
        memcpy(b->indices + 6 * (size_t)i, cell, sizeof cell);
    }
    for (int i = 0; i < 16; i++)
        b->texels[i] = (i + i / 4) % 2 ? 255 : 0;
    b->part = test_mask(WAVY_INDICES / 2, WAVY_INDICES / 2, b->texels, 4);
    b->alphas = (nook_alphas){ &b->part, 1, b->uvs[0] };
    return b;
}

nook_triangles test_wavy_ball_triangles(const test_wavy_ball *b)
{
    return (nook_triangles){ b->points[0], 0, WAVY_POINTS, b->indices, WAVY_INDICES };
}
