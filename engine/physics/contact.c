#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <stdlib.h>
#include <string.h>

enum { FOUND_MAX = 512 }; /* contacts of one pair of shapes before they are merged */

/* ---- pairs -------------------------------------------------------------------------------------------------------- */

bool nook_physics_may_touch(const physics_body *a, const physics_body *b)
{
    if (a == b || (a->motion != NOOK_BODY_DYNAMIC && b->motion != NOOK_BODY_DYNAMIC))
        return false;
    return a->ignored.id != b->id && b->ignored.id != a->id;
}

static bool reserve(nook_physics *p, uint32_t count)
{
    if (p->contact_count + count <= p->contact_capacity)
        return true;
    uint32_t capacity = 2 * p->contact_capacity;
    physics_contact *contacts = realloc(p->contacts, capacity * sizeof *contacts);
    if (!contacts) {
        p->out_of_memory = true;
        return false;
    }
    p->contacts = contacts;
    p->contact_capacity = capacity;
    return true;
}

static void append(nook_physics *p, const physics_body *first, const physics_body *second, const dContactGeom *found)
{
    bool swap = first->motion != NOOK_BODY_DYNAMIC;
    physics_contact *c = &p->contacts[p->contact_count++];
    *c = (physics_contact){ .a = swap ? second->id : first->id,
                            .b = swap ? first->id : second->id,
                            .depth = found->depth };
    for (int i = 0; i < 3; i++) {
        c->position[i] = found->pos[i];
        c->normal[i] = swap ? -found->normal[i] : found->normal[i];
    }
}

/* What ODE finds, mended where it does not find enough, and thinned out. */
static uint32_t find_points(dGeomID g1, dGeomID g2, dContactGeom found[FOUND_MAX])
{
    int class1 = dGeomGetClass(g1), class2 = dGeomGetClass(g2);
    bool mesh = class1 == dTriMeshClass || class2 == dTriMeshClass;
    int flags = mesh ? FOUND_MAX | (int)CONTACTS_UNIMPORTANT : FOUND_MAX; /* ODE need not thin them out: merge.c does */
    uint32_t count = (uint32_t)dCollide(g1, g2, flags, found, sizeof *found);
    if (mesh)
        count = nook_physics_flatten_contacts(g1, g2, found, count, FOUND_MAX);
    else if (class1 == dCylinderClass && class2 == dCylinderClass)
        count = nook_physics_lay_cylinders(g1, g2, found, count, FOUND_MAX);
    return nook_physics_merge_contacts(found, count);
}

/* @return whether they touch */
static bool collide_pair(nook_physics *p, dGeomID g1, dGeomID g2)
{
    dContactGeom found[FOUND_MAX];
    uint32_t count = find_points(g1, g2, found);
    if (count == 0 || !reserve(p, count))
        return false;
    for (uint32_t i = 0; i < count; i++)
        append(p, dGeomGetData(g1), dGeomGetData(g2), &found[i]);
    return true;
}

/* ---- who touches whom --------------------------------------------------------------------------------------------- */

/*
 * Bodies that move are looked at one after another: what does each touch that was not looked at before it? What rests and is
 * touched wakes and stands at the end of the queue, so that it has all of its own contacts in the same piece of a step. Who sleeps
 * away from all that costs nothing.
 */

static void enqueue(nook_physics *p, physics_body *body)
{
    body->activity = PHYSICS_QUEUED;
    p->queue[p->queue_count++] = body;
}

static void wake_touched(nook_physics *p, physics_body *body)
{
    if (body->motion != NOOK_BODY_DYNAMIC || body->activity != PHYSICS_RESTS)
        return;
    nook_physics_wake_body(body);
    enqueue(p, body);
}

static void near_moving(void *user, dGeomID g1, dGeomID g2)
{
    nook_physics *p = user;
    physics_body *a = dGeomGetData(g1), *b = dGeomGetData(g2), *other = a == p->in_hand ? b : a;
    if (other->activity != PHYSICS_LOOKED && nook_physics_may_touch(a, b) && collide_pair(p, g1, g2))
        wake_touched(p, other);
}

static void near_fixed(void *user, dGeomID g1, dGeomID g2)
{
    if (nook_physics_may_touch(dGeomGetData(g1), dGeomGetData(g2)))
        collide_pair(user, g1, g2);
}

static void queue_moving(nook_physics *p)
{
    p->queue_count = 0;
    for (uint32_t i = 0; i < p->body_count; i++) {
        physics_body *body = p->bodies[i];
        bool moves = body->motion == NOOK_BODY_DYNAMIC ? dBodyIsEnabled(body->ode) : body->aimed;
        body->activity = PHYSICS_RESTS;
        body->touches = false;
        if (moves && !body->ghost)
            enqueue(p, body);
    }
}

static void collide_body(nook_physics *p, const physics_body *body, dSpaceID space, dNearCallback *near)
{
    for (uint32_t i = 0; i < body->shape_count; i++)
        dSpaceCollide2(body->shapes[i].geom, (dGeomID)space, p, near);
}

static void find_contacts(nook_physics *p)
{
    queue_moving(p);
    for (uint32_t i = 0; i < p->queue_count; i++) { /* grows on the way */
        p->in_hand = p->queue[i];
        collide_body(p, p->queue[i], p->moving, near_moving);
        p->queue[i]->activity = PHYSICS_LOOKED;
    }
    for (uint32_t i = 0; i < p->body_count; i++)
        if (p->bodies[i]->motion == NOOK_BODY_DYNAMIC && p->bodies[i]->activity != PHYSICS_RESTS)
            collide_body(p, p->bodies[i], p->fixed, near_fixed);
}

/* Of the contacts there were, those between bodies that still rest stay. */
static void keep_resting(nook_physics *p, uint32_t old_count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < old_count; i++) {
        const physics_contact *c = &p->contacts[i];
        const physics_body *a = nook_physics_find(p, (nook_body){ c->a });
        const physics_body *b = nook_physics_find(p, (nook_body){ c->b });
        if (a->activity == PHYSICS_RESTS && b->activity == PHYSICS_RESTS)
            p->contacts[kept++] = *c;
    }
    memmove(p->contacts + kept, p->contacts + old_count, (p->contact_count - old_count) * sizeof *p->contacts);
    p->contact_count -= old_count - kept;
    p->kept_count = kept;
}

/* ---- joints ------------------------------------------------------------------------------------------------------- */

static void point_velocity(dBodyID body, const double at[3], double out[3])
{
    dVector3 v = { 0 };
    if (body)
        dBodyGetPointVel(body, at[0], at[1], at[2], v);
    memcpy(out, v, 3 * sizeof(double));
}

/* The part of v along the surface, as a direction. @return false when it is shorter than `least` */
static bool along_surface(const double v[3], const double normal[3], double least, double out[3])
{
    double flat[3];
    nook_vector_add_scaled(v, -nook_vector_dot(v, normal), normal, flat);
    return nook_vector_length(flat) > least && nook_vector_normalize(flat, out);
}

/* The solver bounds friction along two directions, which makes a pyramid of Coulomb's cone. The first direction is where the
   body slides or would slide, so that the bound is Coulomb's there. */
static bool friction_direction(const nook_physics *p, const physics_contact *c, dBodyID a, dBodyID b, double out[3])
{
    double va[3], vb[3], v[3];
    const double down[3] = { 0, -p->gravity, 0 };
    point_velocity(a, c->position, va);
    point_velocity(b, c->position, vb);
    nook_vector_add_scaled(va, -1.0, vb, v);
    return along_surface(v, c->normal, nook_physics_tuning.sliding_speed, out) ||
           along_surface(down, c->normal, 0.01 * p->gravity, out);
}

static void make_joint(nook_physics *p, physics_contact *c)
{
    physics_body *a = nook_physics_find(p, (nook_body){ c->a }), *b = nook_physics_find(p, (nook_body){ c->b });
    a->touches = b->touches = true;
    dContact contact = { .surface = { .mode = dContactApprox1, .mu = sqrt(a->friction * b->friction) } };
    double bounce = fmax(a->restitution, b->restitution), direction[3];
    if (bounce > 0.0) {
        contact.surface.mode |= dContactBounce;
        contact.surface.bounce = bounce;
        contact.surface.bounce_vel = nook_physics_tuning.bounce_speed;
    }
    if (friction_direction(p, c, a->ode, b->ode, direction)) {
        contact.surface.mode |= dContactFDir1;
        memcpy(contact.fdir1, direction, sizeof direction);
    }
    memcpy(contact.geom.pos, c->position, sizeof c->position);
    memcpy(contact.geom.normal, c->normal, sizeof c->normal);
    contact.geom.depth = c->depth;
    dJointID joint = dJointCreateContact(p->world, p->joints, &contact);
    dJointAttach(joint, a->ode, b->ode);
    dJointSetFeedback(joint, &c->feedback);
}

void nook_physics_collide(nook_physics *physics)
{
    uint32_t old_count = physics->contact_count;
    find_contacts(physics);
    keep_resting(physics, old_count);
    for (uint32_t i = physics->kept_count; i < physics->contact_count; i++)
        make_joint(physics, &physics->contacts[i]); /* from here on the array must not move: feedback */
}

void nook_physics_release_contacts(nook_physics *physics)
{
    for (uint32_t i = physics->kept_count; i < physics->contact_count; i++)
        memcpy(physics->contacts[i].force, physics->contacts[i].feedback.f1, sizeof physics->contacts[i].force);
    dJointGroupEmpty(physics->joints);
}
