#pragma once
#include "engine/ecs/system.h"
#include "engine/ecs/transform.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * This entity turns about a point at a constant rate. Stands beside a nook_transform, which is made from it anew every frame:
 * rounding never adds up in a matrix, whatever scale or shear the body started with (engine/core/rotation.h).
 */
typedef struct nook_spin {
    double world_from_start[16]; /**< The transform where `rotation` is the identity; affine, metres. */
    double pivot[3];             /**< The point in the world that stays where it is, metres. */
    double angular_velocity[3];  /**< World axes, right-handed, radians per second. */
    double rotation[4];          /**< Unit quaternion (x, y, z, w): how far it has turned. Start with 0, 0, 0, 1. */
} nook_spin;

/** How much time a frame takes. A world resource. */
typedef struct nook_time_step {
    double seconds;
} nook_time_step;

/** Turns every nook_spin by one nook_time_step and writes the nook_transform; in the update phase. */
extern const nook_system nook_advance_spins;

#ifdef __cplusplus
}
#endif
