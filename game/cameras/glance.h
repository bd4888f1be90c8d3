/**
 * glance.h - what a view shows, as far as a few rays tell: enough, from far enough, and from the right side?
 */
#pragma once
#include "engine/render/renderer.h"
#include "game/cameras/rays.h"

/** What a coarse picture of a view shows. */
typedef struct nook_glance {
    double geometry; /**< Part of the picture that shows something. */
    double near;     /**< Part of that which is nearer than the distance asked about. */
    double backs;    /**< Part of that which shows its back: what a room shows to those outside. */
    double median;   /**< Metres along the view; 0 when there is nothing. */
    double
        spread; /**< Distance that 9 of 10 rays are within, over the one that 1 of 10 is within; 1: a wall, head on. */
} nook_glance;

/** @param aspect  width / height of the picture @param near  metres */
nook_glance nook_glance_at(const nook_rays *rays, const nook_camera *camera, double aspect, double near);
