/** internal.h - what the files of engine/physics share. Not for others. */
#pragma once
#include "engine/physics/physics.h"
#include <ode/ode.h>

typedef struct physics_tuning {
#define NOOK_TUNING(name, value) double name;
#include "engine/physics/tuning.def"
#undef NOOK_TUNING
} physics_tuning;

extern const physics_tuning nook_physics_tuning;

/* A geom, and for meshes the triangles that ODE refers to. */
typedef struct physics_shape {
    dGeomID geom;
    nook_pose body_from_shape;
    dTriMeshDataID mesh;
    float *positions;
    uint32_t *indices;
} physics_shape;

/* Whether a body takes part in a step: see contact.c. */
typedef enum physics_activity {
    PHYSICS_RESTS,  /* asleep, static, or kinematic and not moved */
    PHYSICS_MOVES,  /* since the step began */
    PHYSICS_QUEUED, /* was touched in this step by what moves: its own contacts are still to be found */
    PHYSICS_WOKEN   /* and they were */
} physics_activity;

typedef struct physics_body {
    uint32_t id;
    nook_body_motion motion;
    bool upright, ghost, aimed; /* aimed: target is where the next step brings it */
    physics_activity activity;
    double friction, restitution, mass;
    uint64_t user;
    nook_body ignored;
    dBodyID ode; /* NULL: static */
    physics_shape *shapes;
    uint32_t shape_count;
    nook_pose body_from_centre; /* of mass; never turned */
    double thickness;           /* of its thinnest shape, metres */
    nook_pose previous, current, target;
    double force[3];
    nook_pose rest;       /* where it began to rest */
    uint32_t rest_steps;  /* since then */
    uint32_t island;      /* while the step looks for who may sleep: index into bodies */
    uint64_t query_stamp; /* of the last overlap query that met it */
} physics_body;

/* A point in which two bodies touch. Those of bodies that fell asleep are kept: their load and ground are asked for. */
typedef struct physics_contact {
    uint32_t a, b;                        /* ids; a is dynamic */
    double position[3], normal[3], depth; /* the normal points out of b */
    double force[3];                      /* on a, newtons */
    dJointFeedback feedback;
} physics_contact;

struct nook_physics {
    dWorldID world;
    dSpaceID fixed, moving, ghosts; /* shapes of static bodies, of all others, of those that touch nothing */
    dJointGroupID joints;
    dGeomID ray, box;     /* of queries; in no space */
    unsigned long random; /* ODE's, between steps */
    double gravity;
    physics_body **bodies; /* in the order of their ids, which is that of their making */
    uint32_t body_count, body_capacity, last_id;
    physics_contact *contacts;
    uint32_t contact_count, contact_capacity, kept_count; /* the first kept_count are of sleeping bodies */
    physics_body **queue;                                 /* of PHYSICS_QUEUED; body_capacity */
    uint32_t queue_count;
    bool out_of_memory;
    uint64_t steps, query_stamp;
    nook_physics_statistics statistics;
};

/* ---- world.c ---- */

/* ODE keeps one random number generator and one set of mesh caches a process: whoever uses them holds this. */
void nook_physics_lock(void);
void nook_physics_unlock(void);
physics_body *nook_physics_find(const nook_physics *physics, nook_body body); /* NULL for stale handles */

/* ---- shape.c ---- */

nook_result nook_physics_check_shape(const nook_shape *shape, nook_body_motion motion);
/* Makes the geoms of a body; body->shapes is freed by nook_physics_free_shapes also when this fails. */
nook_result nook_physics_make_shapes(physics_body *body, const nook_body_desc *desc, dSpaceID space);
void nook_physics_free_shapes(physics_body *body);
/* Of its shapes in body space, centred: out_centre is where the centre of mass was. */
void nook_physics_spread_mass(const nook_body_desc *desc, dMass *out_mass, double out_centre[3]);

/* ---- body.c ---- */

bool nook_physics_sleeps(const physics_body *body);
void nook_physics_wake_body(physics_body *body);
/* Wakes what touched it when it was last looked at. */
void nook_physics_wake_around(nook_physics *physics, uint32_t id);
/* Puts geoms and the ODE body where body->current is. */
void nook_physics_place(physics_body *body);
void nook_physics_read_pose(physics_body *body);

/* ---- contact.c ---- */

/* Finds what touches, wakes what is touched, and makes ODE's joints. */
void nook_physics_collide(nook_physics *physics);
/* Reads the forces of the joints and removes them. */
void nook_physics_release_contacts(nook_physics *physics);
/* At most 32 contacts of one pair of shapes become few that hold as well. @return how many; they stand first */
uint32_t nook_physics_merge_contacts(dContactGeom *contacts, uint32_t count);

/* ---- sleep.c ---- */

/* Puts to sleep what has been at rest together. */
void nook_physics_settle(nook_physics *physics);
