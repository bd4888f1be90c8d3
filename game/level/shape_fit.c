#include "game/level/shape_fit.h"
#include <math.h>

void nook_level_shape_fit(const nook_scene *scene, uint32_t mesh, const double scale[3], nook_level_shape wanted,
                          nook_shape *out)
{
    const nook_mesh *m = &scene->meshes[mesh];
    (void)wanted; /* boxes fit everything, if not well */
    *out = (nook_shape){ .kind = NOOK_SHAPE_BOX, .body_from_shape = nook_pose_identity() };
    for (int k = 0; k < 3; k++) {
        out->half[k] = fmax(0.5 * fabs(scale[k]) * ((double)m->bounds_max[k] - (double)m->bounds_min[k]), 1e-3);
        out->body_from_shape.position[k] = 0.5 * scale[k] * ((double)m->bounds_max[k] + (double)m->bounds_min[k]);
    }
}
