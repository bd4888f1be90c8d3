#include "engine/core/vector.h"
#include "engine/physics/internal.h"

bool nook_physics_sleeps(const physics_body *body)
{
    return body->motion == NOOK_BODY_DYNAMIC && !dBodyIsEnabled(body->ode);
}

void nook_physics_wake_body(physics_body *body)
{
    body->rest_steps = body->slow_steps = 0;
    body->bedded = false;
    if (body->motion == NOOK_BODY_DYNAMIC)
        dBodyEnable(body->ode);
}

void nook_physics_wake_around(nook_physics *physics, uint32_t id)
{
    for (uint32_t i = 0; i < physics->contact_count; i++) {
        const physics_contact *c = &physics->contacts[i];
        physics_body *other = c->a == id   ? nook_physics_find(physics, (nook_body){ c->b })
                              : c->b == id ? nook_physics_find(physics, (nook_body){ c->a })
                                           : NULL;
        if (other)
            nook_physics_wake_body(other);
    }
}

void nook_physics_wake(nook_physics *physics, nook_body body)
{
    physics_body *b = nook_physics_find(physics, body);
    if (b)
        nook_physics_wake_body(b);
}

bool nook_physics_asleep(const nook_physics *physics, nook_body body)
{
    const physics_body *b = nook_physics_find(physics, body);
    return b && (nook_physics_sleeps(b) || b->bedded);
}

/* ---- who may sleep ---- */

/* From where it came, not from the velocities, which the solver leaves with what it takes back in the next step. Averages, as
   resting bodies tremble. */
static bool is_calm(physics_body *body)
{
    const double share = NOOK_PHYSICS_STEP / nook_physics_tuning.sleep_average;
    double way[3], turn[3];
    nook_vector_add_scaled(body->current.position, -1.0, body->previous.position, way);
    nook_pose_turn_rate(body->previous.rotation, body->current.rotation, NOOK_PHYSICS_STEP, turn);
    for (int i = 0; i < 3; i++) {
        body->drift[i] += share * (way[i] / NOOK_PHYSICS_STEP - body->drift[i]);
        body->spin[i] += share * (turn[i] - body->spin[i]);
    }
    /* of the velocities at which a body rests; what creeps for long, in a heap that wedges it, is taken for resting too */
    double speed = fmax(nook_vector_length(body->drift) / nook_physics_tuning.sleep_drift,
                        nook_vector_length(body->spin) / nook_physics_tuning.sleep_spin);
    body->slow_steps = speed < nook_physics_tuning.sleep_slow ? body->slow_steps + 1 : 0;
    return speed <= 1.0 + body->slow_steps * NOOK_PHYSICS_STEP / nook_physics_tuning.sleep_patience;
}

/* Islands as a forest over bodies that touch: each points at another of its island, the root at itself. */
static uint32_t root_of(nook_physics *p, uint32_t index)
{
    while (p->bodies[index]->island != index) {
        uint32_t next = p->bodies[index]->island;
        p->bodies[index]->island = p->bodies[next]->island;
        index = next;
    }
    return index;
}

/* What rests on a mover that moved is not at rest, and keeps its island awake. */
static void join_islands(nook_physics *p)
{
    for (uint32_t i = p->kept_count; i < p->contact_count; i++) {
        physics_body *a = nook_physics_find(p, (nook_body){ p->contacts[i].a });
        physics_body *b = nook_physics_find(p, (nook_body){ p->contacts[i].b });
        if (b->motion == NOOK_BODY_DYNAMIC)
            p->bodies[root_of(p, a->island)]->island = root_of(p, b->island);
        else if (b->activity != PHYSICS_RESTS)
            a->rest_steps = 0;
    }
}

static void fall_asleep(physics_body *body)
{
    dBodySetLinearVel(body->ode, 0, 0, 0);
    dBodySetAngularVel(body->ode, 0, 0, 0);
    dBodyDisable(body->ode);
}

static bool is_awake(const physics_body *body)
{
    return body->motion == NOOK_BODY_DYNAMIC && dBodyIsEnabled(body->ode);
}

/* Not at once: its contacts would not be known, nor its weight on what carries it, nor whom to wake when that goes. */
void nook_physics_sleep(nook_physics *physics, nook_body body)
{
    physics_body *b = nook_physics_find(physics, body);
    if (!b || b->motion != NOOK_BODY_DYNAMIC || nook_physics_sleeps(b))
        return;
    b->bedded = true;
    dBodySetLinearVel(b->ode, 0, 0, 0);
    dBodySetAngularVel(b->ode, 0, 0, 0);
}

void nook_physics_lay_down(physics_body *body)
{
    body->bedded = false;
    body->current = body->previous;
    nook_physics_place(body);
    fall_asleep(body);
}

void nook_physics_settle(nook_physics *physics)
{
    const uint32_t enough = (uint32_t)(nook_physics_tuning.sleep_seconds / NOOK_PHYSICS_STEP);
    for (uint32_t i = 0; i < physics->body_count; i++) {
        physics_body *body = physics->bodies[i];
        body->island = i;
        if (!is_awake(body))
            continue;
        body->rest_steps = is_calm(body) ? body->rest_steps + 1 : 0;
    }
    join_islands(physics);
    for (uint32_t i = 0; i < physics->body_count; i++) { /* an island sleeps no sooner than its last member */
        physics_body *body = physics->bodies[i], *root = physics->bodies[root_of(physics, i)];
        if (is_awake(body) && body->rest_steps < root->rest_steps)
            root->rest_steps = body->rest_steps;
    }
    for (uint32_t i = 0; i < physics->body_count; i++)
        if (is_awake(physics->bodies[i]) && physics->bodies[root_of(physics, i)]->rest_steps >= enough)
            fall_asleep(physics->bodies[i]);
}
