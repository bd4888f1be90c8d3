#include "tests/support/eye.h"

const double nook_eye_fov = 1.57079632679489661923;
const double nook_eye_towards[3] = { 0.0, 0.0, 1.0 };

void nook_eye_show(nook_eye *eye, int x, int y, double distance, const double normal[3])
{
    int i = y * NOOK_EYE_SIDE + x;
    eye->distances[i] = (float)distance;
    for (int k = 0; k < 3; k++)
        eye->normals[3 * i + k] = (float)normal[k];
}

void nook_eye_face_wall(nook_eye *eye, double x, double y, double z, double distance)
{
    for (int i = 0; i < NOOK_EYE_PIXELS; i++)
        nook_eye_show(eye, i % NOOK_EYE_SIDE, i / NOOK_EYE_SIDE, distance, nook_eye_towards);
    eye->seen = (nook_seen){ .view_from_world = nook_matrix_translation(-x, -y, -z),
                             .fov_y_radians = nook_eye_fov,
                             .width = NOOK_EYE_SIDE,
                             .height = NOOK_EYE_SIDE,
                             .distances = eye->distances,
                             .normals = eye->normals };
}
