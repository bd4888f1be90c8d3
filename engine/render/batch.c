#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool nook_grow(grow_list *list, size_t size)
{
    if (size <= list->capacity)
        return true;
    size_t capacity = size + size / 2;
    void *items = realloc(list->items, capacity);
    if (items == NULL)
        return false;
    list->items = items;
    list->capacity = capacity;
    return true;
}

nook_box nook_draw_box(const nook_scene *scene, const nook_draw *draw)
{
    const nook_mesh *mesh = &scene->meshes[draw->mesh];
    nook_box box = draw->box;
    if (draw->pose_version == 0) {
        memcpy(box.min, mesh->bounds_min, sizeof box.min);
        memcpy(box.max, mesh->bounds_max, sizeof box.max);
    }
    return box;
}

static void to_cglm(const nook_matrix *a, mat4 out)
{
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++)
            out[column][row] = (float)a->m[column * 4 + row];
    }
}

/**
 * Moves frustum planes outwards by more than their rounding can be, so that it takes nothing out of the picture: that of
 * the planes grows with their distance from the mesh's origin, that of the box's corners with theirs.
 */
static void loosen(vec4 planes[6], vec3 box[2])
{
    float reach = fmaxf(glm_vec3_norm_inf(box[0]), glm_vec3_norm_inf(box[1]));
    for (int i = 0; i < 6; i++)
        planes[i][3] += 1e-6f * (fabsf(planes[i][3]) + reach);
}

/**
 * Whether a box reaches into the frustum, and between which distances it lies. Boxes near its edges may pass.
 *
 * In float, like what the GPU then does with the same matrix: the large numbers have cancelled in view_from_mesh. Planes are
 * taken to the mesh, where the box is upright. Clip space is cglm's but for its depth: of the two planes that it takes from
 * z, w - z is our near plane at any projection with reversed z, and w + z lies behind it.
 */
static bool box_in_view(const nook_box *of_mesh, const nook_matrix *view_from_mesh, const batch_view *view,
                        double *near, double *far)
{
    mat4 from_mesh, clip_from_view, clip_from_mesh;
    vec4 planes[6];
    vec3 box[2], box_view[2];
    memcpy(box[0], of_mesh->min, sizeof box[0]);
    memcpy(box[1], of_mesh->max, sizeof box[1]);
    to_cglm(view_from_mesh, from_mesh);
    to_cglm(&view->clip_from_view, clip_from_view);
    glm_mat4_mul(clip_from_view, from_mesh, clip_from_mesh);
    glm_frustum_planes(clip_from_mesh, planes);
    loosen(planes, box);
    if (!glm_aabb_frustum(box, planes))
        return false;
    glm_aabb_transform(box, from_mesh, box_view);
    *near = -(double)box_view[1][2];
    *far = -(double)box_view[0][2];
    return true;
}

/**
 * The transpose of the inverse, scaled so that it fits a float at any scale of the mesh. Inverted in double: the determinant
 * of a scale of 1e-16 is not a float, and a mesh 1e5 times flatter than wide would lose 5 of a float's 7 digits.
 */
static bool normal_matrix(const nook_matrix *world_from_mesh, float out[3][4])
{
    nook_matrix inverse;
    if (!nook_matrix_inverse_affine(world_from_mesh, &inverse))
        return false;
    double largest = 0.0;
    for (int i = 0; i < 12; i++)
        largest = i % 4 == 3 ? largest : fmax(largest, fabs(inverse.m[i]));
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            out[column][row] = (float)(inverse.m[row * 4 + column] / largest);
        out[column][3] = nook_matrix_determinant3(world_from_mesh) < 0.0 ? -1.0f : 1.0f;
    }
    return true;
}

/** One draw as an instance. @return false when it is left out */
static bool make_instance(const nook_scene *scene, const nook_draw *draw, const batch_view *view, draw_set *set,
                          instance_data *out, double *out_order)
{
    const nook_box box = nook_draw_box(scene, draw);
    if (scene->meshes[draw->mesh].primitive_count == 0 || !(box.min[0] <= box.max[0]))
        return false;
    nook_matrix view_from_mesh = nook_matrix_multiply(&view->view_from_world, &draw->world_from_local);
    double near = 0.0, far = 0.0;
    if (view->cull && !box_in_view(&box, &view_from_mesh, view, &near, &far))
        return false;
    if (!normal_matrix(&draw->world_from_local, out->world_normal_from_mesh))
        return false;
    *out_order = view->by_end ? far : near;
    nook_matrix_to_float(&view_from_mesh, out->view_from_mesh);
    set->near_distance = fmin(set->near_distance, fmax(near, view->z_near));
    set->far_distance = fmax(set->far_distance, far);
    return true;
}

static uint32_t bucket_of(const nook_draw *draw)
{
    return draw->mesh * 2 + (nook_matrix_determinant3(&draw->world_from_local) < 0.0 ? 1 : 0);
}

/** From counts per bucket to the place where each bucket starts, and a batch for each that is not empty. */
static void make_batches(draw_set *set, uint32_t bucket_count)
{
    uint32_t *counts = set->counts.items, first = 0;
    batch *batches = set->batches.items;
    set->batch_count = 0;
    for (uint32_t i = 0; i < bucket_count; i++) {
        uint32_t count = counts[i];
        counts[i] = first;
        if (count > 0)
            batches[set->batch_count++] = (batch){ i / 2, first, count, i % 2 == 1, INFINITY };
        first += count;
    }
    set->instance_count = first;
}

static int compare_orders(double a, double b)
{
    return (a > b) - (a < b);
}

/** Equal distances keep their order, so that a picture does not depend on how the library sorts. */
static int compare_kept(const void *a, const void *b)
{
    const kept_draw *x = a, *y = b;
    int order = compare_orders(x->order, y->order);
    return order != 0 ? order : (x->draw > y->draw) - (x->draw < y->draw);
}

static int compare_batches(const void *a, const void *b)
{
    const batch *x = a, *y = b;
    int order = compare_orders(x->order, y->order);
    return order != 0 ? order : (x->first_instance > y->first_instance) - (x->first_instance < y->first_instance);
}

/** Puts each instance into its bucket's place, the nearest ones first, and then the batches with the nearest ones first. */
static void place_instances(draw_set *set, uint32_t kept_count, uint32_t bucket_count)
{
    const instance_data *unsorted = set->unsorted.items;
    instance_data *instances = set->instances.items;
    kept_draw *kept = set->kept.items;
    uint32_t *counts = set->counts.items, *draws = set->draws.items;
    batch *batches = set->batches.items;
    qsort(kept, kept_count, sizeof *kept, compare_kept);
    make_batches(set, bucket_count);
    for (uint32_t i = 0; i < kept_count; i++) {
        uint32_t place = counts[kept[i].bucket]++;
        instances[place] = unsorted[kept[i].draw];
        draws[place] = kept[i].draw;
    }
    for (uint32_t i = 0, at = 0; i < bucket_count; i++) { /* counts[i] is where bucket i ends now */
        if (at < set->batch_count && batches[at].first_instance < counts[i])
            counts[i] = at++;
    }
    for (uint32_t i = kept_count; i-- > 0;)
        batches[counts[kept[i].bucket]].order = kept[i].order;
    qsort(batches, set->batch_count, sizeof *batches, compare_batches);
}

static nook_result upload_instances(nook_gpu *gpu, draw_set *set)
{
    size_t size = set->instance_count * sizeof(instance_data);
    if (set->buffer.size < size) {
        nook_buffer bigger;
        nook_result result = nook_buffer_create(gpu, NULL, size + size / 2, &bigger);
        if (result != NOOK_OK)
            return result;
        nook_buffer_destroy(gpu, &set->buffer);
        set->buffer = bigger;
    }
    if (size > 0)
        nook_buffer_update(gpu, set->buffer, 0, set->instances.items, size);
    return NOOK_OK;
}

/* A counting sort: one walk counts the draws of each mesh and handedness, a second puts each in its place. */
nook_result nook_batch(nook_gpu *gpu, const nook_frame *frame, const batch_view *view, draw_set *set)
{
    const nook_scene *scene = frame->scene->scene;
    uint32_t bucket_count = scene->mesh_count * 2, kept_count = 0;
    size_t count = frame->draw_count;
    if (!nook_grow(&set->unsorted, count * sizeof(instance_data)) ||
        !nook_grow(&set->instances, count * sizeof(instance_data)) ||
        !nook_grow(&set->draws, count * sizeof(uint32_t)) || !nook_grow(&set->kept, count * sizeof(kept_draw)) ||
        !nook_grow(&set->counts, bucket_count * sizeof(uint32_t)) || !nook_grow(&set->batches, count * sizeof(batch)))
        return nook_fail(NOOK_E_MEMORY, "%zu draws: no memory for their instances", count);

    instance_data *unsorted = set->unsorted.items;
    kept_draw *kept = set->kept.items;
    uint32_t *counts = set->counts.items;
    set->near_distance = INFINITY, set->far_distance = -INFINITY;
    for (uint32_t i = 0; i < bucket_count; i++)
        counts[i] = 0;
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        const nook_draw *draw = &frame->draws[i];
        double order = 0.0;
        if (!make_instance(scene, draw, view, set, &unsorted[i], &order))
            continue;
        kept[kept_count] = (kept_draw){ i, bucket_of(draw), order };
        counts[kept[kept_count++].bucket]++;
    }
    place_instances(set, kept_count, bucket_count);
    return upload_instances(gpu, set);
}

void nook_draw_set_destroy(nook_gpu *gpu, draw_set *set)
{
    nook_buffer_destroy(gpu, &set->buffer);
    free(set->unsorted.items);
    free(set->instances.items);
    free(set->draws.items);
    free(set->kept.items);
    free(set->counts.items);
    free(set->batches.items);
    *set = (draw_set){ 0 };
}
