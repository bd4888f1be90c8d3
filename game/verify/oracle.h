/**
 * oracle.h - the same integrals by casting rays in double against the triangles themselves: slow, and independent of every technique.
 */
#pragma once
#include "engine/core/result.h"
#include "game/verify/scene.h"

/** A point of a surface. */
typedef struct nook_verify_receiver {
    double point[3], normal[3]; /**< World. */
} nook_verify_receiver;

/** That of the fixtures. */
extern const nook_verify_receiver nook_verify_origin;

/** What one camera's picture can tell of a scene's A. */
typedef struct nook_verify_sight {
    double missing; /**< The part of A from what is outside of the picture or behind something. */
    /**
     * The part of A that hinges on which point of a pixel the depth buffer holds: it holds one, so that all rays that hit in one pixel
     * get one distance and one rho, for what may be any between the least and the most. 0 where rho is the same all over each pixel.
     */
    double unresolved;
} nook_verify_sight;

/** Whether a point of a surface is in the picture and nothing is before it. */
bool nook_verify_sees(const nook_verify_scene *scene, const nook_verify_camera *camera, const double point[3]);

/** Occlusion of a receiver by rays, over one of the two measures. @param rays  of a (0,2)-sequence */
double nook_verify_cast_occlusion(const nook_verify_scene *scene, nook_form_weight weight,
                                  const nook_verify_receiver *receiver, uint32_t rays);

/** What the picture lacks of A at the origin: by geometry and falloff alone. @return NOOK_E_MEMORY */
nook_result nook_verify_look_through(const nook_verify_scene *scene, nook_form_weight weight,
                                     const nook_verify_camera *camera, uint32_t rays, nook_verify_sight *out_sight);

/** What the middle of a pixel shows. */
nook_verify_receiver nook_verify_receiver_of(const nook_verify_scene *scene, const nook_verify_camera *camera,
                                             uint32_t x, uint32_t y);

/**
 * What ssao says it computes: the mean of rho at what hides a point from the camera, over points of the half ball of radius r_max
 * above the receiver; nothing hides a point outside of the picture.
 * @param bias  a part of r_max, by which a point must be behind what hides it
 */
double nook_verify_cast_half_ball(const nook_verify_scene *scene, const nook_verify_camera *camera,
                                  const nook_verify_receiver *receiver, double bias, uint32_t points);
