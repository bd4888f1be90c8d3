/** pose_view.h - a scene whose clips play, over a level floor, drawn small: what the floor sees of the sky. */
#pragma once
#include "engine/asset/scene_join.h"
#include "game/stage.h"

enum { POSE_VIEW_SIDE = 64 };

typedef struct pose_view {
    nook_stage stage;
    nook_camera camera;
    double floor_y; /**< World. */
    float depth[POSE_VIEW_SIDE * POSE_VIEW_SIDE], visibility[POSE_VIEW_SIDE * POSE_VIEW_SIDE];
} pose_view;

/**
 * @param actor   destroyed
 * @param floor   two corners, x and z; level at floor_y
 * @param eye, target  of the camera, which looks through a lens of 0.8 radians
 * @return 0, or not: the stage is closed by pose_view_close in any case
 */
int pose_view_open(pose_view *view, nook_scene *actor, const double floor[2][2], double floor_y, const double eye[3],
                   const double target[3], double r_max);
void pose_view_close(pose_view *view);
/** Lets so many seconds pass, draws, fills depth and visibility. */
void pose_view_record(pose_view *view, const char *technique, double advance);
/** Where the floor is seen at a pixel. @return false: something else is */
bool pose_view_floor_at(const pose_view *view, int pixel, double out_point[3]);
