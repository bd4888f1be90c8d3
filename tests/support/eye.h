/** eye.h - what a camera sees of made-up geometry: distances and normals for the measures that take a nook_seen. */
#pragma once
#include "modules/measure/instability.h"

enum { NOOK_EYE_SIDE = 32, NOOK_EYE_PIXELS = NOOK_EYE_SIDE * NOOK_EYE_SIDE };

extern const double nook_eye_fov;        /**< A right angle, in radians: of both axes, as the picture is square. */
extern const double nook_eye_towards[3]; /**< The normal of a wall that faces the camera. */

/** A picture of one camera, with the arrays that a nook_seen borrows. What is measured of it is the test's own to fill. */
typedef struct nook_eye {
    float distances[NOOK_EYE_PIXELS], normals[3 * NOOK_EYE_PIXELS], visibility[NOOK_EYE_PIXELS];
    uint8_t marks[NOOK_EYE_PIXELS];
    nook_seen seen;
} nook_eye;

/** Puts a surface into a pixel. */
void nook_eye_show(nook_eye *eye, int x, int y, double distance, const double normal[3]);

/** From (x, y, z), looking along -Z: a wall at that distance, which faces the camera, fills the picture. */
void nook_eye_face_wall(nook_eye *eye, double x, double y, double z, double distance);
