/**
 * oracle.h - the same integrals by casting rays in double against the triangles themselves: slow, and independent of every technique.
 */
#pragma once
#include "game/verify/scene.h"

/** Whether a point of a surface is in the picture and nothing is before it. */
bool nook_verify_sees(const nook_verify_scene *scene, const nook_verify_camera *camera, const double point[3]);

/**
 * Occlusion of the receiver by rays, over one of the two measures.
 * @param camera  NULL: by all there is; else by what the camera sees: hits that are in its picture with nothing before them
 * @param rays    of a (0,2)-sequence
 */
double nook_verify_cast_occlusion(const nook_verify_scene *scene, nook_form_weight weight,
                                  const nook_verify_camera *camera, uint32_t rays);

/**
 * What ssao says it computes: the mean of rho at what hides a point from the camera, over points of the half ball of radius r_max
 * above the receiver; nothing hides a point outside of the picture.
 * @param bias  a part of r_max, by which a point must be behind what hides it
 */
double nook_verify_cast_half_ball(const nook_verify_scene *scene, const nook_verify_camera *camera, double bias,
                                  uint32_t points);
