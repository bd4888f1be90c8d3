/**
 * physics.h - rigid bodies on Open Dynamics Engine (ODE): fixed steps, contacts, sleeping, and what a game asks of them.
 *
 *   create -> add bodies -> every tick: set what moves by hand, step, read poses -> destroy
 *
 * Space        metres, kilograms, seconds, newtons; right-handed, Y up. Quaternions are (x, y, z, w), unit.
 * Time         one step is always NOOK_PHYSICS_STEP seconds: frames are interpolated between the last two, never stepped.
 * Determinism  the same calls in the same order with the same seed give the same poses bit for bit, also in another process
 *              of the same build; several worlds of one process do not disturb each other (ODE's one random number
 *              generator is set before each step and kept in the world).
 * Threads      one world is used by one thread at a time. Contacts are found and solved on that thread; worlds of several
 *              threads take turns, as ODE shares caches between them.
 */
#pragma once
#include "engine/core/result.h"
#include "engine/physics/pose.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_PHYSICS_STEP (1.0 / 60.0) /**< Seconds. */

typedef struct nook_physics nook_physics;

/** A handle: id 0 is none; a removed body's id never comes back. */
typedef struct nook_body {
    uint32_t id;
} nook_body;

typedef enum nook_shape_kind {
    NOOK_SHAPE_BOX,      /**< half: half sides. */
    NOOK_SHAPE_SPHERE,   /**< half[0]: radius. */
    NOOK_SHAPE_CYLINDER, /**< half[0]: radius, half[1]: half its height, along the shape's Y. */
    NOOK_SHAPE_CAPSULE,  /**< half[0]: radius, half[1]: half the height of its straight part, along the shape's Y. */
    NOOK_SHAPE_MESH      /**< Triangles; only of bodies that are not dynamic. */
} nook_shape_kind;

typedef struct nook_shape {
    nook_shape_kind kind;
    double half[3]; /**< Metres, > 0; what they are: nook_shape_kind. */
    nook_pose body_from_shape;
    const float *positions;  /**< NOOK_SHAPE_MESH: xyz, metres, shape space, finite; copied. */
    const uint32_t *indices; /**< NOOK_SHAPE_MESH: of triangles. */
    uint32_t vertex_count, index_count;
} nook_shape;

typedef enum nook_body_motion {
    NOOK_BODY_STATIC,    /**< Never moves. */
    NOOK_BODY_KINEMATIC, /**< Moved by nook_physics_move; pushes others, is pushed by none. */
    NOOK_BODY_DYNAMIC    /**< Falls, collides, sleeps. */
} nook_body_motion;

typedef struct nook_body_desc {
    nook_body_motion motion;
    const nook_shape *shapes; /**< At least one; copied. Their common centre of mass need not be the body's origin. */
    uint32_t shape_count;
    double mass; /**< Kilograms, > 0; dynamic bodies only. Spread over the shapes by volume. */
    nook_pose pose;
    double friction;    /**< Coulomb coefficient, >= 0; of two bodies the product's root counts. */
    double restitution; /**< [0, 1]; of two bodies the larger counts. */
    bool upright;       /**< Never turns: characters. */
    bool ghost;         /**< Touches nothing, but is found by rays: marks, sensors. Not dynamic. */
    uint64_t user;      /**< Yours: nook_physics_user gives it back. */
} nook_body_desc;

typedef struct nook_physics_desc {
    double gravity; /**< Metres per second squared, downwards; 0: 9.81. */
    uint32_t seed;
} nook_physics_desc;

/** @return NOOK_E_MEMORY; *out_physics is NULL then */
nook_result nook_physics_create(const nook_physics_desc *desc, nook_physics **out_physics);
void nook_physics_destroy(nook_physics *physics); /**< NULL is allowed. */

/**
 * Whether a triangle has an area to push with. Those of a mesh that have none are left out, and a mesh of such alone is refused.
 * @param positions, triangle  as of nook_shape
 */
bool nook_physics_has_area(const float *positions, const uint32_t triangle[3]);

/** @return NOOK_E_ARG a shape, mass or pose that is none (the line says which); NOOK_E_MEMORY; *out_body untouched then */
nook_result nook_physics_add(nook_physics *physics, const nook_body_desc *desc, nook_body *out_body);
/** Stale handles are allowed. What rested on it wakes. */
void nook_physics_remove(nook_physics *physics, nook_body body);
/** All bodies in the order they were added. @param out `capacity` of them, or NULL @return how many there are */
uint32_t nook_physics_bodies(const nook_physics *physics, nook_body *out, uint32_t capacity);
bool nook_physics_alive(const nook_physics *physics, nook_body body);
uint64_t nook_physics_user(const nook_physics *physics, nook_body body); /**< 0 for stale handles. */

/** Moves everything on by NOOK_PHYSICS_STEP. @return NOOK_E_RANGE a pose is not finite any more: an error of ours */
nook_result nook_physics_step(nook_physics *physics);
uint64_t nook_physics_steps(const nook_physics *physics); /**< Steps done. */

/** Between the last two steps. @param alpha [0, 1]; 1: as the last step left it */
nook_pose nook_physics_pose(const nook_physics *physics, nook_body body, double alpha);
/** Puts a body somewhere, at rest; nothing is swept on the way. */
void nook_physics_set_pose(nook_physics *physics, nook_body body, const nook_pose *pose);
/** Kinematic bodies: where the next step shall bring it; bodies in its way are pushed with that speed. */
void nook_physics_move(nook_physics *physics, nook_body body, const nook_pose *target);

/** Metres per second at the centre of mass, radians per second. */
void nook_physics_velocity(const nook_physics *physics, nook_body body, double out_linear[3], double out_angular[3]);
void nook_physics_set_velocity(nook_physics *physics, nook_body body, const double linear[3], const double angular[3]);
/** Newtons at the centre of mass, for the next step only; wakes it. */
void nook_physics_push(nook_physics *physics, nook_body body, const double force[3]);
/** Bodies between which there are no contacts; {0} takes it back. For what is carried and who carries it. */
void nook_physics_ignore(nook_physics *physics, nook_body a, nook_body b);
double nook_physics_mass(const nook_physics *physics, nook_body body); /**< 0 for what is not dynamic. */
bool nook_physics_asleep(const nook_physics *physics, nook_body body);
void nook_physics_wake(nook_physics *physics, nook_body body);
/**
 * Puts a body to sleep exactly where it is, at rest, until something that moves touches it. For what a file says lies still.
 * What carries it feels it after the next step.
 */
void nook_physics_sleep(nook_physics *physics, nook_body body);

/** Newtons with which others pressed this body down in the last step: 9.81 a kilogram that rests on it. */
double nook_physics_load(const nook_physics *physics, nook_body body);
/** The same, told apart by who presses: calls `found` once for each contact, several times for one body. */
void nook_physics_each_load(const nook_physics *physics, nook_body body,
                            void (*found)(void *user, nook_body other, double newtons), void *user);
/** The least steep of what it stood on in the last step. @param out_normal up from there @return false: it hung in the air */
bool nook_physics_ground(const nook_physics *physics, nook_body body, double out_normal[3]);

typedef struct nook_ray_hit {
    nook_body body;
    double distance;  /**< Metres. */
    double normal[3]; /**< Of the surface, on the side from which the ray comes. */
} nook_ray_hit;
/**
 * The nearest body along a ray. A body in which it begins is met from within (a capsule not surely). Allocates nothing.
 * @param direction unit @param ignored up to two bodies that are looked through; {0} for none
 * @return false: nothing within `length`
 */
bool nook_physics_ray(nook_physics *physics, const double origin[3], const double direction[3], double length,
                      const nook_body ignored[2], nook_ray_hit *out_hit);

/** Calls `found` once for each body whose shapes touch an upright box; `found` must not ask for overlaps, add or remove. */
void nook_physics_overlap(nook_physics *physics, const double box_min[3], const double box_max[3],
                          void (*found)(void *user, nook_body body), void *user);

/** XXH3 of every body's pose, velocity and sleep, in the order they were added: equal states have equal hashes. */
uint64_t nook_physics_hash(const nook_physics *physics);

typedef struct nook_physics_statistics {
    uint32_t bodies, dynamic, awake; /**< Now. */
    uint32_t contacts;               /**< Of the last step, sleepers' not counted. */
    double step_ms;                  /**< Wall time of the last step. */
} nook_physics_statistics;
void nook_physics_get_statistics(const nook_physics *physics, nook_physics_statistics *out_statistics);

#ifdef __cplusplus
}
#endif
