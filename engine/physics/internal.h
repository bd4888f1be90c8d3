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

enum { PHYSICS_FIRST_CONTACTS = 2048 }; /* room for these from the start; a level of 60 bodies has some 300 */

/* A geom, and for meshes the triangles that ODE refers to. */
typedef struct physics_shape {
    dGeomID geom;
    nook_pose body_from_shape;
    dTriMeshDataID mesh;
    float *positions;
    uint32_t *indices;
} physics_shape;

/* Whether a body takes part in a piece of a step: see contact.c. */
typedef enum physics_activity {
    PHYSICS_RESTS,  /* asleep, static, or kinematic and not moved */
    PHYSICS_QUEUED, /* moves, or was touched by what moves: its contacts are still to be found */
    PHYSICS_LOOKED  /* and they were */
} physics_activity;

typedef struct physics_body {
    uint32_t id;
    nook_body_motion motion;
    bool upright, ghost;
    bool touches; /* something, in this piece of a step */
    bool aimed;   /* target is where the next step brings it */
    bool bedded;  /* to be put to sleep where it is once a step has found what it rests on */
    physics_activity activity;
    double friction, restitution, mass;
    uint64_t user;
    nook_body ignored;
    dBodyID ode; /* NULL: static */
    physics_shape *shapes;
    uint32_t shape_count;
    nook_pose body_from_centre; /* of mass; never turned */
    double thickness;           /* of its thinnest shape, metres */
    double rim;                 /* of its widest round shape: radius, metres */
    nook_pose previous, current, target;
    double force[3];
    double drift[3], spin[3]; /* what its velocities are on average of late */
    uint32_t rest_steps;      /* that these have been those of a body at rest */
    uint32_t slow_steps;      /* that they were not far from it */
    uint32_t island;          /* while the step looks for who may sleep: index into bodies */
    uint64_t query_stamp;     /* of the last overlap query that met it */
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
    physics_body **queue; /* of all that were PHYSICS_QUEUED in this piece, in that order; body_capacity */
    uint32_t queue_count;
    const physics_body *in_hand; /* whose contacts are looked for */
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

/* Whether contacts are looked for between two bodies: one is dynamic, and they do not ignore each other. */
bool nook_physics_may_touch(const physics_body *a, const physics_body *b);
/* Finds what touches, wakes what is touched, and makes ODE's joints. */
void nook_physics_collide(nook_physics *physics);
/* Reads the forces of the joints and removes them. */
void nook_physics_release_contacts(nook_physics *physics);

/* ---- merge.c ---- */

/* The contacts of a pair of shapes become few that hold as well. @return how many; they stand first */
uint32_t nook_physics_merge_contacts(dContactGeom *contacts, uint32_t count);

/* ---- face.c: outlines from which contacts are made ---- */

enum { PHYSICS_OUTLINE_MAX = 16, PHYSICS_CLIPPED_MAX = 2 * PHYSICS_OUTLINE_MAX + 4 };

/* A geom's own axis, 0 to 2, in the world. */
void nook_physics_axis(dGeomID geom, int index, double out[3]);
/* The face, or the line, with which a box or a cylinder lies on what has this normal. @return corners; 0: it is round */
int nook_physics_face_against(dGeomID geom, const double normal[3], double outline[PHYSICS_OUTLINE_MAX][3]);
/* Keeps of a polygon or a line what lies on the inner side of an edge (Sutherland and Hodgman 1974). @return corners */
int nook_physics_clip(double points[PHYSICS_CLIPPED_MAX][3], int count, const double edge_point[3],
                      const double inwards[3]);

/* ---- cylinder_contact.c ---- */

/* Contacts of two cylinders, from those that ODE found. @return how many there are now; at most capacity */
uint32_t nook_physics_lay_cylinders(dGeomID g1, dGeomID g2, dContactGeom *contacts, uint32_t count, uint32_t capacity);

/* ---- mesh_contact.c ---- */

/* Mends contacts of which one shape is a mesh. @return how many there are now; at most capacity */
uint32_t nook_physics_flatten_contacts(dGeomID g1, dGeomID g2, dContactGeom *contacts, uint32_t count,
                                       uint32_t capacity);

/* ---- sweep.c ---- */

/* After the pieces of a step: brings a fast body back that went through a wall. */
void nook_physics_stop_at_walls(nook_physics *physics, physics_body *body);

/* ---- sleep.c ---- */

/* Back to where the step began, and to sleep. */
void nook_physics_lay_down(physics_body *body);
/* Puts to sleep what has been at rest together. */
void nook_physics_settle(nook_physics *physics);
