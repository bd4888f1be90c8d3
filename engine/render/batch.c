#include "engine/core/log.h"
#include "engine/render/internal.h"
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

/** Corner i of a mesh's box. */
static void box_corner(const nook_mesh *mesh, int i, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (i >> k & 1) ? mesh->bounds_max[k] : mesh->bounds_min[k];
}

/** Whether a box reaches into the frustum, and between which distances it lies. Boxes near its edges may pass. */
static bool box_in_view(const nook_mesh *mesh, const nook_matrix *view_from_mesh, const batch_view *view, double *near,
                        double *far)
{
    int outside[5] = { 0 };
    *near = INFINITY, *far = -INFINITY;
    for (int i = 0; i < 8; i++) {
        double p[3];
        box_corner(mesh, i, p);
        nook_matrix_apply_point(view_from_mesh, p, p);
        double distance = -p[2];
        outside[0] += distance < view->z_near;
        outside[1] += p[0] > distance * view->ray_scale[0];
        outside[2] += -p[0] > distance * view->ray_scale[0];
        outside[3] += p[1] > distance * view->ray_scale[1];
        outside[4] += -p[1] > distance * view->ray_scale[1];
        *near = fmin(*near, distance);
        *far = fmax(*far, distance);
    }
    for (int i = 0; i < 5; i++) {
        if (outside[i] == 8)
            return false;
    }
    return true;
}

/** The transpose of the inverse, scaled so that it fits a float at any scale of the mesh. */
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
static bool make_instance(const nook_mesh *mesh, const nook_draw *draw, const batch_view *view, draw_set *set,
                          instance_data *out)
{
    if (mesh->primitive_count == 0 || !(mesh->bounds_min[0] <= mesh->bounds_max[0]))
        return false;
    nook_matrix view_from_mesh = nook_matrix_multiply(&view->view_from_world, &draw->world_from_local);
    double near = 0.0, far = 0.0;
    if (view->cull && !box_in_view(mesh, &view_from_mesh, view, &near, &far))
        return false;
    if (!normal_matrix(&draw->world_from_local, out->world_normal_from_mesh))
        return false;
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
            batches[set->batch_count++] = (batch){ i / 2, first, count, i % 2 == 1 };
        first += count;
    }
    set->instance_count = first;
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
    uint32_t bucket_count = scene->mesh_count * 2;
    size_t count = frame->draw_count;
    if (!nook_grow(&set->unsorted, count * sizeof(instance_data)) ||
        !nook_grow(&set->instances, count * sizeof(instance_data)) ||
        !nook_grow(&set->order, count * sizeof(uint32_t)) ||
        !nook_grow(&set->counts, bucket_count * sizeof(uint32_t)) || !nook_grow(&set->batches, count * sizeof(batch)))
        return nook_fail(NOOK_E_MEMORY, "%zu draws: no memory for their instances", count);

    instance_data *unsorted = set->unsorted.items, *instances = set->instances.items;
    uint32_t *buckets = set->order.items, *counts = set->counts.items;
    set->near_distance = INFINITY, set->far_distance = -INFINITY;
    for (uint32_t i = 0; i < bucket_count; i++)
        counts[i] = 0;
    for (size_t i = 0; i < count; i++) {
        const nook_draw *draw = &frame->draws[i];
        bool kept = make_instance(&scene->meshes[draw->mesh], draw, view, set, &unsorted[i]);
        buckets[i] = kept ? bucket_of(draw) : NOOK_NONE;
        if (kept)
            counts[buckets[i]]++;
    }
    make_batches(set, bucket_count);
    for (size_t i = 0; i < count; i++) {
        if (buckets[i] != NOOK_NONE)
            instances[counts[buckets[i]]++] = unsorted[i];
    }
    return upload_instances(gpu, set);
}

void nook_draw_set_destroy(nook_gpu *gpu, draw_set *set)
{
    nook_buffer_destroy(gpu, &set->buffer);
    free(set->unsorted.items);
    free(set->instances.items);
    free(set->order.items);
    free(set->counts.items);
    free(set->batches.items);
    *set = (draw_set){ 0 };
}
