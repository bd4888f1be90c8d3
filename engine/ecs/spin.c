#include "engine/ecs/spin.h"
#include "engine/core/rotation.h"
#include <string.h>

/* About the pivot: what the start has of scale and shear turns with the body. */
static void place(const nook_spin *spin, nook_transform *out)
{
    const double *pivot = spin->pivot;
    nook_matrix start, turn = nook_rotation_matrix(spin->rotation);
    memcpy(start.m, spin->world_from_start, sizeof start.m);
    for (int axis = 0; axis < 3; axis++)
        start.m[12 + axis] -= pivot[axis];
    nook_matrix world_from_local = nook_matrix_multiply(&turn, &start);
    for (int axis = 0; axis < 3; axis++)
        world_from_local.m[12 + axis] += pivot[axis];
    memcpy(out->world_from_local, world_from_local.m, sizeof out->world_from_local);
}

static void advance_spins(const nook_rows *rows)
{
    nook_spin *spins = rows->columns[0];
    nook_transform *transforms = rows->columns[1];
    const nook_time_step *step = rows->resources[0];
    for (uint32_t i = 0; i < rows->count; i++) {
        nook_rotation_advance(spins[i].rotation, spins[i].angular_velocity, step->seconds);
        place(&spins[i], &transforms[i]);
    }
}

const nook_system nook_advance_spins = {
    .name = "spin.advance_spins",
    .phase = NOOK_PHASE_UPDATE,
    .writes = { NOOK_TYPE(nook_spin), NOOK_TYPE(nook_transform) },
    .resources_read = { NOOK_TYPE(nook_time_step) },
    .run = advance_spins,
};
