#include "game/extremes/groups.h"

/* clang-format off */
static const nook_extreme_group *const groups[] = {
    &nook_extreme_space,
    &nook_extreme_transforms,
    &nook_extreme_reach,
    &nook_extreme_surfaces,
    &nook_extreme_buffers,
    &nook_extreme_sampling,
    &nook_extreme_volumes,
    &nook_extreme_occluders,
    &nook_extreme_filter,
    &nook_extreme_triangles,
    &nook_extreme_memory,
    &nook_extreme_spinning,
};
/* clang-format on */

const nook_extreme_group *const *nook_extreme_groups(size_t *out_count)
{
    *out_count = NOOK_COUNT(groups);
    return groups;
}
