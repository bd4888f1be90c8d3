#include "engine/core/vector.h"
#include "modules/ao/ao_internal.h"
#include <math.h>
#include <string.h>

static nook_matrix matrix_of(const double m[16])
{
    nook_matrix r;
    memcpy(r.m, m, sizeof r.m);
    return r;
}

static void set_rows(const nook_matrix *a, float rows[3][4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            rows[row][column] = (float)a->m[column * 4 + row];
    }
}

/** The inverse transpose of A takes normals; with A's inverse at hand it is only a transposition. */
static void set_normal_rows(const nook_matrix *inverse, float rows[3][4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            rows[row][column] = (float)inverse->m[row * 4 + column];
        rows[row][3] = 0.0f;
    }
}

void ao_set_sphere(const nook_matrix *view_from_voxel, const double low[3], const double high[3], ao_gpu_occluder *out)
{
    double middle[3], centre[3], radius = 0.0;
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = 0.5 * (low[axis] + high[axis]);
    nook_matrix_apply_point(view_from_voxel, middle, centre);
    for (int corner = 0; corner < 4; corner++) { /* opposite corners are equally far */
        double half[3] = { high[0] - middle[0], high[1] - middle[1], high[2] - middle[2] };
        half[1] *= corner & 1 ? -1.0 : 1.0;
        half[2] *= corner & 2 ? -1.0 : 1.0;
        nook_matrix_apply_vector(view_from_voxel, half, half);
        double length = nook_vector_length(half);
        radius = length > radius ? length : radius;
    }
    for (int axis = 0; axis < 3; axis++)
        out->centre[axis] = (float)centre[axis];
    out->centre[3] = (float)radius;
}

/** A shader gets floats: entries must be some, and none of its axes may have vanished. */
static int fits_floats(const ao_gpu_occluder *o)
{
    int fits = isfinite(o->centre[3]);
    for (int row = 0; row < 3; row++) {
        const float *m = o->voxel_from_view[row], *n = o->normal_from_view[row];
        float linear = m[0] * m[0] + m[1] * m[1] + m[2] * m[2], normal = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        fits = fits && isnormal(linear) && isnormal(normal) && isfinite(m[3]) && isfinite(o->centre[row]);
    }
    return fits;
}

nook_matrix ao_mesh_from_voxel(const nook_volume_info *info)
{
    nook_matrix scale = nook_matrix_scale(info->voxel_size, info->voxel_size, info->voxel_size);
    nook_matrix origin = nook_matrix_translation(info->origin[0], info->origin[1], info->origin[2]);
    return nook_matrix_multiply(&origin, &scale);
}

bool ao_compose(const nook_volume_info *info, const nook_matrix *view_from_mesh, ao_gpu_occluder *out)
{
    static const double corner[3] = { 0.0, 0.0, 0.0 };
    nook_matrix mesh_from_voxel = ao_mesh_from_voxel(info), voxel_from_view;
    nook_matrix view_from_voxel = nook_matrix_multiply(view_from_mesh, &mesh_from_voxel);
    if (!nook_matrix_inverse_affine(&view_from_voxel, &voxel_from_view))
        return false;
    *out = (ao_gpu_occluder){ .size = { (float)info->width, (float)info->height, (float)info->depth, 0.0f } };
    set_rows(&voxel_from_view, out->voxel_from_view);
    set_normal_rows(&view_from_voxel, out->normal_from_view);
    ao_set_sphere(&view_from_voxel, corner, (double[]){ info->width, info->height, info->depth }, out);
    return fits_floats(out);
}

const nook_volume_info *ao_volume_info(const nook_ao *ao, uint32_t id, uint32_t kinds)
{
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        const atlas_entry *voxels = kinds & NOOK_VOLUME_BIT(kind) ? volume_atlas_find(&ao->atlases[kind], id) : NULL;
        if (voxels)
            return &voxels->info;
    }
    const pool_entry *bricks = kinds & NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL) ? brick_pool_find(&ao->pool, id) : NULL;
    return bricks ? &bricks->info : NULL;
}

/** Where the contents lie on the GPU. */
static void set_place(const nook_ao *ao, uint32_t id, const nook_volume_info *info, ao_gpu_occluder *out)
{
    if (info->kind == NOOK_VOLUME_SURFEL) {
        uint32_t first = brick_pool_find(&ao->pool, id)->bricks.first;
        out->place[0] = (float)(first & 0xffffu);
        out->place[1] = (float)(first >> 16);
        return;
    }
    const atlas_box *box = &volume_atlas_find(&ao->atlases[info->kind], id)->box;
    for (int axis = 0; axis < 3; axis++)
        out->place[axis] = (float)box->origin[axis];
    out->place[3] = (float)info->depth_of_255;
}

uint32_t ao_collect_volumes(nook_ao *ao, const nook_matrix *view_from_world, uint32_t kinds)
{
    uint32_t count = 0;
    ao->line_max = 0;
    for (uint32_t i = 0; i < ao->occluder_count; i++) {
        const nook_ao_occluder *occluder = &ao->occluders[i];
        const nook_volume_info *info = ao_volume_info(ao, occluder->volume.id, kinds);
        if (!info)
            continue;
        nook_matrix world_from_mesh = matrix_of(occluder->world_from_mesh);
        nook_matrix view_from_mesh = nook_matrix_multiply(view_from_world, &world_from_mesh);
        if (!ao_compose(info, &view_from_mesh, &ao->gpu_occluders[count]))
            continue;
        set_place(ao, occluder->volume.id, info, &ao->gpu_occluders[count++]);
        uint32_t line = info->width + info->height + info->depth;
        ao->line_max = line > ao->line_max ? line : ao->line_max;
    }
    return count;
}

uint32_t ao_collect_meshes(nook_ao *ao, const nook_matrix *view_from_world)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ao->mesh_count; i++)
        ao->mesh_views[i] = ao->meshes[i].view;
    for (uint32_t i = 0; i < ao->occluder_count; i++) {
        uint32_t mesh = ao_mesh_index(ao, ao->occluders[i].mesh.id);
        nook_matrix world_from_mesh = matrix_of(ao->occluders[i].world_from_mesh), unused;
        if (mesh == UINT32_MAX || !nook_matrix_inverse_affine(&world_from_mesh, &unused))
            continue;
        ao->instance_occluders[count] = i;
        ao->instances[count++] =
            (nook_ao_mesh_instance){ mesh, nook_matrix_multiply(view_from_world, &world_from_mesh) };
    }
    return count;
}
