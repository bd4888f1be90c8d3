#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/reuse_internal.h"
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    TILE_SIZE = 8,
    BINDING_BLOCK = 1,
    BINDING_OCCLUDERS = 3,
    BINDING_BEFORE = 4, /**< Depth, normal, visibility and ages of the last trace: 4 to 7. */
    BINDING_AGES = 1,
    BINDING_CARRIED = 3,
    BINDING_MEAN_CARRIED = 4, /**< Of shaders/ao/accumulate.comp.glsl, textures. */
    BINDING_MEAN_AGES = 7
};

/** Block Reuse of shaders/ao/reuse.comp.glsl, std140. */
typedef struct reuse_block {
    float before_from_view[3][4]; /**< Rows. */
    float view_from_before[3][4];
    float ray_scale[2], ray_offset[2];
    int32_t period, turn, has_before, stands;
    int32_t moved_count;
    float error;
    int32_t window, most;
} reuse_block;

_Static_assert(offsetof(reuse_block, ray_scale) == 96 && sizeof(reuse_block) == 144, "std140 places ray_scale at 96");

/** Head of the buffer of shaders/ao/tiles.glsl; its tiles follow. */
typedef struct tiles_head {
    uint32_t groups[3], count;
} tiles_head;

/** struct Tile. */
typedef struct tile_record {
    uint32_t first[2], bits[2];
    float depths[2];
    uint32_t padding[2];
} tile_record;

static bool is_whole(const ao_region *region, const nook_ao_pass *pass)
{
    return region->begin[0] == 0 && region->begin[1] == 0 && (uint32_t)region->end[0] == pass->width &&
           (uint32_t)region->end[1] == pass->height;
}

static bool accumulates(const nook_ao *ao)
{
    return ao->shared.accumulate > 1;
}

/** What is traced in its turn has lasted for ao.reuse records as a part of a mean. */
uint32_t ao_reuse_window(const nook_ao *ao)
{
    return (uint32_t)ao->shared.reuse + accumulates(ao);
}

bool ao_reuse_is_wanted(const nook_ao *ao, const ao_slot *slot)
{
    const nook_ao_technique *technique = slot->technique;
    return (ao->shared.reuse > 1 || accumulates(ao)) && technique->is_reusable && technique->is_reusable(slot->params);
}

/* ---- What is kept ------------------------------------------------------------------------------------------------ */

static void release_textures(ao_reuse *reuse, nook_gpu *gpu)
{
    nook_texture_destroy(gpu, &reuse->depth);
    nook_texture_destroy(gpu, &reuse->normal);
    nook_texture_destroy(gpu, &reuse->visibility);
    for (int i = 0; i < 2; i++)
        nook_texture_destroy(gpu, &reuse->ages[i]);
    nook_texture_destroy(gpu, &reuse->carried);
    nook_buffer_destroy(gpu, &reuse->tiles);
}

void ao_reuse_release(nook_ao *ao)
{
    ao_reuse *reuse = &ao->reuse;
    release_textures(reuse, ao->gpu);
    nook_texture_destroy(ao->gpu, &reuse->moved_texture);
    nook_buffer_destroy(ao->gpu, &reuse->moved_buffer);
    nook_buffer_destroy(ao->gpu, &reuse->block);
    for (int i = 0; i < AO_REUSE_MOST; i++)
        free(reuse->marched[i].items);
    free(reuse->still);
    free(reuse->moved);
    free(reuse->boxes);
    free(reuse->settings);
    *reuse = (ao_reuse){ .holds = false };
}

/** Room that does not depend on the picture, made once. */
static nook_result fit_lists(nook_ao *ao)
{
    ao_reuse *reuse = &ao->reuse;
    const size_t moved_max = 2 * (size_t)ao->occluder_max, box_max = ao->occluder_max * (size_t)(AO_REUSE_MOST - 1);
    /* As it is and as it was; or, with ao.reuse_error, once and with its boxes. */
    const size_t twice = moved_max * sizeof *reuse->moved,
                 boxed = ao->occluder_max * sizeof *reuse->moved + box_max * sizeof *reuse->boxes;
    const size_t most_bytes = twice > boxed ? twice : boxed;
    if (reuse->moved_texture.id)
        return NOOK_OK;
    ao_reuse_release(ao); /* of a try that failed */
    reuse->still = calloc(ao->occluder_max, sizeof *reuse->still);
    reuse->moved = calloc(moved_max, sizeof *reuse->moved);
    reuse->boxes = calloc(box_max, sizeof *reuse->boxes);
    bool has_room = reuse->still && reuse->moved && reuse->boxes;
    for (int i = 0; i < AO_REUSE_MOST && has_room; i++) {
        reuse->marched[i].items = calloc(ao->occluder_max, sizeof *reuse->marched[i].items);
        has_room = reuse->marched[i].items != NULL;
    }
    if (!has_room)
        return nook_fail(NOOK_E_MEMORY, "ao.reuse: no memory for %u occluders", ao->occluder_max);
    nook_result result = nook_buffer_create(ao->gpu, NULL, sizeof(reuse_block), &reuse->block);
    if (result == NOOK_OK)
        result = nook_buffer_create(ao->gpu, NULL, most_bytes, &reuse->moved_buffer);
    if (result == NOOK_OK)
        result = nook_texture_create_buffer(ao->gpu, GL_RGBA32F, reuse->moved_buffer, &reuse->moved_texture);
    return result;
}

static nook_result fit_carried(nook_ao *ao)
{
    ao_reuse *reuse = &ao->reuse;
    if (!accumulates(ao) || reuse->carried.id)
        return NOOK_OK;
    return nook_texture_create_2d(ao->gpu, GL_R32F, reuse->depth.width, reuse->depth.height, GL_NEAREST,
                                  &reuse->carried);
}

static nook_result fit_textures(nook_ao *ao, const nook_ao_pass *pass)
{
    ao_reuse *reuse = &ao->reuse;
    nook_gpu *gpu = ao->gpu;
    const uint32_t width = pass->width, height = pass->height;
    if (reuse->tiles.id && reuse->depth.width == width && reuse->depth.height == height)
        return fit_carried(ao);
    release_textures(reuse, gpu);
    reuse->holds = false;
    nook_result result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &reuse->depth);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_RG16, width, height, GL_NEAREST, &reuse->normal);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_R32F, width, height, GL_NEAREST, &reuse->visibility);
    for (int i = 0; i < 2 && result == NOOK_OK; i++)
        result = nook_texture_create_2d(gpu, GL_R16UI, width, height, GL_NEAREST, &reuse->ages[i]);
    size_t count = (size_t)nook_groups(width, TILE_SIZE) * nook_groups(height, TILE_SIZE);
    if (result == NOOK_OK)
        result = nook_buffer_create(gpu, NULL, sizeof(tiles_head) + count * sizeof(tile_record), &reuse->tiles);
    return result == NOOK_OK ? fit_carried(ao) : result;
}

/** Replaces bytes of the settings. @return whether they were these */
static bool take_bytes(ao_reuse *reuse, size_t *at, const void *bytes, size_t size)
{
    char *kept = (char *)reuse->settings + *at;
    bool same = memcmp(kept, bytes, size) == 0;
    memcpy(kept, bytes, size);
    *at += size;
    return same;
}

/** Remembers what values depend on besides surfaces and occluders; another of it, and nothing is taken over. */
static nook_result take_settings(nook_ao *ao, const ao_slot *slot)
{
    ao_reuse *reuse = &ao->reuse;
    const nook_ao_technique *technique = slot->technique;
    const uintptr_t which = (uintptr_t)technique; /* which one is all that counts of it */
    const uint32_t replaced = nook_gpu_replaced_programs(ao->gpu);
    const size_t size = sizeof which + sizeof replaced + sizeof ao->shared + sizeof ao->scale + technique->params_size;
    size_t at = 0;
    if (reuse->settings_size != size) {
        free(reuse->settings);
        reuse->settings = calloc(1, size);
        reuse->settings_size = reuse->settings ? size : 0;
        if (!reuse->settings)
            return nook_fail(NOOK_E_MEMORY, "ao.reuse: no memory for the settings of %s", technique->name);
    }
    bool same = take_bytes(reuse, &at, &which, sizeof which);
    same = take_bytes(reuse, &at, &replaced, sizeof replaced) && same;
    same = take_bytes(reuse, &at, &ao->shared, sizeof ao->shared) && same;
    same = take_bytes(reuse, &at, &ao->scale, sizeof ao->scale) && same;
    same = take_bytes(reuse, &at, slot->params, technique->params_size) && same;
    reuse->holds = reuse->holds && same;
    return NOOK_OK;
}

/* ---- Before a trace ---------------------------------------------------------------------------------------------- */

static void set_rows(const nook_matrix *a, float rows[3][4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            rows[row][column] = (float)a->m[column * 4 + row];
    }
}

static bool same_matrix(const nook_matrix *a, const double b[16])
{
    return memcmp(a->m, b, sizeof a->m) == 0;
}

static reuse_block make_block(const nook_ao *ao, const nook_ao_frame *frame, const nook_ao_pass *pass)
{
    const ao_reuse *reuse = &ao->reuse;
    const double *p = reuse->clip_from_view.m;
    reuse_block block = { .period = ao->shared.reuse,
                          .turn = (int32_t)(reuse->number % (uint32_t)ao->shared.reuse),
                          .moved_count = (int32_t)reuse->moved_count,
                          .error = ao->shared.reuse_error,
                          .window = (int32_t)ao_reuse_window(ao),
                          .most = ao->shared.accumulate };
    nook_matrix world_from_view, world_from_before;
    if (!reuse->holds || !nook_matrix_inverse_affine(&pass->view_from_world, &world_from_view) ||
        !nook_matrix_inverse_affine(&reuse->view_from_world, &world_from_before))
        return block;
    nook_matrix before_from_view = nook_matrix_multiply(&reuse->view_from_world, &world_from_view);
    nook_matrix view_from_before = nook_matrix_multiply(&pass->view_from_world, &world_from_before);
    set_rows(&before_from_view, block.before_from_view);
    set_rows(&view_from_before, block.view_from_before);
    for (int axis = 0; axis < 2; axis++) { /* as set_projection of record.c */
        block.ray_scale[axis] = (float)(1.0 / p[5 * axis]);
        block.ray_offset[axis] = (float)(p[8 + axis] / p[5 * axis]);
    }
    block.has_before = 1;
    block.stands = same_matrix(&reuse->view_from_world, frame->view_from_world) &&
                   same_matrix(&reuse->clip_from_view, frame->clip_from_view);
    return block;
}

static void bind(const nook_ao *ao, const nook_ao_pass *pass)
{
    const ao_reuse *reuse = &ao->reuse;
    const nook_texture before[] = { reuse->depth, reuse->normal, reuse->visibility, reuse->ages[0] };
    nook_bind_uniform(ao->gpu, 0, pass->frame);
    nook_bind_uniform(ao->gpu, BINDING_BLOCK, reuse->block);
    nook_bind_texture(ao->gpu, 0, pass->depth);
    nook_bind_texture(ao->gpu, 1, pass->normal);
    nook_bind_texture(ao->gpu, BINDING_OCCLUDERS, reuse->moved_texture);
    for (GLuint i = 0; i < NOOK_COUNT(before); i++)
        nook_bind_texture(ao->gpu, BINDING_BEFORE + i, before[i]);
    nook_bind_image(ao->gpu, 0, pass->visibility, GL_WRITE_ONLY);
    nook_bind_image(ao->gpu, BINDING_AGES, reuse->ages[1], GL_WRITE_ONLY);
    if (accumulates(ao))
        nook_bind_image(ao->gpu, BINDING_CARRIED, reuse->carried, GL_WRITE_ONLY);
    nook_bind_storage(ao->gpu, NOOK_AO_BINDING_TILES, reuse->tiles);
    nook_bind_storage(ao->gpu, AO_BINDING_COUNTER, pass->counter);
}

/** Boxes follow all that has moved. */
static void upload_moved(const nook_ao *ao)
{
    const ao_reuse *reuse = &ao->reuse;
    const size_t size = reuse->moved_count * sizeof *reuse->moved;
    const size_t box_count = reuse->moved_count * (size_t)(ao_reuse_window(ao) - 1);
    if (reuse->moved_count)
        nook_buffer_update(ao->gpu, reuse->moved_buffer, 0, reuse->moved, size);
    if (reuse->moved_count && ao->shared.reuse_error > 0.0f)
        nook_buffer_update(ao->gpu, reuse->moved_buffer, size, reuse->boxes, box_count * sizeof *reuse->boxes);
}

static nook_result choose_program(const nook_ao *ao, const nook_ao_pass *pass, nook_program *out_program)
{
    char defines[64];
    snprintf(defines, sizeof defines, "%s%s%s", ao->shared.reuse_error > 0.0f ? "#define BOUNDED\n" : "",
             accumulates(ao) ? "#define ACCUMULATE\n" : "", nook_ao_pass_defines(pass, 0));
    return nook_program_compute(ao->gpu, "shaders/ao/reuse.comp.glsl", defines, out_program);
}

static nook_result dispatch(nook_ao *ao, const nook_ao_frame *frame, const nook_ao_pass *pass)
{
    static const tiles_head nothing = { .groups = { 0, 0, 1 } };
    const ao_reuse *reuse = &ao->reuse;
    const reuse_block block = make_block(ao, frame, pass);
    nook_buffer_update(ao->gpu, reuse->block, 0, &block, sizeof block);
    nook_buffer_update(ao->gpu, reuse->tiles, 0, &nothing, sizeof nothing);
    upload_moved(ao);
    bind(ao, pass);
    nook_program program;
    nook_result result = choose_program(ao, pass, &program);
    if (result != NOOK_OK)
        return result;
    uint32_t groups[2];
    nook_ao_pass_groups(pass, TILE_SIZE, TILE_SIZE, groups);
    nook_dispatch(ao->gpu, program, groups[0], groups[1], 1);
    return NOOK_OK;
}

/** All at once have the first part of the sequence, then those that come in their turns the next, and so on: so each value gets all parts. */
static uint32_t part_of(const nook_ao *ao)
{
    return nook_groups(ao->reuse.traces, (uint32_t)ao->shared.reuse) % (uint32_t)ao->shared.accumulate;
}

nook_result ao_reuse_choose(nook_ao *ao, const nook_ao_frame *frame, const ao_slot *slot, nook_ao_pass *pass)
{
    ao_reuse *reuse = &ao->reuse;
    if (!is_whole(&ao->recorded, pass)) {
        reuse->holds = false;
        return NOOK_OK;
    }
    nook_result result = fit_lists(ao);
    if (result == NOOK_OK)
        result = fit_textures(ao, pass);
    if (result == NOOK_OK)
        result = take_settings(ao, slot);
    if (!reuse->holds)
        reuse->traces = 0;
    if (result == NOOK_OK) {
        ao_collect_moved(ao, &pass->view_from_world, reuse->holds);
        result = dispatch(ao, frame, pass);
    }
    reuse->holds = false; /* until the trace has been */
    if (result == NOOK_OK) {
        pass->tiles = &reuse->tiles;
        pass->part = part_of(ao);
    }
    return result;
}

/* ---- After it ---------------------------------------------------------------------------------------------------- */

static void copy(nook_gpu *gpu, nook_texture from, nook_texture to)
{
    gpu->gl->CopyImageSubData(from.id, GL_TEXTURE_2D, 0, 0, 0, 0, to.id, GL_TEXTURE_2D, 0, 0, 0, 0, (GLsizei)from.width,
                              (GLsizei)from.height, 1);
}

static nook_result make_means(nook_ao *ao, const nook_ao_pass *pass)
{
    const ao_reuse *reuse = &ao->reuse;
    nook_program program;
    nook_result result =
        nook_program_compute(ao->gpu, "shaders/ao/accumulate.comp.glsl", nook_ao_pass_defines(pass, 0), &program);
    if (result != NOOK_OK)
        return result;
    nook_bind_uniform(ao->gpu, 0, pass->frame);
    nook_bind_texture(ao->gpu, BINDING_MEAN_CARRIED, reuse->carried);
    nook_bind_texture(ao->gpu, BINDING_MEAN_AGES, reuse->ages[1]);
    nook_bind_image(ao->gpu, 0, pass->visibility, GL_READ_WRITE);
    nook_bind_storage(ao->gpu, AO_BINDING_COUNTER, pass->counter);
    uint32_t groups[2];
    nook_ao_pass_groups(pass, TILE_SIZE, TILE_SIZE, groups);
    nook_dispatch(ao->gpu, program, groups[0], groups[1], 1);
    return NOOK_OK;
}

nook_result ao_reuse_keep(nook_ao *ao, const nook_ao_frame *frame, const nook_ao_pass *pass)
{
    ao_reuse *reuse = &ao->reuse;
    const nook_texture ages = reuse->ages[0];
    if (!pass->tiles)
        return NOOK_OK;
    nook_result result = accumulates(ao) ? make_means(ao, pass) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    copy(ao->gpu, pass->depth, reuse->depth);
    copy(ao->gpu, pass->normal, reuse->normal);
    copy(ao->gpu, pass->visibility, reuse->visibility);
    reuse->ages[0] = reuse->ages[1];
    reuse->ages[1] = ages;
    memcpy(reuse->view_from_world.m, frame->view_from_world, sizeof reuse->view_from_world.m);
    memcpy(reuse->clip_from_view.m, frame->clip_from_view, sizeof reuse->clip_from_view.m);
    reuse->number++;
    reuse->traces++;
    reuse->holds = true;
    return NOOK_OK;
}

void nook_ao_forget(nook_ao *ao)
{
    ao->reuse.holds = false;
}

uint64_t ao_reuse_bytes(const ao_reuse *reuse)
{
    enum { BYTES = 4 + 4 + 4 + 2 * 2, CARRIED_BYTES = 4 }; /* R32F, RG16, R32F, twice R16UI; R32F */
    const uint64_t pixels = (uint64_t)reuse->depth.width * reuse->depth.height;
    const uint64_t bytes = reuse->carried.id ? BYTES + CARRIED_BYTES : BYTES;
    return reuse->holds ? pixels * bytes : 0;
}

uint32_t ao_reuse_count_traced(const nook_ao *ao)
{
    const ao_reuse *reuse = &ao->reuse;
    tiles_head head;
    uint32_t count = 0;
    if (!reuse->holds)
        return UINT32_MAX;
    nook_buffer_read(ao->gpu, reuse->tiles, 0, &head, sizeof head);
    for (uint32_t i = 0; i < head.count; i++) {
        tile_record tile;
        nook_buffer_read(ao->gpu, reuse->tiles, sizeof head + i * sizeof tile, &tile, sizeof tile);
        for (uint32_t bit = 0; bit < 64; bit++)
            count += tile.bits[bit / 32] >> bit % 32 & 1u;
    }
    return count;
}
