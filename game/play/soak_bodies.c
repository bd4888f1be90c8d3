#include "game/play/soak_bodies.h"
#include "engine/core/vector.h"
#include "game/play/session_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What moves may lie in the way of a ray that asks for what stands still: so many are looked through. */
enum { LOOKED_THROUGH = 16 };
static const double beyond = 1e-6; /* metres behind what was looked through */

struct nook_soak_path {
    double at[3];     /* its middle after the last tick */
    uint32_t returns; /* as session_return.count, then */
    char crossed
        [NOOK_LEVEL_NAME_SIZE]; /* what stands still and its middle went through since it lay still; "": nothing */
};

/* ---- Through what stands still ----------------------------------------------------------------------------------- */

/* @return the thing between two places that stands still, or NOOK_NONE */
static uint32_t find_between(const nook_session *s, nook_body self, const double from[3], const double to[3])
{
    const nook_body ignored[2] = { self, { 0 } };
    double at[3], direction[3];
    nook_ray_hit hit;
    memcpy(at, from, sizeof at);
    for (int i = 0; i < LOOKED_THROUGH; i++) {
        for (int k = 0; k < 3; k++)
            direction[k] = to[k] - at[k];
        double length = nook_vector_length(direction);
        if (!nook_vector_normalize(direction, direction) ||
            !nook_physics_ray(s->physics, at, direction, length, ignored, &hit))
            return NOOK_NONE;
        uint32_t thing = session_thing_of_body(s, hit.body);
        if (thing != NOOK_NONE && s->things[thing].motion == NOOK_BODY_STATIC)
            return thing;
        if (hit.distance + beyond >= length)
            return NOOK_NONE;
        nook_vector_add_scaled(at, hit.distance + beyond, direction, at);
    }
    return NOOK_NONE;
}

static void follow(nook_soak_path *path, const nook_session *s, nook_body self, const double middle[3])
{
    if (nook_physics_asleep(s->physics, self))
        path->crossed[0] = '\0';
    else if (!*path->crossed && memcmp(path->at, middle, sizeof path->at) != 0)
        snprintf(path->crossed, sizeof path->crossed, "%s",
                 session_thing_name(s, find_between(s, self, path->at, middle)));
    memcpy(path->at, middle, sizeof path->at);
}

/* ---- Out of the world -------------------------------------------------------------------------------------------- */

static void count_leaving(nook_soak_bodies *bodies, nook_soak_path *path, const char *name,
                          const session_return *returned, const double middle[3])
{
    const double *at = returned->left_at;
    if (*path->crossed) {
        bodies->through++;
        nook_log_warning("soak: %s went through %s and left the world at %.2f %.2f %.2f", name, path->crossed, at[0],
                         at[1], at[2]);
    } else {
        bodies->over_an_edge++;
    }
    snprintf(bodies->last, sizeof bodies->last, "%s", name);
    memcpy(bodies->last_at, at, sizeof bodies->last_at);
    path->crossed[0] = '\0';
    path->returns = returned->count;
    memcpy(path->at, middle, sizeof path->at);
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static void look_at(nook_soak_bodies *bodies, uint32_t index, const nook_session *s, bool anew)
{
    bool is_player = index == s->thing_count;
    const session_thing *thing = is_player ? NULL : &s->things[index];
    const session_return *returned = is_player ? &s->player.returned : &thing->returned;
    nook_body self = is_player ? s->player.body : thing->body;
    nook_soak_path *path = &bodies->paths[index];
    double middle[3];
    if (is_player) {
        memcpy(middle, s->player.feet, sizeof middle);
        middle[1] += 0.5 * (double)s->params.height;
    } else {
        session_thing_middle(s, thing, middle);
    }
    if (anew) {
        *path = (nook_soak_path){ .returns = returned->count };
        memcpy(path->at, middle, sizeof path->at);
    } else if (returned->count != path->returns) {
        count_leaving(bodies, path, is_player ? "the player" : session_thing_name(s, index), returned, middle);
    } else {
        follow(path, s, self, middle);
    }
}

nook_result nook_soak_bodies_look(nook_soak_bodies *bodies, const nook_session *session)
{
    const nook_session *s = session;
    bool anew = !bodies->paths || s->ticks <= bodies->ticks;
    if (!bodies->paths) {
        bodies->path_count = s->thing_count + 1;
        bodies->paths = calloc(bodies->path_count, sizeof *bodies->paths);
        if (!bodies->paths)
            return nook_fail(NOOK_E_MEMORY, "soak: no memory for the ways of %u bodies", s->thing_count);
    }
    for (uint32_t i = 0; i < bodies->path_count; i++) {
        if (i == s->thing_count || s->things[i].motion == NOOK_BODY_DYNAMIC)
            look_at(bodies, i, s, anew);
    }
    bodies->ticks = s->ticks;
    return NOOK_OK;
}

void nook_soak_bodies_free(nook_soak_bodies *bodies)
{
    free(bodies->paths);
    bodies->paths = NULL;
    bodies->path_count = 0;
}
