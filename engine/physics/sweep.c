#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <string.h>

/*
 * What is thin and fast may pass a thin wall even in short pieces of a step, when it turns its edge to it; once its centre is
 * behind the wall, contacts push it on. So a ray from where its centre was to where it is must not meet what stands still.
 */

typedef struct wall_query {
    const physics_body *body;
    dContactGeom nearest;
    bool hit;
} wall_query;

static void near_wall(void *user, dGeomID g1, dGeomID g2)
{
    wall_query *query = user;
    bool first = dGeomGetClass(g1) == dRayClass;
    dContactGeom found;
    if (!nook_physics_may_touch(query->body, dGeomGetData(first ? g2 : g1)))
        return;
    if (dCollide(first ? g1 : g2, first ? g2 : g1, 1, &found, sizeof found) == 0)
        return;
    if (!query->hit || found.depth < query->nearest.depth)
        query->nearest = found;
    query->hit = true;
}

/* Back to where its centre met the wall, less half its thickness, and no longer on its way in; contacts do the rest. */
static void stop_at(physics_body *body, const double from[3], const double direction[3], const dContactGeom *wall)
{
    double normal[3], at[3], velocity[3];
    memcpy(normal, wall->normal, sizeof normal);
    if (nook_vector_dot(normal, direction) > 0.0) /* a mesh is met from behind: there the normal points on */
        for (int i = 0; i < 3; i++)
            normal[i] = -normal[i];
    nook_vector_add_scaled(from, fmax(0.0, wall->depth - 0.5 * body->thickness), direction, at);
    memcpy(velocity, dBodyGetLinearVel(body->ode), sizeof velocity);
    nook_vector_add_scaled(velocity, -fmin(0.0, nook_vector_dot(velocity, normal)), normal, velocity);
    dBodySetPosition(body->ode, at[0], at[1], at[2]);
    dBodySetLinearVel(body->ode, velocity[0], velocity[1], velocity[2]);
}

void nook_physics_stop_at_walls(nook_physics *physics, physics_body *body)
{
    double from[3], way[3], direction[3];
    nook_pose start = nook_pose_multiply(&body->previous, &body->body_from_centre);
    memcpy(from, start.position, sizeof from);
    nook_vector_add_scaled(dBodyGetPosition(body->ode), -1.0, from, way);
    double length = nook_vector_length(way);
    if (!(length > nook_physics_tuning.sweep_metres) || !nook_vector_normalize(way, direction))
        return;
    wall_query query = { .body = body };
    dGeomRaySetLength(physics->ray, length);
    dGeomRaySet(physics->ray, from[0], from[1], from[2], direction[0], direction[1], direction[2]);
    dSpaceCollide2(physics->ray, (dGeomID)physics->fixed, &query, near_wall);
    if (query.hit)
        stop_at(body, from, direction, &query.nearest);
}
