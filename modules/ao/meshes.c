#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static nook_result check_mesh(const float *positions, uint32_t vertex_count, const uint32_t *indices,
                              uint32_t index_count)
{
    if (index_count % 3 != 0)
        return nook_fail(NOOK_E_ARG, "mesh: %u indices are not whole triangles", index_count);
    for (uint32_t i = 0; i < index_count; i++) {
        if (indices[i] >= vertex_count)
            return nook_fail(NOOK_E_ARG, "mesh: index %u of %u vertices", indices[i], vertex_count);
    }
    for (size_t i = 0; i < (size_t)vertex_count * 3; i++) {
        if (!isfinite(positions[i]))
            return nook_fail(NOOK_E_ARG, "mesh: vertex %zu is not finite", i / 3);
    }
    return NOOK_OK;
}

/** Copies `size` bytes; never NULL for 0 bytes. */
static void *copy_of(const void *bytes, size_t size)
{
    void *copy = malloc(size ? size : 1);
    if (copy && size)
        memcpy(copy, bytes, size);
    return copy;
}

static int reserve_mesh(nook_ao *ao)
{
    if (ao->mesh_count < ao->mesh_capacity)
        return 1;
    uint32_t capacity = ao->mesh_capacity ? ao->mesh_capacity * 2 : 16;
    ao_mesh *meshes = realloc(ao->meshes, capacity * sizeof *meshes);
    if (meshes)
        ao->meshes = meshes;
    nook_ao_mesh_view *views = realloc(ao->mesh_views, capacity * sizeof *views);
    if (views)
        ao->mesh_views = views;
    if (!meshes || !views)
        return 0;
    ao->mesh_capacity = capacity;
    return 1;
}

/** Sets how many indices stand before those of blended parts. @return NOOK_E_ARG something else stands behind them */
static nook_result count_solid(const nook_alphas *alphas, uint32_t index_count, uint32_t *out_count)
{
    size_t solid = index_count, next = index_count;
    if (!nook_alphas_are_sound(alphas, index_count))
        return nook_fail(NOOK_E_ARG, "mesh: parts with alpha are not those of %u indices, in order and apart",
                         index_count);
    for (uint32_t i = 0; alphas && i < alphas->part_count; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        bool blended = !part->masked && part->index_count > 0;
        if (blended && solid == index_count)
            solid = next = part->first_index;
        if (blended ? part->first_index != next : solid < index_count && part->index_count > 0)
            break;
        next = blended ? next + part->index_count : next;
    }
    if (next != index_count)
        return nook_fail(NOOK_E_ARG, "mesh: blended parts must stand behind all others");
    *out_count = (uint32_t)solid;
    return NOOK_OK;
}

static void free_mesh(ao_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
    ao_mesh_alphas_destroy(mesh->alphas);
    free(mesh->medium);
}

nook_result nook_ao_add_mesh_with_alphas(nook_ao *ao, const float *positions, uint32_t vertex_count,
                                         const uint32_t *indices, uint32_t index_count, const nook_alphas *alphas,
                                         nook_ao_mesh *out_mesh)
{
    uint32_t solid = 0;
    bool opaque = !alphas || alphas->part_count == 0;
    nook_result result = check_mesh(positions, vertex_count, indices, index_count);
    if (result == NOOK_OK)
        result = count_solid(alphas, index_count, &solid);
    if (result != NOOK_OK)
        return result;
    ao_mesh mesh = { .positions = copy_of(positions, (size_t)vertex_count * 3 * sizeof *positions),
                     .indices = copy_of(indices, (size_t)index_count * sizeof *indices),
                     .alphas = opaque ? NULL : ao_mesh_alphas_create(alphas, vertex_count) };
    if (!mesh.positions || !mesh.indices || (!opaque && !mesh.alphas) || !reserve_mesh(ao)) {
        free_mesh(&mesh);
        return nook_fail(NOOK_E_MEMORY, "mesh: no memory for %u triangles", index_count / 3);
    }
    mesh.view = (nook_ao_mesh_view){ .positions = mesh.positions,
                                     .indices = mesh.indices,
                                     .vertex_count = vertex_count,
                                     .index_count = index_count,
                                     .solid_index_count = solid,
                                     .alphas = ao_mesh_alphas_get(mesh.alphas),
                                     .id = ao->next_mesh_id++ };
    ao->meshes[ao->mesh_count++] = mesh;
    out_mesh->id = mesh.view.id;
    return NOOK_OK;
}

nook_result nook_ao_add_mesh(nook_ao *ao, const float *positions, uint32_t vertex_count, const uint32_t *indices,
                             uint32_t index_count, nook_ao_mesh *out_mesh)
{
    return nook_ao_add_mesh_with_alphas(ao, positions, vertex_count, indices, index_count, NULL, out_mesh);
}

/* ---- Media ------------------------------------------------------------------------------------------------------ */

static nook_result check_medium(const nook_medium *medium)
{
    for (int axis = 0; axis < 3; axis++) {
        double side = medium->spacing[axis] * medium->size[axis];
        if (medium->size[axis] == 0 || medium->size[axis] > NOOK_MEDIUM_SIDE_MAX ||
            !(medium->spacing[axis] >= NOOK_MEDIUM_SPACING_MIN) || !(side <= NOOK_MEDIUM_LENGTH_MAX))
            return nook_fail(NOOK_E_ARG, "medium: %u cells of %g m", medium->size[axis], medium->spacing[axis]);
    }
    uint64_t count = nook_medium_cells(medium);
    if (count > NOOK_MEDIUM_CELLS_MAX)
        return nook_fail(NOOK_E_ARG, "medium: %llu cells; up to %llu", (unsigned long long)count,
                         NOOK_MEDIUM_CELLS_MAX);
    for (uint64_t i = 0; i < count; i++)
        if (!isfinite(medium->extinction[i]) || medium->extinction[i] < 0.0f)
            return nook_fail(NOOK_E_ARG, "medium: the extinction of cell %llu is %g", (unsigned long long)i,
                             (double)medium->extinction[i]);
    return NOOK_OK;
}

nook_result nook_ao_add_medium(nook_ao *ao, const nook_medium *medium, nook_ao_mesh *out_mesh)
{
    nook_result result = check_medium(medium);
    if (result != NOOK_OK)
        return result;
    size_t size = (size_t)nook_medium_cells(medium) * sizeof *medium->extinction;
    nook_medium *copy = malloc(sizeof *copy + size);
    if (!copy || !reserve_mesh(ao)) {
        free(copy);
        return nook_fail(NOOK_E_MEMORY, "medium: no memory for %zu bytes", size);
    }
    memcpy(copy + 1, medium->extinction, size);
    *copy = *medium;
    copy->extinction = (const float *)(copy + 1);
    ao_mesh mesh = { .view = { .medium = copy, .id = ao->next_mesh_id++ }, .medium = copy };
    ao->meshes[ao->mesh_count++] = mesh;
    out_mesh->id = mesh.view.id;
    return NOOK_OK;
}

/** Meshes stand in the order of their ids: they are added at the end, and removal keeps the order. */
uint32_t ao_mesh_index(const nook_ao *ao, uint32_t id)
{
    uint32_t first = 0, end = ao->mesh_count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (ao->meshes[middle].view.id < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first < ao->mesh_count && ao->meshes[first].view.id == id ? first : UINT32_MAX;
}

void nook_ao_remove_mesh(nook_ao *ao, nook_ao_mesh mesh)
{
    uint32_t i = ao_mesh_index(ao, mesh.id);
    if (i == UINT32_MAX)
        return;
    free_mesh(&ao->meshes[i]);
    memmove(ao->meshes + i, ao->meshes + i + 1, (--ao->mesh_count - i) * sizeof *ao->meshes);
}

void ao_meshes_release(nook_ao *ao)
{
    for (uint32_t i = 0; i < ao->mesh_count; i++)
        free_mesh(&ao->meshes[i]);
    free(ao->meshes);
    free(ao->mesh_views);
    ao->meshes = NULL;
    ao->mesh_views = NULL;
}
