/* Which occluders are not as they were, and the boxes in which they lay meanwhile: docs/techniques.md, Reuse. */
#include "modules/ao/ao_internal.h"
#include "modules/ao/reuse_internal.h"
#include <assert.h>
#include <math.h>
#include <string.h>

/* How far beyond a volume's outer corners a ray may pass that meets it, in voxels: lifted ones run up to a slab of sqrt(3)/2 + 1 and
   FILTER_PRECISION beside their line, and the outermost half voxel is empty (shaders/ao/volume_binary.glsl). */
static const double BESIDE = 1.4;

enum { LONG_STILL = UINT8_MAX };

/** Two that a trace cannot tell from each other. */
static bool is_same(const ao_marched *a, const ao_marched *b)
{
    const nook_volume_info *x = &a->info, *y = &b->info;
    return a->volume == b->volume && a->version == b->version && x->content_hash == y->content_hash &&
           x->width == y->width && x->height == y->height && x->depth == y->depth && x->voxel_size == y->voxel_size &&
           memcmp(x->origin, y->origin, sizeof x->origin) == 0 &&
           memcmp(&a->world_from_mesh, &b->world_from_mesh, sizeof a->world_from_mesh) == 0;
}

static uint32_t version_of(const nook_ao *ao, uint32_t id, const nook_volume_info *info)
{
    return info->kind == NOOK_VOLUME_SURFEL ? 0 : volume_atlas_find(&ao->atlases[info->kind], id)->version;
}

/** What is marched now. */
static void remember(nook_ao *ao, ao_marched_list *out)
{
    out->count = 0;
    for (uint32_t i = 0; i < ao->occluder_count; i++) {
        const uint32_t id = ao->occluders[i].volume.id;
        const nook_volume_info *info = ao_volume_info(ao, id, ao->kinds);
        if (!info)
            continue;
        ao_marched *marched = &out->items[out->count++];
        *marched = (ao_marched){ .volume = id, .version = version_of(ao, id, info), .info = *info };
        memcpy(marched->world_from_mesh.m, ao->occluders[i].world_from_mesh, sizeof marched->world_from_mesh.m);
    }
}

/** The list of `ago` records before the one at hand. */
static ao_marched_list *list_of(ao_reuse *reuse, uint32_t ago)
{
    return &reuse->marched[(reuse->number + AO_REUSE_MOST - ago) % AO_REUSE_MOST];
}

static const ao_marched *marched_at(ao_reuse *reuse, uint32_t ago, uint32_t place)
{
    const ao_marched_list *list = list_of(reuse, ago);
    return place < list->count ? &list->items[place] : NULL;
}

/** @param marched  NULL is allowed @return false: it is in no picture, as floats cannot hold it; *out is undefined then */
static bool compose(const nook_matrix *view_from_world, const ao_marched *marched, ao_gpu_occluder *out)
{
    if (!marched)
        return false;
    nook_matrix view_from_mesh = nook_matrix_multiply(view_from_world, &marched->world_from_mesh);
    return ao_compose(&marched->info, &view_from_mesh, out);
}

/* ---- Whatever is near them --------------------------------------------------------------------------------------- */

static void add_whole(ao_reuse *reuse, const nook_matrix *view_from_world, const ao_marched *marched)
{
    if (compose(view_from_world, marched, &reuse->moved[reuse->moved_count]))
        reuse->moved_count++;
}

/* ---- Within a bound ---------------------------------------------------------------------------------------------- */

static void include(ao_box *box, const nook_matrix *from_voxel, const nook_volume_info *info)
{
    const double size[3] = { info->width, info->height, info->depth };
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = corner >> axis & 1 ? size[axis] + BESIDE : -BESIDE;
        nook_matrix_apply_point(from_voxel, point, point);
        for (int axis = 0; axis < 3; axis++) {
            box->low[axis] = fmin(box->low[axis], point[axis]);
            box->high[axis] = fmax(box->high[axis], point[axis]);
        }
    }
}

static nook_matrix world_from_voxel(const ao_marched *marched)
{
    nook_matrix mesh_from_voxel = ao_mesh_from_voxel(&marched->info);
    return nook_matrix_multiply(&marched->world_from_mesh, &mesh_from_voxel);
}

static void set_box(const ao_box *box, bool moved, ao_moved_box *out)
{
    for (int axis = 0; axis < 3; axis++) { /* outwards: a float holds 24 bits */
        out->low[axis] = nextafterf((float)box->low[axis], -INFINITY);
        out->high[axis] = nextafterf((float)box->high[axis], INFINITY);
    }
    out->low[3] = moved ? 1.0f : 0.0f;
    out->high[3] = 0.0f;
}

/**
 * For each age that a value may have: the box around all that stood at the place meanwhile, along the axes of what was there last.
 * @param still  records since the last change; 0: the one at hand changed it
 */
static void add_boxes(ao_reuse *reuse, const nook_matrix *view_from_world, uint32_t place, uint32_t still,
                      uint32_t window)
{
    ao_gpu_occluder *moved = &reuse->moved[reuse->moved_count], unused;
    ao_moved_box *boxes = &reuse->boxes[reuse->moved_count * (window - 1)];
    ao_box box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    nook_matrix voxel_from_world, last_from_voxel = nook_matrix_identity();
    bool found = false;
    for (uint32_t ago = 0; ago < window; ago++) {
        const ao_marched *marched = ago <= reuse->run ? marched_at(reuse, ago, place) : NULL;
        if (compose(view_from_world, marched, found ? &unused : moved)) {
            nook_matrix from_voxel = world_from_voxel(marched);
            if (!found && nook_matrix_inverse_affine(&from_voxel, &voxel_from_world)) {
                last_from_voxel = from_voxel;
                found = true;
            }
            if (found) {
                nook_matrix last_from_then = nook_matrix_multiply(&voxel_from_world, &from_voxel);
                include(&box, &last_from_then, &marched->info);
            }
        }
        if (ago > 0)
            set_box(&box, found && still < ago, &boxes[ago - 1]);
    }
    if (!found)
        return;
    nook_matrix view_from_voxel = nook_matrix_multiply(view_from_world, &last_from_voxel);
    ao_set_sphere(&view_from_voxel, box.low, box.high, moved);
    reuse->moved_count++;
}

/** Longest of the lists that a value may be as old as. */
static uint32_t count_places(ao_reuse *reuse, uint32_t window)
{
    uint32_t count = 0;
    for (uint32_t ago = 0; ago < window && ago <= reuse->run; ago++) {
        uint32_t there = list_of(reuse, ago)->count;
        count = there > count ? there : count;
    }
    return count;
}

void ao_collect_moved(nook_ao *ao, const nook_matrix *view_from_world, bool compare)
{
    ao_reuse *reuse = &ao->reuse;
    const uint32_t window = ao_reuse_window(ao);
    const bool bounded = ao->shared.reuse_error > 0.0f;
    assert(window <= AO_REUSE_MOST);
    remember(ao, list_of(reuse, 0));
    reuse->moved_count = 0;
    reuse->run = compare ? reuse->run + 1 : 0;
    if (!compare)
        memset(reuse->still, LONG_STILL, ao->occluder_max);
    const uint32_t count = compare ? count_places(reuse, window) : 0;
    for (uint32_t i = 0; i < count; i++) {
        const ao_marched *now = marched_at(reuse, 0, i), *before = marched_at(reuse, 1, i);
        bool same = now && before ? is_same(now, before) : now == before;
        reuse->still[i] = same ? (uint8_t)(reuse->still[i] + (reuse->still[i] < LONG_STILL)) : 0;
        if (bounded && reuse->still[i] + 1u < window)
            add_boxes(reuse, view_from_world, i, reuse->still[i], window);
        if (!bounded && !same) {
            add_whole(reuse, view_from_world, now);
            add_whole(reuse, view_from_world, before);
        }
    }
}
