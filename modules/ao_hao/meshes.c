#include "engine/core/log.h"
#include "modules/ao_hao/meshes_internal.h"
#include <stdlib.h>

static void release_mesh(hao_mesh *mesh, nook_gpu *gpu)
{
    nook_buffer_destroy(gpu, &mesh->vertices);
    nook_buffer_destroy(gpu, &mesh->indices);
}

void hao_meshes_release(hao_meshes *meshes, nook_gpu *gpu)
{
    for (uint32_t i = 0; i < meshes->count; i++)
        release_mesh(&meshes->items[i], gpu);
    free(meshes->items);
    *meshes = (hao_meshes){ 0 };
}

static bool is_there(const hao_meshes *meshes, const nook_ao_pass *pass)
{
    if (meshes->count != pass->mesh_count)
        return false;
    for (uint32_t i = 0; i < meshes->count; i++)
        if (meshes->items[i].id != pass->meshes[i].id)
            return false;
    return true;
}

static hao_box box_of(const nook_ao_mesh_view *view)
{
    hao_box box = hao_nothing;
    for (uint32_t i = 0; i < view->solid_index_count; i++) {
        const float *p = view->positions + 3 * (size_t)view->indices[i];
        hao_box_add_point(&box, (const double[3]){ (double)p[0], (double)p[1], (double)p[2] });
    }
    return box;
}

static nook_result copy_mesh(nook_gpu *gpu, const nook_ao_mesh_view *view, hao_mesh *out)
{
    *out = (hao_mesh){ .id = view->id, .box = box_of(view) };
    if (view->solid_index_count == 0)
        return NOOK_OK;
    nook_result result = nook_buffer_create(gpu, view->positions,
                                            (size_t)view->vertex_count * 3 * sizeof *view->positions, &out->vertices);
    if (result == NOOK_OK)
        result = nook_buffer_create(gpu, view->indices, (size_t)view->solid_index_count * sizeof *view->indices,
                                    &out->indices);
    if (result == NOOK_OK)
        out->index_count = view->solid_index_count;
    else
        release_mesh(out, gpu);
    return result;
}

/* Both lists ascend by id, and an id is never given twice: they are merged. */
static nook_result merge(hao_meshes *from, const nook_ao_pass *pass, hao_meshes *to)
{
    uint32_t old = 0;
    for (; to->count < pass->mesh_count; to->count++) {
        const nook_ao_mesh_view *view = &pass->meshes[to->count];
        while (old < from->count && from->items[old].id < view->id)
            old++;
        if (old < from->count && from->items[old].id == view->id) {
            to->items[to->count] = from->items[old];
            from->items[old].vertices = from->items[old].indices = (nook_buffer){ 0 }; /* they have moved */
            continue;
        }
        nook_result result = copy_mesh(pass->gpu, view, &to->items[to->count]);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result hao_meshes_update(hao_meshes *meshes, const nook_ao_pass *pass)
{
    if (is_there(meshes, pass))
        return NOOK_OK;
    nook_result result = NOOK_OK;
    hao_meshes made = { .items = malloc((pass->mesh_count ? pass->mesh_count : 1) * sizeof *made.items) };
    if (made.items)
        result = merge(meshes, pass, &made);
    else
        result = nook_fail(NOOK_E_MEMORY, "hao: no memory for %u meshes", pass->mesh_count);
    hao_meshes_release(meshes, pass->gpu); /* what has not moved */
    if (result == NOOK_OK)
        *meshes = made;
    else
        hao_meshes_release(&made, pass->gpu);
    return result;
}
