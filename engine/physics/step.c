#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/physics/internal.h"

/* ---- before ---- */

static void aim_kinematic(physics_body *body)
{
    double linear[3] = { 0 }, angular[3] = { 0 };
    if (body->aimed) {
        for (int i = 0; i < 3; i++)
            linear[i] = (body->target.position[i] - body->current.position[i]) / NOOK_PHYSICS_STEP;
        nook_pose_turn_rate(body->current.rotation, body->target.rotation, NOOK_PHYSICS_STEP, angular);
    }
    dBodySetLinearVel(body->ode, linear[0], linear[1], linear[2]);
    dBodySetAngularVel(body->ode, angular[0], angular[1], angular[2]);
}

static void begin(nook_physics *p)
{
    for (uint32_t i = 0; i < p->body_count; i++) {
        physics_body *body = p->bodies[i];
        body->previous = body->current;
        if (body->motion == NOOK_BODY_KINEMATIC)
            aim_kinematic(body);
    }
}

/* Fast and thin things would pass each other within one step: into how many pieces it is cut. */
static int pieces_needed(const nook_physics *p)
{
    double most = nook_physics_tuning.pieces_min;
    for (uint32_t i = 0; i < p->body_count; i++) {
        const physics_body *body = p->bodies[i];
        if (body->motion != NOOK_BODY_DYNAMIC || nook_physics_sleeps(body))
            continue;
        double way = nook_vector_length(dBodyGetLinearVel(body->ode)) * NOOK_PHYSICS_STEP;
        most = fmax(most, way / (nook_physics_tuning.piece_travel * body->thickness));
    }
    return (int)fmin(ceil(most), nook_physics_tuning.pieces_max);
}

/* ---- a piece ---- */

/* What rolls is slowed down as by a force of rolling_resistance times its weight at its rim, and never turned round by that. Its
   moment of inertia is taken for a drum's, m r^2 / 2. */
static double kept_turning(const nook_physics *p, const physics_body *body, double seconds)
{
    double kept = exp(-nook_physics_tuning.angular_loss * seconds);
    if (body->rim == 0.0 || !body->touches)
        return kept;
    double speed = nook_vector_length(dBodyGetAngularVel(body->ode));
    double lost = 2.0 * nook_physics_tuning.rolling_resistance * p->gravity / body->rim * seconds;
    return lost < speed ? kept * (1.0 - lost / speed) : 0.0;
}

static void apply_forces(nook_physics *p, double seconds)
{
    for (uint32_t i = 0; i < p->body_count; i++) {
        physics_body *body = p->bodies[i];
        if (body->motion != NOOK_BODY_DYNAMIC || nook_physics_sleeps(body))
            continue;
        double kept = kept_turning(p, body, seconds);
        const double *w = dBodyGetAngularVel(body->ode);
        dBodyAddForce(body->ode, body->force[0], body->force[1], body->force[2]);
        dBodySetAngularVel(body->ode, kept * w[0], kept * w[1], kept * w[2]);
    }
}

/* The solver moves bodies with the velocity at the end of a piece. What touches nothing is put back by the difference to the
   parabola, so that a throw is the same in however many pieces a step is done. */
static void follow_parabolas(nook_physics *p, double seconds)
{
    const double half_square = 0.5 * seconds * seconds;
    for (uint32_t i = 0; i < p->body_count; i++) {
        physics_body *body = p->bodies[i];
        if (body->motion != NOOK_BODY_DYNAMIC || body->touches || nook_physics_sleeps(body))
            continue;
        double at[3];
        nook_vector_add_scaled(dBodyGetPosition(body->ode), -half_square / body->mass, body->force, at);
        dBodySetPosition(body->ode, at[0], at[1] + half_square * p->gravity, at[2]);
    }
}

/* Few contacts can be solved well at no cost worth mentioning; many must do with less. */
static int iterations_for(uint32_t contacts)
{
    const physics_tuning *t = &nook_physics_tuning;
    return (int)fmax(t->iterations_min, fmin(t->iterations_max, t->iterations_work / fmax(1.0, contacts)));
}

static void advance(nook_physics *p, double seconds)
{
    nook_physics_collide(p);
    dWorldSetQuickStepNumIterations(p->world, iterations_for(p->contact_count - p->kept_count));
    apply_forces(p, seconds);
    dRandSetSeed(p->random);
    dWorldQuickStep(p->world, seconds);
    p->random = dRandGetSeed();
    follow_parabolas(p, seconds);
    nook_physics_release_contacts(p);
}

/* ---- after ---- */

static bool finite_pose(const nook_pose *pose)
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
        sum += pose->position[i] - pose->position[i];
    for (int i = 0; i < 4; i++)
        sum += pose->rotation[i] - pose->rotation[i];
    return sum == 0.0; /* infinity less itself is NaN */
}

static void end_dynamic(nook_physics *p, physics_body *body)
{
    if (body->upright) { /* its inertia is huge, not infinite */
        const dQuaternion q = { body->previous.rotation[3], body->previous.rotation[0], body->previous.rotation[1],
                                body->previous.rotation[2] };
        dBodySetQuaternion(body->ode, q);
        dBodySetAngularVel(body->ode, 0, 0, 0);
    }
    nook_physics_stop_at_walls(p, body);
    nook_physics_read_pose(body);
    for (int i = 0; i < 3; i++)
        body->force[i] = 0.0;
}

static nook_result end(nook_physics *p)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < p->body_count; i++) {
        physics_body *body = p->bodies[i];
        if (body->motion == NOOK_BODY_DYNAMIC && !nook_physics_sleeps(body)) {
            end_dynamic(p, body);
            if (body->bedded)
                nook_physics_lay_down(body);
            if (!finite_pose(&body->current))
                result = nook_fail(NOOK_E_RANGE, "physics: body %u is nowhere after step %llu; please report it",
                                   body->id, (unsigned long long)p->steps);
        } else if (body->motion == NOOK_BODY_KINEMATIC && body->aimed) {
            body->current = body->target;
            body->aimed = false;
            nook_physics_place(body);
        }
    }
    return result;
}

nook_result nook_physics_step(nook_physics *physics)
{
    double start = nook_clock_ms();
    begin(physics);
    int pieces = pieces_needed(physics);
    nook_physics_lock();
    for (int i = 0; i < pieces; i++)
        advance(physics, NOOK_PHYSICS_STEP / pieces);
    nook_result result = end(physics);
    nook_physics_unlock();
    nook_physics_settle(physics);
    physics->steps++;
    physics->statistics.contacts = physics->contact_count - physics->kept_count;
    if (physics->out_of_memory) {
        physics->out_of_memory = false;
        result = nook_fail(NOOK_E_MEMORY, "physics: no memory for the contacts of step %llu",
                           (unsigned long long)physics->steps);
    }
    physics->statistics.step_ms = nook_clock_ms() - start;
    return result;
}
