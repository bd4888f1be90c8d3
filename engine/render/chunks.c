/* Chunks: the triangles of each primitive, in order, in groups with a box around each and the places of its vertices side by side,
   so that the CPU can go through them fast. */
#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

static_assert(CHUNK_TRIANGLES * 3 <= UINT8_MAX + 1, "corners are bytes");

/** Fills chunks, one after the other. */
typedef struct chunk_maker {
    render_chunks *out;
    uint32_t chunk_count, vertex_count, triangle_count; /* so far */
    uint32_t *
        places; /* by vertex of the primitive: where it stands among those of all chunks, if that is in the chunk being made */
} chunk_maker;

/** The vertex of a chunk that is one of the primitive's; added when it is new. */
static uint8_t find_vertex(chunk_maker *maker, render_chunk *chunk, const nook_vertex *vertices, uint32_t index)
{
    render_chunks *out = maker->out;
    uint32_t place = maker->places[index];
    if (place < chunk->first_vertex || place >= maker->vertex_count || out->indices[place] != index) {
        const float *position = vertices[index].position;
        place = maker->places[index] = maker->vertex_count++;
        out->indices[place] = index;
        out->x[place] = position[0];
        out->y[place] = position[1];
        out->z[place] = position[2];
        for (int k = 0; k < 3; k++) {
            chunk->box.min[k] = fminf(chunk->box.min[k], position[k]);
            chunk->box.max[k] = fmaxf(chunk->box.max[k], position[k]);
        }
        chunk->vertex_count++;
    }
    return (uint8_t)(place - chunk->first_vertex);
}

static void add_chunk(chunk_maker *maker, const nook_vertex *vertices, const uint32_t *indices, uint32_t triangle_count)
{
    render_chunks *out = maker->out;
    render_chunk *chunk = &out->items[maker->chunk_count++];
    *chunk = (render_chunk){ .box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } },
                             .first_vertex = maker->vertex_count,
                             .first_triangle = maker->triangle_count,
                             .triangle_count = triangle_count };
    for (uint32_t i = 0; i < triangle_count; i++, maker->triangle_count++) {
        for (uint32_t k = 0; k < 3; k++)
            out->corners[maker->triangle_count][k] = find_vertex(maker, chunk, vertices, indices[i * 3 + k]);
    }
}

static void add_primitive(chunk_maker *maker, const nook_scene *scene, const nook_primitive *primitive)
{
    const nook_vertex *vertices = scene->vertices + primitive->first_vertex;
    const uint32_t *indices = scene->indices + primitive->first_index;
    uint32_t count = primitive->index_count / 3;
    for (uint32_t i = 0; i < primitive->vertex_count; i++)
        maker->places[i] = NOOK_NONE;
    for (uint32_t i = 0; i < count; i += CHUNK_TRIANGLES)
        add_chunk(maker, vertices, indices + (size_t)i * 3, count - i < CHUNK_TRIANGLES ? count - i : CHUNK_TRIANGLES);
}

/** @return false: no memory */
static bool allocate(const nook_scene *scene, render_chunks *out, uint32_t **out_places)
{
    size_t chunk_count = 0, index_count = 0, most = 0;
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        const nook_primitive *primitive = &scene->primitives[i];
        index_count += primitive->index_count;
        chunk_count += (primitive->index_count / 3 + CHUNK_TRIANGLES - 1) / CHUNK_TRIANGLES;
        most = primitive->vertex_count > most ? primitive->vertex_count : most;
    }
    out->first = malloc((scene->primitive_count + 1) * sizeof *out->first);
    out->items = malloc(chunk_count * sizeof *out->items + 1);
    out->x = malloc(index_count * sizeof *out->x + 1);
    out->y = malloc(index_count * sizeof *out->y + 1);
    out->z = malloc(index_count * sizeof *out->z + 1);
    out->indices = malloc(index_count * sizeof *out->indices + 1);
    out->corners = malloc(index_count / 3 * sizeof *out->corners + 1);
    *out_places = malloc(most * sizeof **out_places + 1);
    return out->first && out->items && out->x && out->y && out->z && out->indices && out->corners && *out_places;
}

nook_result nook_chunks_make(const nook_scene *scene, render_chunks *chunks)
{
    chunk_maker maker = { .out = chunks };
    if (chunks->first)
        return NOOK_OK;
    if (!allocate(scene, chunks, &maker.places)) {
        free(maker.places);
        nook_chunks_destroy(chunks);
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to look at its triangles", scene->path);
    }
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        chunks->first[i] = maker.chunk_count;
        add_primitive(&maker, scene, &scene->primitives[i]);
    }
    chunks->first[scene->primitive_count] = maker.chunk_count;
    free(maker.places);
    return NOOK_OK;
}

void nook_chunks_destroy(render_chunks *chunks)
{
    free(chunks->first);
    free(chunks->items);
    free(chunks->x);
    free(chunks->y);
    free(chunks->z);
    free(chunks->indices);
    free(chunks->corners);
    *chunks = (render_chunks){ 0 };
}
