/* A scalar field in the views of a single volume. */
#include "game/live/live_internal.h"
#include "tests/support/live_room.h"
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static int open_room(void **state)
{
    return live_room_open_scene(state, "content/soft_balls/soft_balls.gltf");
}

/* Which of the occluders the balls are: volumes have the same order. */
static void show(live_room *room, uint32_t mode)
{
    uint32_t count, body = 0;
    const nook_world_volume *volumes = nook_game_world_volumes(room->stage.world, &count);
    while (body < count && strcmp(volumes[body].name, "soft balls") != 0)
        body++;
    assert_true(body < count);
    nook_live_state(room->live)->body = body;
    nook_live_state(room->live)->views[0].mode = mode;
    live_room_press(room, NOOK_KEY_F1);
    live_room_press(room, NOOK_KEY_F1); /* nothing stays over the picture */
    live_room_step(room);
    nook_renderer_read(room->stage.renderer, room->picture);
}

static void test_slices_show_the_densities_of_a_field(void **state)
{
    live_room *room = *state;
    uint32_t dark = 0, between = 0, bright = 0;
    show(room, NOOK_LIVE_SLICES);
    for (const uint8_t *p = room->picture; p < room->picture + LIVE_ROOM_SIZE; p += 3) {
        bool grey = p[0] == p[1] && p[1] == p[2];
        dark += grey && p[0] < 60;
        between += grey && p[0] >= 60 && p[0] < 200;
        bright += grey && p[0] >= 200;
    }
    assert_true(dark > 1000 && between > 1000 && bright > 100); /* soft, from nothing to the middle of a ball */
}

static void test_voxels_of_a_field_stand_where_it_is_dense(void **state)
{
    live_room *room = *state;
    uint32_t left = 0, right = 0;
    show(room, NOOK_LIVE_VOXELS);
    for (uint32_t i = 0; i < LIVE_ROOM_WIDTH * LIVE_ROOM_HEIGHT; i++) {
        const uint8_t *p = room->picture + 3 * i;
        bool orange = p[0] > 2 * p[2] && p[0] > 60;
        left += orange && i % LIVE_ROOM_WIDTH < LIVE_ROOM_WIDTH / 2;
        right += orange && i % LIVE_ROOM_WIDTH >= LIVE_ROOM_WIDTH / 2;
    }
    assert_true(left > 200 && right > 100 && left > right); /* two balls, the larger one to the left */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIVE_ROOM_TEST(test_slices_show_the_densities_of_a_field),
        LIVE_ROOM_TEST(test_voxels_of_a_field_stand_where_it_is_dense),
    };
    return cmocka_run_group_tests(tests, open_room, live_room_close);
}
