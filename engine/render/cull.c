/* Triangles that show nothing are not drawn in quick frames on software GL, where those that are hidden cost as much as those that
   are seen, and vertices are the work of one thread. Left out are those outside the picture, those without the centre of a pixel, those
   that face away, and those that others hide. Of the latter the last frame tells: first those are drawn that could be seen in it. They are
   nearly all that shows in this one, and the depth that they leave tells of every other one whether it can show: those that can are drawn
   then. So nothing that shows is left out, whatever has moved; what the last frame tells decides only what is drawn first.
   (After Greene, Kass, Miller, "Hierarchical Z-Buffer Visibility", 1993: temporal coherence.) */
#include "engine/core/log.h"
#include "engine/render/candidates.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SEEN_MAX = 1 << 22 /* triangles of all draws: with more nothing is culled, which takes some 80 bytes for each */
};

static bool list_grow(nook_gpu *gpu, index_list *list, size_t triangles, size_t ranges)
{
    size_t size = triangles * 3 * sizeof(uint32_t);
    if (list->buffer.size < size) {
        nook_buffer bigger;
        if (nook_buffer_create(gpu, NULL, size, &bigger) != NOOK_OK)
            return false;
        nook_buffer_destroy(gpu, &list->buffer);
        list->buffer = bigger;
        list->count = 0; /* what it held is gone */
    }
    return nook_grow(&list->indices, size) && nook_grow(&list->ranges, ranges * sizeof(index_range));
}

/** Room for all triangles of all draws. @return false: no memory */
static bool grow(nook_gpu *gpu, triangle_cull *cull, size_t triangles, size_t ranges)
{
    return nook_grow(&cull->seen, triangles) && nook_grow(&cull->next_seen, triangles) &&
           nook_grow(&cull->candidates, (triangles + 1) * sizeof(cull_candidate)) &&
           list_grow(gpu, &cull->kept, triangles, ranges) && list_grow(gpu, &cull->rest, triangles, ranges);
}

static void list_clear(const triangle_cull *cull, index_list *list)
{
    list->count = 0;
    if (cull->range_count > 0)
        memset(list->ranges.items, 0, cull->range_count * sizeof(index_range));
}

/** As before the first frame. */
static void forget(triangle_cull *cull)
{
    list_clear(cull, &cull->kept);
    if (cull->seen_count > 0)
        memset(cull->seen.items, 0, cull->seen_count);
}

static size_t triangles_of(const nook_render_scene *s, const nook_mesh *mesh)
{
    size_t indices = 0;
    for (uint32_t i = 0; i < mesh->primitive_count; i++)
        indices += s->primitives[mesh->first_primitive + i].index_count;
    return indices / 3;
}

/**
 * Gives each draw's triangles and primitives their places, and forgets what was seen when these are others than before.
 * @return false: they are too many to cull, or there is no memory
 */
static bool place_draws(nook_gpu *gpu, triangle_cull *cull, const nook_frame *frame)
{
    size_t triangles = 0, ranges = 0, size = frame->draw_count * sizeof(uint32_t);
    if (!nook_grow(&cull->first_seen, size) || !nook_grow(&cull->first_range, size) || !nook_grow(&cull->meshes, size))
        return false;
    uint32_t *first_seen = cull->first_seen.items, *first_range = cull->first_range.items, *meshes = cull->meshes.items;
    bool same = cull->scene == frame->scene && cull->scene_created_ms == frame->scene->created_ms &&
                cull->draw_count == frame->draw_count;
    for (size_t i = 0; i < frame->draw_count && triangles <= SEEN_MAX; i++) {
        uint32_t mesh = frame->draws[i].mesh;
        same = same && meshes[i] == mesh;
        meshes[i] = mesh;
        first_seen[i] = (uint32_t)triangles;
        first_range[i] = (uint32_t)ranges;
        triangles += triangles_of(frame->scene, &frame->scene->scene->meshes[mesh]);
        ranges += frame->scene->scene->meshes[mesh].primitive_count;
    }
    cull->scene = NULL; /* until it is whole */
    if (triangles > SEEN_MAX || !grow(gpu, cull, triangles, ranges))
        return false;
    cull->seen_count = (uint32_t)triangles;
    cull->range_count = (uint32_t)ranges;
    cull->draw_count = frame->draw_count;
    cull->scene_created_ms = frame->scene->created_ms;
    cull->scene = frame->scene;
    if (!same)
        forget(cull);
    return true;
}

nook_result nook_cull_begin(nook_renderer *renderer, const nook_frame *frame)
{
    triangle_cull *cull = &renderer->cull;
    cull->on = false;
    if (!frame->quick || !renderer->gpu->software || renderer->draws_hidden)
        return NOOK_OK;
    if (!place_draws(renderer->gpu, cull, frame) ||
        !nook_grow(&cull->depths, (size_t)renderer->width * renderer->height * sizeof(float)))
        return NOOK_OK;
    nook_result result = nook_chunks_make(frame->scene->scene, &frame->scene->chunks);
    cull->on = result == NOOK_OK;
    return result;
}

static void list_add(index_list *list, const render_chunks *chunks, const cull_candidate *candidate)
{
    const uint32_t *from = chunks->indices + chunks->items[candidate->chunk].first_vertex;
    const uint8_t *corners = chunks->corners[candidate->triangle];
    uint32_t *to = list->indices.items;
    index_range *range = (index_range *)list->ranges.items + candidate->range;
    if (range->count == 0)
        range->first = list->count;
    for (int k = 0; k < 3; k++)
        to[list->count++] = from[corners[k]];
    range->count += 3;
}

static void upload(nook_gpu *gpu, const index_list *list)
{
    if (list->count > 0)
        nook_buffer_update(gpu, list->buffer, 0, list->indices.items, list->count * sizeof(uint32_t));
}

/** Whether all pixels that a triangle can cover are nearer than it. */
static bool is_hidden(const float *depths, uint32_t width, const cull_candidate *candidate)
{
    const pixel_rect *rect = &candidate->rect;
    for (uint32_t y = rect->low[1]; y <= rect->high[1] && candidate->depth < INFINITY; y++) {
        const float *row = depths + (size_t)y * width;
        unsigned farther = 0;
        for (uint32_t x = rect->low[0]; x <= rect->high[0]; x++)
            farther |= row[x] > candidate->depth ? 0u : 1u;
        if (farther)
            return false;
    }
    return candidate->depth < INFINITY;
}

void nook_cull_list(nook_renderer *renderer, const nook_frame *frame)
{
    triangle_cull *cull = &renderer->cull;
    const render_chunks *chunks = &frame->scene->chunks;
    const cull_candidate *candidates = cull->candidates.items;
    const uint8_t *seen = cull->seen.items;
    uint8_t *next_seen = cull->next_seen.items;
    float *depths = cull->depths.items;
    nook_texture_read(renderer->gpu, renderer->targets.gbuffer.depth, GL_DEPTH_COMPONENT, GL_FLOAT, depths,
                      (size_t)renderer->width * renderer->height * sizeof *depths);
    list_clear(cull, &cull->kept);
    list_clear(cull, &cull->rest);
    memset(next_seen, 0, cull->seen_count);
    for (uint32_t i = 0; i < cull->candidate_count; i++) {
        const cull_candidate *candidate = &candidates[i];
        if (is_hidden(depths, renderer->width, candidate))
            continue;
        if (!seen[candidate->seen])
            list_add(&cull->rest, chunks, candidate);
        list_add(&cull->kept, chunks, candidate);
        next_seen[candidate->seen] = 1;
    }
    grow_list swapped = cull->seen;
    cull->seen = cull->next_seen;
    cull->next_seen = swapped;
    upload(renderer->gpu, &cull->rest);
    upload(renderer->gpu, &cull->kept);
}

void nook_cull_destroy(nook_gpu *gpu, triangle_cull *cull)
{
    nook_buffer_destroy(gpu, &cull->kept.buffer);
    nook_buffer_destroy(gpu, &cull->rest.buffer);
    free(cull->kept.indices.items);
    free(cull->kept.ranges.items);
    free(cull->rest.indices.items);
    free(cull->rest.ranges.items);
    free(cull->meshes.items);
    free(cull->first_seen.items);
    free(cull->first_range.items);
    free(cull->candidates.items);
    free(cull->seen.items);
    free(cull->next_seen.items);
    free(cull->depths.items);
    *cull = (triangle_cull){ 0 };
}
