#include "engine/core/vector.h"
#include "engine/physics/internal.h"

/* ---- of the last step ---- */

void nook_physics_each_load(const nook_physics *physics, nook_body body,
                            void (*found)(void *user, nook_body other, double newtons), void *user)
{
    for (uint32_t i = 0; i < physics->contact_count; i++) {
        const physics_contact *c = &physics->contacts[i];
        if (c->a == body.id && c->force[1] < 0.0)
            found(user, (nook_body){ c->b }, -c->force[1]);
        else if (c->b == body.id && c->force[1] > 0.0)
            found(user, (nook_body){ c->a }, c->force[1]);
    }
}

static void add_load(void *user, nook_body other, double newtons)
{
    (void)other;
    *(double *)user += newtons;
}

double nook_physics_load(const nook_physics *physics, nook_body body)
{
    double load = 0.0;
    nook_physics_each_load(physics, body, add_load, &load);
    return load;
}

bool nook_physics_ground(const nook_physics *physics, nook_body body, double out_normal[3])
{
    double best = 0.0;
    for (uint32_t i = 0; i < physics->contact_count; i++) {
        const physics_contact *c = &physics->contacts[i];
        double sign = c->a == body.id ? 1.0 : c->b == body.id ? -1.0 : 0.0;
        if (sign * c->normal[1] > best) {
            best = sign * c->normal[1];
            for (int k = 0; k < 3; k++)
                out_normal[k] = sign * c->normal[k];
        }
    }
    return best > 0.0;
}

/* ---- rays ---- */

typedef struct ray_query {
    const nook_body *ignored;
    const double *direction;
    nook_ray_hit nearest;
    bool hit;
} ray_query;

static void near_ray(void *user, dGeomID g1, dGeomID g2)
{
    ray_query *query = user;
    bool first = dGeomGetClass(g1) == dRayClass;
    const physics_body *body = dGeomGetData(first ? g2 : g1);
    if (body->id == query->ignored[0].id || body->id == query->ignored[1].id)
        return;
    dContactGeom found;
    if (dCollide(first ? g1 : g2, first ? g2 : g1, 1, &found, sizeof found) == 0)
        return;
    if (query->hit && found.depth >= query->nearest.distance)
        return;
    query->hit = true;
    query->nearest = (nook_ray_hit){ .body = { body->id }, .distance = found.depth };
    double side = nook_vector_dot(found.normal, query->direction) > 0.0 ? -1.0 : 1.0; /* a mesh from behind */
    for (int i = 0; i < 3; i++)
        query->nearest.normal[i] = side * found.normal[i];
}

bool nook_physics_ray(nook_physics *physics, const double origin[3], const double direction[3], double length,
                      const nook_body ignored[2], nook_ray_hit *out_hit)
{
    ray_query query = { .ignored = ignored, .direction = direction };
    dGeomRaySetLength(physics->ray, length);
    dGeomRaySet(physics->ray, origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]);
    nook_physics_lock();
    dSpaceCollide2(physics->ray, (dGeomID)physics->fixed, &query, near_ray);
    dSpaceCollide2(physics->ray, (dGeomID)physics->moving, &query, near_ray);
    dSpaceCollide2(physics->ray, (dGeomID)physics->ghosts, &query, near_ray);
    nook_physics_unlock();
    if (query.hit)
        *out_hit = query.nearest;
    return query.hit;
}

/* ---- overlaps ---- */

static void near_box(void *user, dGeomID g1, dGeomID g2)
{
    nook_physics *p = user;
    physics_body *body = dGeomGetData(g1 == p->box ? g2 : g1);
    dContactGeom found;
    if (body->query_stamp == p->query_stamp || dCollide(g1, g2, 1, &found, sizeof found) == 0)
        return;
    body->query_stamp = p->query_stamp;
    p->queue[p->queue_count++] = body;
}

void nook_physics_overlap(nook_physics *physics, const double box_min[3], const double box_max[3],
                          void (*found)(void *user, nook_body body), void *user)
{
    double middle[3], side[3];
    for (int i = 0; i < 3; i++) {
        middle[i] = 0.5 * (box_min[i] + box_max[i]);
        side[i] = box_max[i] - box_min[i];
    }
    dGeomBoxSetLengths(physics->box, side[0], side[1], side[2]);
    dGeomSetPosition(physics->box, middle[0], middle[1], middle[2]);
    physics->query_stamp++;
    physics->queue_count = 0; /* between steps the queue is free */
    nook_physics_lock();
    dSpaceCollide2(physics->box, (dGeomID)physics->fixed, physics, near_box);
    dSpaceCollide2(physics->box, (dGeomID)physics->moving, physics, near_box);
    dSpaceCollide2(physics->box, (dGeomID)physics->ghosts, physics, near_box);
    nook_physics_unlock();
    for (uint32_t i = 0, count = physics->queue_count; i < count; i++)
        found(user, (nook_body){ physics->queue[i]->id });
}
