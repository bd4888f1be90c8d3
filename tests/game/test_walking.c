/* A character that walks on a floor: the contact shadows of its feet go where its feet go. */
#include "tests/support/pose_view.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PHASES = 6, PIXELS = POSE_VIEW_SIDE * POSE_VIEW_SIDE }; /* of a step with each foot */

static const double r_max = 0.3;

static int set_up(void **state)
{
    static pose_view view;
    const double floor[2][2] = { { -0.8, -0.8 }, { 0.8, 0.8 } };
    const double eye[3] = { 1.1, 1.0, 1.1 }, target[3] = { 0.0, 0.1, 0.0 };
    const char *shared = getenv("NOOK_SHARED");
    char path[1024];
    nook_scene *character;
    *state = NULL;
    if (!shared)
        return 0;
    snprintf(path, sizeof path, "%s/scenes/characters/CesiumMan.glb", shared);
    *state = &view;
    return nook_scene_load(path, NULL, &character) != NOOK_OK ||
           pose_view_open(&view, character, floor, 0.0, eye, target, r_max) != 0;
}

static int tear_down(void **state)
{
    if (*state)
        pose_view_close(*state);
    return 0;
}

/* Over the pixels that show the floor in both. */
static double root_mean_square(const float *a, const float *b, const bool *on_a, const bool *on_b)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        double difference = (double)a[i] - (double)b[i];
        sum += on_a[i] && on_b[i] ? difference * difference : 0.0;
        count += on_a[i] && on_b[i];
    }
    assert_true(count > 500);
    return sqrt(sum / count);
}

static void keep(const pose_view *view, float *visibility, bool *floor)
{
    double p[3];
    memcpy(visibility, view->visibility, sizeof view->visibility);
    for (int i = 0; i < PIXELS; i++)
        floor[i] = pose_view_floor_at(view, i, p) && hypot(p[0], p[2]) < 0.6;
}

static void test_the_contact_shadows_of_a_walking_character_follow_its_feet(void **state)
{
    pose_view *view = *state;
    static float truth[PHASES][PIXELS], volume[PHASES][PIXELS];
    static bool floor[PHASES][PIXELS];
    if (!view) {
        print_message("NOOK_SHARED names no folder with characters\n");
        skip();
        return; /* what skip() does is unknown to who only reads */
    }
    double step = view->stage.scene->clips[0].duration / PHASES;
    nook_game_world_set_traced(view->stage.world, true);
    for (int i = 0; i < PHASES; i++) {
        pose_view_record(view, "reference", i > 0 ? step : 0.0);
        keep(view, truth[i], floor[i]);
        pose_view_record(view, "volume", 0.0);
        keep(view, volume[i], floor[i]);
    }
    for (int i = 0; i < PHASES; i++) {
        int other = (i + PHASES / 2) % PHASES; /* the other foot is in front */
        double own = root_mean_square(volume[i], truth[i], floor[i], floor[i]);
        double others = root_mean_square(volume[i], truth[other], floor[i], floor[other]);
        print_message("phase %d: RMSE of the floor %.3f, against the truth half a walk later %.3f\n", i, own, others);
        assert_true(own < 0.04);
        assert_true(own < 0.5 * others);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_the_contact_shadows_of_a_walking_character_follow_its_feet, set_up,
                                        tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
