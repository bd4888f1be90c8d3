#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const double no_velocity[3] = { 0, 0, 0 };

/* A body that nothing turns: contacts push at arm's lengths of metres, and this is 10^9 times what a crate resists with. */
static const double upright_inertia = 1e9;

/* ---- where it is ---- */

static void to_ode(const double rotation[4], double out[4])
{
    out[0] = rotation[3], out[1] = rotation[0], out[2] = rotation[1], out[3] = rotation[2];
}

void nook_physics_place(physics_body *body)
{
    double q[4];
    if (body->ode) {
        nook_pose at = nook_pose_multiply(&body->current, &body->body_from_centre);
        to_ode(at.rotation, q);
        dBodySetPosition(body->ode, at.position[0], at.position[1], at.position[2]);
        dBodySetQuaternion(body->ode, q);
        return;
    }
    for (uint32_t i = 0; i < body->shape_count; i++) {
        nook_pose at = nook_pose_multiply(&body->current, &body->shapes[i].body_from_shape);
        to_ode(at.rotation, q);
        dGeomSetPosition(body->shapes[i].geom, at.position[0], at.position[1], at.position[2]);
        dGeomSetQuaternion(body->shapes[i].geom, q);
    }
}

void nook_physics_read_pose(physics_body *body)
{
    const double *p = dBodyGetPosition(body->ode), *q = dBodyGetQuaternion(body->ode);
    const nook_pose centre = { .position = { p[0], p[1], p[2] }, .rotation = { q[1], q[2], q[3], q[0] } };
    nook_pose centre_from_body = nook_pose_inverse(&body->body_from_centre);
    body->current = nook_pose_multiply(&centre, &centre_from_body);
}

/* ---- add ---- */

static nook_result check_desc(const nook_body_desc *desc)
{
    if (desc->shape_count == 0)
        return nook_fail(NOOK_E_ARG, "physics: a body without a shape; give at least one");
    for (uint32_t i = 0; i < desc->shape_count; i++) {
        nook_result result = nook_physics_check_shape(&desc->shapes[i], desc->motion);
        if (result != NOOK_OK)
            return result;
    }
    if (!nook_pose_valid(&desc->pose))
        return nook_fail(NOOK_E_ARG, "physics: the pose of a body is not finite or its rotation not unit");
    if (desc->motion == NOOK_BODY_DYNAMIC && !(desc->mass > 0.0 && desc->mass <= 1e9))
        return nook_fail(NOOK_E_ARG, "physics: a dynamic body of %g kg; it must be in (0, 1e9]", desc->mass);
    if (!(desc->friction >= 0.0 && isfinite(desc->friction)))
        return nook_fail(NOOK_E_ARG, "physics: a friction of %g; it must be >= 0", desc->friction);
    if (!(desc->restitution >= 0.0 && desc->restitution <= 1.0))
        return nook_fail(NOOK_E_ARG, "physics: a restitution of %g; it must be in [0, 1]", desc->restitution);
    if (desc->ghost && desc->motion == NOOK_BODY_DYNAMIC)
        return nook_fail(NOOK_E_ARG, "physics: a dynamic ghost would fall for ever; make it static or kinematic");
    return NOOK_OK;
}

static void make_ode_body(nook_physics *p, physics_body *body, const nook_body_desc *desc)
{
    body->ode = dBodyCreate(p->world);
    dBodySetData(body->ode, body);
    if (desc->motion == NOOK_BODY_KINEMATIC) {
        dBodySetKinematic(body->ode);
    } else {
        dMass mass;
        nook_physics_spread_mass(desc, &mass, body->body_from_centre.position);
        if (desc->upright)
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    mass.I[i * 4 + j] = i == j ? upright_inertia : 0.0;
        dBodySetMass(body->ode, &mass);
        body->mass = desc->mass;
    }
    nook_pose centre_from_body = nook_pose_inverse(&body->body_from_centre);
    for (uint32_t i = 0; i < body->shape_count; i++) {
        nook_pose offset = nook_pose_multiply(&centre_from_body, &body->shapes[i].body_from_shape);
        double q[4];
        to_ode(offset.rotation, q);
        dGeomSetBody(body->shapes[i].geom, body->ode);
        dGeomSetOffsetPosition(body->shapes[i].geom, offset.position[0], offset.position[1], offset.position[2]);
        dGeomSetOffsetQuaternion(body->shapes[i].geom, q);
    }
}

/* Room for one more body and for all of them in the queue. */
static nook_result reserve(nook_physics *p)
{
    if (p->body_count < p->body_capacity)
        return NOOK_OK;
    uint32_t capacity = p->body_capacity ? 2 * p->body_capacity : 64;
    physics_body **bodies = realloc(p->bodies, capacity * sizeof(physics_body *));
    if (bodies)
        p->bodies = bodies;
    physics_body **queue = realloc(p->queue, capacity * sizeof(physics_body *));
    if (queue)
        p->queue = queue;
    if (!bodies || !queue)
        return nook_fail(NOOK_E_MEMORY, "physics: no memory for %u bodies", capacity);
    p->body_capacity = capacity;
    return NOOK_OK;
}

static dSpaceID space_of(const nook_physics *p, const nook_body_desc *desc)
{
    if (desc->ghost)
        return p->ghosts;
    return desc->motion == NOOK_BODY_STATIC ? p->fixed : p->moving;
}

static physics_body describe(const nook_body_desc *desc, uint32_t id)
{
    nook_pose pose = desc->pose, here = nook_pose_identity();
    pose = nook_pose_multiply(&pose, &here); /* unit to the last digits */
    return (physics_body){ .id = id,
                           .motion = desc->motion,
                           .upright = desc->upright,
                           .ghost = desc->ghost,
                           .friction = desc->friction,
                           .restitution = desc->restitution,
                           .user = desc->user,
                           .body_from_centre = here,
                           .previous = pose,
                           .current = pose };
}

nook_result nook_physics_add(nook_physics *physics, const nook_body_desc *desc, nook_body *out_body)
{
    nook_result result = check_desc(desc);
    if (result == NOOK_OK)
        result = reserve(physics);
    if (result != NOOK_OK)
        return result;
    physics_body *body = malloc(sizeof *body);
    if (!body || physics->last_id == UINT32_MAX) {
        free(body);
        return nook_fail(NOOK_E_MEMORY, "physics: no memory or no number for another body");
    }
    *body = describe(desc, physics->last_id + 1);
    result = nook_physics_make_shapes(body, desc, space_of(physics, desc));
    if (result != NOOK_OK) {
        nook_physics_free_shapes(body);
        free(body);
        return result;
    }
    if (desc->motion != NOOK_BODY_STATIC)
        make_ode_body(physics, body, desc);
    nook_physics_place(body);
    physics->last_id++;
    physics->bodies[physics->body_count++] = body;
    *out_body = (nook_body){ body->id };
    return NOOK_OK;
}

/* ---- remove ---- */

static void forget_contacts(nook_physics *p, uint32_t id)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < p->contact_count; i++)
        if (p->contacts[i].a != id && p->contacts[i].b != id)
            p->contacts[kept++] = p->contacts[i];
    p->contact_count = kept;
}

void nook_physics_remove(nook_physics *physics, nook_body body)
{
    physics_body *gone = nook_physics_find(physics, body);
    if (!gone)
        return;
    nook_physics_wake_around(physics, gone->id);
    forget_contacts(physics, gone->id);
    uint32_t index = 0;
    while (physics->bodies[index] != gone)
        index++;
    physics->body_count--;
    memmove(physics->bodies + index, physics->bodies + index + 1,
            (physics->body_count - index) * sizeof(physics_body *));
    nook_physics_free_shapes(gone);
    if (gone->ode)
        dBodyDestroy(gone->ode);
    free(gone);
}

bool nook_physics_alive(const nook_physics *physics, nook_body body)
{
    return nook_physics_find(physics, body) != NULL;
}

uint64_t nook_physics_user(const nook_physics *physics, nook_body body)
{
    const physics_body *b = nook_physics_find(physics, body);
    return b ? b->user : 0;
}

/* ---- poses ---- */

nook_pose nook_physics_pose(const nook_physics *physics, nook_body body, double alpha)
{
    const physics_body *b = nook_physics_find(physics, body);
    return b ? nook_pose_between(&b->previous, &b->current, alpha) : nook_pose_identity();
}

void nook_physics_set_pose(nook_physics *physics, nook_body body, const nook_pose *pose)
{
    physics_body *b = nook_physics_find(physics, body);
    assert(nook_pose_valid(pose));
    if (!b)
        return;
    nook_pose here = nook_pose_identity();
    nook_physics_wake_around(physics, b->id);
    b->previous = b->current = nook_pose_multiply(pose, &here);
    b->aimed = false;
    nook_physics_place(b);
    nook_physics_set_velocity(physics, body, no_velocity, no_velocity);
    nook_physics_wake_body(b);
}

void nook_physics_move(nook_physics *physics, nook_body body, const nook_pose *target)
{
    physics_body *b = nook_physics_find(physics, body);
    assert(nook_pose_valid(target));
    assert(!b || b->motion == NOOK_BODY_KINEMATIC);
    if (!b)
        return;
    nook_pose here = nook_pose_identity();
    b->target = nook_pose_multiply(target, &here);
    b->aimed = memcmp(&b->target, &b->current, sizeof b->target) != 0;
}

/* ---- velocities and forces ---- */

void nook_physics_velocity(const nook_physics *physics, nook_body body, double out_linear[3], double out_angular[3])
{
    const physics_body *b = nook_physics_find(physics, body);
    bool moves = b && b->ode;
    memcpy(out_linear, moves ? dBodyGetLinearVel(b->ode) : no_velocity, sizeof no_velocity);
    memcpy(out_angular, moves ? dBodyGetAngularVel(b->ode) : no_velocity, sizeof no_velocity);
}

void nook_physics_set_velocity(nook_physics *physics, nook_body body, const double linear[3], const double angular[3])
{
    physics_body *b = nook_physics_find(physics, body);
    if (!b || b->motion != NOOK_BODY_DYNAMIC)
        return;
    const double *turning = b->upright ? no_velocity : angular;
    dBodySetLinearVel(b->ode, linear[0], linear[1], linear[2]);
    dBodySetAngularVel(b->ode, turning[0], turning[1], turning[2]);
    nook_physics_wake_body(b);
}

void nook_physics_push(nook_physics *physics, nook_body body, const double force[3])
{
    physics_body *b = nook_physics_find(physics, body);
    if (!b || b->motion != NOOK_BODY_DYNAMIC)
        return;
    nook_vector_add_scaled(b->force, 1.0, force, b->force);
    nook_physics_wake_body(b);
}

void nook_physics_ignore(nook_physics *physics, nook_body a, nook_body b)
{
    physics_body *body = nook_physics_find(physics, a);
    if (body)
        body->ignored = b;
}

double nook_physics_mass(const nook_physics *physics, nook_body body)
{
    const physics_body *b = nook_physics_find(physics, body);
    return b ? b->mass : 0.0;
}
