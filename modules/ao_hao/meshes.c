#include "engine/core/log.h"
#include "modules/ao_hao/meshes_internal.h"
#include <assert.h>
#include <stdlib.h>

static void release_mesh(hao_mesh *mesh, nook_gpu *gpu)
{
    nook_buffer_destroy(gpu, &mesh->vertices);
    nook_buffer_destroy(gpu, &mesh->indices);
    nook_buffer_destroy(gpu, &mesh->uvs);
    for (uint32_t i = 0; i < mesh->texture_count; i++)
        nook_texture_destroy(gpu, &mesh->textures[i]);
    free(mesh->textures);
    free(mesh->ranges);
    *mesh = (hao_mesh){ .id = mesh->id };
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

/* ---- Masks -------------------------------------------------------------------------------------------------------- */

/* A byte a texel, read as alpha. */
static nook_result copy_texture(nook_gpu *gpu, const nook_alpha_part *part, nook_texture *out)
{
    const size_t size = (size_t)part->width * part->height;
    uint8_t *texels = malloc(size), *next = texels;
    if (!texels)
        return nook_fail(NOOK_E_MEMORY, "hao: no memory for a mask of %ux%u texels", part->width, part->height);
    for (uint32_t y = 0; y < part->height; y++)
        for (uint32_t x = 0; x < part->width; x++)
            *next++ = nook_alpha_texel(part, x, y);
    nook_result result = nook_texture_create_2d(gpu, GL_R8, part->width, part->height, GL_NEAREST, out);
    if (result == NOOK_OK) {
        nook_texture_write(gpu, *out, GL_RED, GL_UNSIGNED_BYTE, texels, size);
        gpu->gl->TextureParameteri(out->id, GL_TEXTURE_SWIZZLE_A, GL_RED);
    }
    free(texels);
    return result;
}

static bool same_texture(const nook_alpha_part *a, const nook_alpha_part *b)
{
    return a->texels == b->texels && a->width == b->width && a->height == b->height && a->texel_size == b->texel_size;
}

/* @param texture_of  of each part before this one: 1 + which of the mesh's textures it has; 0: none */
static nook_result find_texture(nook_gpu *gpu, const nook_alphas *alphas, uint32_t part, uint32_t *texture_of,
                                hao_mesh *mesh)
{
    for (uint32_t i = 0; i < part && !texture_of[part]; i++)
        if (texture_of[i] && same_texture(&alphas->parts[i], &alphas->parts[part]))
            texture_of[part] = texture_of[i];
    if (texture_of[part])
        return NOOK_OK;
    nook_result result = copy_texture(gpu, &alphas->parts[part], &mesh->textures[mesh->texture_count]);
    if (result == NOOK_OK)
        texture_of[part] = ++mesh->texture_count;
    return result;
}

/* Neighbours that are all there are one. */
static void add_range(hao_mesh *mesh, size_t first, size_t end, nook_texture *texture, const nook_alpha_part *part)
{
    assert(mesh->ranges); /* room for all of them */
    hao_range *last = mesh->range_count ? &mesh->ranges[mesh->range_count - 1] : NULL;
    if (first == end)
        return;
    if (last && !last->texture && !texture && last->first_index + last->index_count == first)
        last->index_count += (uint32_t)(end - first);
    else
        mesh->ranges[mesh->range_count++] = (hao_range){ (uint32_t)first, (uint32_t)(end - first), texture,
                                                         texture ? part->alpha : 1.0f, texture ? part->cutoff : 0.0f };
}

/* @param texture_of  of each part, 0 */
static nook_result make_ranges(nook_gpu *gpu, const nook_ao_mesh_view *view, uint32_t *texture_of, hao_mesh *mesh)
{
    const nook_alphas *alphas = view->alphas;
    nook_result result = NOOK_OK;
    size_t next = 0;
    for (uint32_t i = 0; alphas && i < alphas->part_count && result == NOOK_OK; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        if (!part->masked || part->index_count == 0)
            continue; /* blended ones stand behind the solid ones */
        add_range(mesh, next, part->first_index, NULL, NULL);
        next = part->first_index + part->index_count;
        if (part->texels)
            result = find_texture(gpu, alphas, i, texture_of, mesh);
        if (part->texels || nook_alpha_of_texel(part, UINT8_MAX) > 0.0)
            add_range(mesh, part->first_index, next, texture_of[i] ? &mesh->textures[texture_of[i] - 1] : NULL, part);
    }
    add_range(mesh, next, view->solid_index_count, NULL, NULL);
    return result;
}

static nook_result copy_masks(nook_gpu *gpu, const nook_ao_mesh_view *view, hao_mesh *mesh)
{
    const size_t parts = view->alphas ? view->alphas->part_count : 0;
    uint32_t *texture_of = calloc(parts + 1, sizeof *texture_of);
    mesh->textures = calloc(parts + 1, sizeof *mesh->textures);
    mesh->ranges = calloc(2 * parts + 1, sizeof *mesh->ranges);
    nook_result result = texture_of && mesh->textures && mesh->ranges
                             ? make_ranges(gpu, view, texture_of, mesh)
                             : nook_fail(NOOK_E_MEMORY, "hao: no memory for %zu masks", parts);
    if (result == NOOK_OK && view->alphas && mesh->texture_count > 0)
        result = nook_buffer_create(gpu, view->alphas->uvs, (size_t)view->vertex_count * 2 * sizeof(float), &mesh->uvs);
    free(texture_of);
    return result;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------------- */

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
        result = copy_masks(gpu, view, out);
    if (result != NOOK_OK)
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
            from->items[old] = (hao_mesh){ .id = view->id }; /* it has moved */
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
