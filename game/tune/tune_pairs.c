#include "game/tune/tune_pairs.h"
#include "engine/core/vector.h"
#include "game/tune/trial.h"
#include <assert.h>
#include <math.h>
#include <stdbool.h>

enum { MOST = 2 * NOOK_TUNE_VIEWS_MAX };

/* Where a view is from and where it looks. */
typedef struct pose {
    double eye[3], forward[3];
} pose;

static pose pose_of(const nook_camera *camera)
{
    const double origin[3] = { 0.0, 0.0, 0.0 }, ahead[3] = { 0.0, 0.0, -1.0 };
    nook_matrix world_from_view;
    pose p = { .eye = { 0.0 } };
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, p.eye);
    nook_matrix_apply_vector(&world_from_view, ahead, p.forward);
    return p;
}

/* A quarter of the diagonal, or a right angle, are as far as one another; heights count most: other floors are other worlds. */
static double distance_between(const pose *a, const pose *b, double diagonal)
{
    double moved[3], turned = acos(fmax(-1.0, fmin(1.0, nook_vector_dot(a->forward, b->forward))));
    for (int i = 0; i < 3; i++)
        moved[i] = (a->eye[i] - b->eye[i]) / (0.25 * diagonal) * (i == 1 ? 2.0 : 1.0);
    return hypot(nook_vector_length(moved), turned / 1.5707963267948966);
}

void nook_tune_pair_views(const nook_camera *views, uint32_t count, double diagonal, nook_camera *out_first,
                          nook_camera *out_second)
{
    pose poses[MOST];
    bool taken[MOST] = { false };
    uint32_t pairs = 0;
    assert(count <= MOST && count % 2 == 0);
    for (uint32_t i = 0; i < count; i++)
        poses[i] = pose_of(&views[i]);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t nearest = i;
        for (uint32_t k = i + 1; k < count && !taken[i]; k++) {
            if (!taken[k] && (nearest == i || distance_between(&poses[i], &poses[k], diagonal) <
                                                  distance_between(&poses[i], &poses[nearest], diagonal)))
                nearest = k;
        }
        if (nearest == i)
            continue;
        taken[i] = taken[nearest] = true;
        out_first[pairs] = views[pairs % 2 ? nearest : i];
        out_second[pairs] = views[pairs % 2 ? i : nearest];
        pairs++;
    }
}
