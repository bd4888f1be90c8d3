#include "engine/core/log.h"
#include "engine/physics/internal.h"
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

const physics_tuning nook_physics_tuning = {
#define NOOK_TUNING(name, value) .name = value,
#include "engine/physics/tuning.def"
#undef NOOK_TUNING
};

/* ---- what ODE has once a process ---- */

/* The exception to our rule of no mutable file-scope variables: ODE itself is initialised once a process and, as Debian builds
   it, keeps one random number generator and one set of caches for meshes, which worlds on different threads would share. */
static pthread_once_t ode_once = PTHREAD_ONCE_INIT;
static pthread_mutex_t ode_mutex = PTHREAD_MUTEX_INITIALIZER;

static void say_message(int number, const char *format, va_list arguments)
{
    char text[512];
    vsnprintf(text, sizeof text, format, arguments);
    nook_log_warning("physics: ODE says: %s (%d)", text, number);
}

static void start_ode(void)
{
    dInitODE2(0);
    dAllocateODEDataForThread((unsigned)dAllocateMaskAll);
    dSetMessageHandler(say_message);
}

void nook_physics_lock(void)
{
    pthread_mutex_lock(&ode_mutex);
}

void nook_physics_unlock(void)
{
    pthread_mutex_unlock(&ode_mutex);
}

/* ---- create, destroy ---- */

static void set_up_world(nook_physics *p)
{
    const physics_tuning *t = &nook_physics_tuning;
    dWorldSetGravity(p->world, 0, -p->gravity, 0);
    dWorldSetERP(p->world, t->error_reduction);
    dWorldSetCFM(p->world, t->force_mixing);
    dWorldSetQuickStepW(p->world, t->relaxation);
    dWorldSetContactMaxCorrectingVel(p->world, t->contact_speed);
    dWorldSetContactSurfaceLayer(p->world, t->contact_layer);
    dWorldSetAutoDisableFlag(p->world, 0); /* sleep.c does that, and for all that touch each other at once */
}

nook_result nook_physics_create(const nook_physics_desc *desc, nook_physics **out_physics)
{
    *out_physics = NULL;
    pthread_once(&ode_once, start_ode);
    nook_physics *p = calloc(1, sizeof *p);
    physics_contact *contacts = malloc(PHYSICS_FIRST_CONTACTS * sizeof *contacts);
    if (!p || !contacts) {
        free(p);
        free(contacts);
        return nook_fail(NOOK_E_MEMORY, "physics: no memory for a world");
    }
    p->contacts = contacts;
    p->contact_capacity = PHYSICS_FIRST_CONTACTS;
    p->gravity = desc->gravity != 0.0 ? desc->gravity : 9.81;
    p->random = desc->seed;
    p->world = dWorldCreate();
    p->fixed = dSimpleSpaceCreate(NULL); /* all are asked about one shape at a time: there is nothing to sort */
    p->moving = dSimpleSpaceCreate(NULL);
    p->ghosts = dSimpleSpaceCreate(NULL);
    p->joints = dJointGroupCreate(0);
    p->ray = dCreateRay(NULL, 1.0);
    p->box = dCreateBox(NULL, 1.0, 1.0, 1.0);
    dGeomRaySetClosestHit(p->ray, 1);
    set_up_world(p);
    *out_physics = p;
    return NOOK_OK;
}

void nook_physics_destroy(nook_physics *physics)
{
    if (!physics)
        return;
    for (uint32_t i = 0; i < physics->body_count; i++) {
        physics_body *body = physics->bodies[i];
        nook_physics_free_shapes(body);
        free(body);
    }
    dGeomDestroy(physics->ray);
    dGeomDestroy(physics->box);
    dJointGroupDestroy(physics->joints);
    dSpaceDestroy(physics->ghosts);
    dSpaceDestroy(physics->moving);
    dSpaceDestroy(physics->fixed);
    dWorldDestroy(physics->world); /* and its bodies */
    free(physics->bodies);
    free(physics->queue);
    free(physics->contacts);
    free(physics);
}

/* ---- looking at it ---- */

physics_body *nook_physics_find(const nook_physics *physics, nook_body body)
{
    uint32_t low = 0, high = physics->body_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (physics->bodies[middle]->id < body.id)
            low = middle + 1;
        else
            high = middle;
    }
    bool found = low < physics->body_count && physics->bodies[low]->id == body.id;
    return found ? physics->bodies[low] : NULL;
}

uint32_t nook_physics_bodies(const nook_physics *physics, nook_body *out, uint32_t capacity)
{
    for (uint32_t i = 0; out && i < capacity && i < physics->body_count; i++)
        out[i] = (nook_body){ physics->bodies[i]->id };
    return physics->body_count;
}

uint64_t nook_physics_steps(const nook_physics *physics)
{
    return physics->steps;
}

void nook_physics_get_statistics(const nook_physics *physics, nook_physics_statistics *out_statistics)
{
    nook_physics_statistics s = physics->statistics;
    s.bodies = physics->body_count;
    s.dynamic = s.awake = 0;
    for (uint32_t i = 0; i < physics->body_count; i++) {
        const physics_body *body = physics->bodies[i];
        s.dynamic += body->motion == NOOK_BODY_DYNAMIC;
        s.awake += body->motion == NOOK_BODY_DYNAMIC && !nook_physics_sleeps(body);
    }
    *out_statistics = s;
}

uint64_t nook_physics_hash(const nook_physics *physics)
{
    uint64_t hash = 0;
    for (uint32_t i = 0; i < physics->body_count; i++) {
        const physics_body *body = physics->bodies[i];
        double numbers[14] = { 0 };
        memcpy(numbers, &body->current, sizeof body->current);
        nook_physics_velocity(physics, (nook_body){ body->id }, numbers + 7, numbers + 10);
        numbers[13] = nook_physics_sleeps(body);
        for (int j = 0; j < 14; j++)
            numbers[j] += 0.0; /* -0 is 0 */
        hash = XXH3_64bits_withSeed(numbers, sizeof numbers, hash);
    }
    return hash;
}
