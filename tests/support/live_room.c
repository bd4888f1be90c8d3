#include "tests/support/live_room.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

int live_room_open_scene(void **state, const char *path)
{
    live_room *room = calloc(1, sizeof *room);
    const char *root = getenv("NOOK_ROOT");
    char scene[4096], label[64];
    *state = room;
    if (!room)
        return -1;
    snprintf(scene, sizeof scene, "%s/%s", root ? root : ".", path);
    const nook_stage_desc desc = { .root = root ? root : ".",
                                   .scene_path = scene,
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = LIVE_ROOM_WIDTH,
                                   .height = LIVE_ROOM_HEIGHT };
    const nook_game_world_desc world = { 32, 0.5, NULL };
    return nook_stage_open(&desc, &room->stage) != NOOK_OK || nook_stage_fill(&room->stage, &world) != NOOK_OK ||
           nook_ao_set_param(room->stage.ao, "ao.r_max", 0.5) != NOOK_OK ||
           nook_camera_choose(room->stage.scene, NULL, (double)LIVE_ROOM_WIDTH / LIVE_ROOM_HEIGHT, &room->camera, label,
                              sizeof label) != NOOK_OK;
}

int live_room_open(void **state)
{
    return live_room_open_scene(state, "tests/game/data/crate.gltf");
}

int live_room_close(void **state)
{
    live_room *room = *state;
    bool wrong = nook_gpu_check(room->stage.gpu, "the live views");
    nook_stage_close(&room->stage);
    free(room);
    return wrong;
}

int live_room_set_up(void **state)
{
    live_room *room = *state;
    const nook_live_desc desc = {
        .stage = &room->stage,
        .settings_path = nook_scratch_path(room->settings, sizeof room->settings, "live.settings"),
        .pictures = nook_scratch_path(room->pictures, sizeof room->pictures, "pictures"),
        .notes = "level of the test",
    };
    remove(room->settings);
    memset(&room->input, 0, sizeof room->input);
    room->input.width = LIVE_ROOM_WIDTH, room->input.height = LIVE_ROOM_HEIGHT, room->input.content_scale = 1.0;
    room->input.mouse_x = 0.5 * LIVE_ROOM_WIDTH, room->input.mouse_y = 0.9 * LIVE_ROOM_HEIGHT;
    if (nook_live_create(&desc, &room->live) != NOOK_OK)
        return -1;
    live_room_set(room, 0, "volume rays=1 ao.scale=quarter"); /* quick, unless a test asks for more */
    return 0;
}

int live_room_tear_down(void **state)
{
    live_room *room = *state;
    nook_live_destroy(room->live);
    room->live = NULL;
    return nook_gpu_check(room->stage.gpu, "the live views");
}

void live_room_set(live_room *room, uint32_t view, const char *text)
{
    nook_live_view *v = &nook_live_state(room->live)->views[view];
    memset(v->setting, 0, sizeof v->setting);
    snprintf(v->setting, sizeof v->setting, "%s", text);
}

void live_room_step(live_room *room)
{
    nook_live_input(room->live, &room->input, true, &room->rest);
    assert_int_equal(nook_live_draw(room->live, &room->camera), NOOK_OK);
    memset(room->input.pressed, 0, sizeof room->input.pressed);
    memset(room->input.mouse_pressed, 0, sizeof room->input.mouse_pressed);
    room->input.mouse_dx = room->input.mouse_dy = 0.0;
}

void live_room_press(live_room *room, nook_key key)
{
    room->input.pressed[key] = true;
    live_room_step(room);
}

void live_room_picture(live_room *room)
{
    assert_int_equal(nook_live_picture(room->live, LIVE_ROOM_WIDTH, LIVE_ROOM_HEIGHT, room->picture), NOOK_OK);
}
