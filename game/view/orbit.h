#pragma once
#include "engine/render/renderer.h"

/** A camera that a hand moves: looks at a target from a distance. Y is up; it never rolls. */
typedef struct nook_orbit {
    double target[3]; /**< World, metres. */
    double distance;  /**< Metres, > 0. */
    double yaw;       /**< Radians; 0 looks along -Z, + turns left. */
    double pitch;     /**< Radians in (-pi/2, pi/2); + looks up. */
    double fov_y_radians, z_near;
} nook_orbit;

/**
 * The orbit that sees what a camera sees (without its roll), around the point ahead of it that is nearest to `centre`.
 * @param shortest, longest  metres between which the distance is kept
 */
nook_orbit nook_orbit_from_camera(const nook_camera *camera, const double centre[3], double shortest, double longest);
nook_camera nook_orbit_camera(const nook_orbit *orbit);

void nook_orbit_turn(nook_orbit *orbit, double yaw_radians, double pitch_radians);
/** Moves along the picture's axes. @param right, up  metres at the target */
void nook_orbit_pan(nook_orbit *orbit, double right, double up);
/** @param steps  + comes nearer, a tenth of the distance each */
void nook_orbit_zoom(nook_orbit *orbit, double steps);
/** Flies: moves eye and target together. @param forward, right, up  metres, up along Y */
void nook_orbit_fly(nook_orbit *orbit, double forward, double right, double up);
