/**
 * physics_scene.h - small worlds of rigid bodies for tests: a floor, boxes, and steps. Everything fails the test when it cannot.
 */
#pragma once
#include "engine/physics/physics.h"

nook_physics *physics_scene_create(void);

/** A body of one shape at a place, not turned; friction 0.6, restitution 0. */
nook_body_desc physics_scene_desc(const nook_shape *shape, nook_body_motion motion, double mass, double x, double y,
                                  double z);
nook_body physics_scene_add(nook_physics *physics, const nook_body_desc *desc);

nook_shape physics_scene_box(double half_x, double half_y, double half_z);
nook_shape physics_scene_round(nook_shape_kind kind, double radius, double half_height);

/** A static box whose top is the plane y = 0, `half` to each side. */
nook_body physics_scene_floor(nook_physics *physics, double half);
/** A dynamic box. */
nook_body physics_scene_crate(nook_physics *physics, double half, double mass, double x, double y, double z);

/** Triangles of a level grid: cells * cells squares around the origin at y = 0, facing up. */
typedef struct physics_scene_mesh {
    float *positions;
    uint32_t *indices;
    nook_shape shape; /**< Of these. */
} physics_scene_mesh;
physics_scene_mesh physics_scene_grid(double half, uint32_t cells);
/** An axis-aligned box of triangles that face inwards (a room) or outwards, each side cells * cells squares. */
physics_scene_mesh physics_scene_mesh_box(const double half[3], uint32_t cells, bool inwards);
void physics_scene_mesh_free(physics_scene_mesh *mesh);

void physics_scene_step(nook_physics *physics, uint32_t steps);
/** Of the body's origin after the last step. */
void physics_scene_position(const nook_physics *physics, nook_body body, double out[3]);
double physics_scene_height(const nook_physics *physics, nook_body body);
/** Radians between the body's Y axis and the world's. */
double physics_scene_tilt(const nook_physics *physics, nook_body body);

void physics_assert_near(double actual, double expected, double tolerance);
