/**
 * bounds.h - how much of what a point sees a body can take at the most: closed forms, derived in docs/plan.md.
 *
 * Ambient visibility weighs directions by cosine / pi. All bounds hold for every normal at the point, for every falloff (rho is 1 at the
 * most) and whatever else there is. Lengths in metres.
 */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A box along the axes of the world. */
typedef struct nook_plan_box {
    double min[3], max[3]; /**< Metres; min <= max. */
} nook_plan_box;

/** Between the nearest points of two boxes; 0 where they touch. */
double nook_plan_box_gap(const nook_plan_box *a, const nook_plan_box *b);
/** From a point to the nearest point of a box; 0 inside. */
double nook_plan_point_gap(const nook_plan_box *box, const double point[3]);
/** The box with `by` more on all sides, by >= 0. */
nook_plan_box nook_plan_box_grow(const nook_plan_box *box, double by);

/** Sine of the half angle of the cone that holds a sphere, at `gap` above its surface; 1 for a gap of 0 or less. */
double nook_plan_sphere_sine(double radius, double gap);
/** A body within a sphere: sine^2, the cosine-weighted measure of its cone around the normal. */
double nook_plan_sphere_bound(double radius, double gap);
/** A body within a box whose nearest point is `gap` away: its three seen faces over pi gap^2; 1 at the most. */
double nook_plan_face_bound(const nook_plan_box *box, double gap);

/**
 * The largest share of a pixel's rays that any cone of this half angle can hold, whichever way it points: a cone that holds a ray lies
 * within the cone of twice the angle around that ray, so it holds no more rays than that one.
 * @param directions  unit, xyz and one number more, `blocks` times `rays` of them, as nook_fill_directions makes; a pixel has one block
 * @param sine        of the half angle, [0, 1]
 */
double nook_plan_ray_share(const float *directions, uint32_t blocks, uint32_t rays, double sine);

#ifdef __cplusplus
}
#endif
