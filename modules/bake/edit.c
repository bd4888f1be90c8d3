#include "modules/bake/edit.h"
#include "modules/bake/alpha_hash.h"
#include "modules/bake/surfel_cut.h"
#include <stdlib.h>
#include <string.h>

/* A soup, and what its parts look like. */
typedef struct soup {
    const nook_triangles *triangles;
    const nook_alphas *alphas;
    uint64_t *looks; /* of each part */
    size_t count;    /* triangles */
} soup;

/* The hash of each part as if it were alone and first. */
static bool open_soup(const nook_edit_soup *from, soup *out)
{
    uint32_t parts = from->alphas ? from->alphas->part_count : 0;
    *out = (soup){ from->triangles, from->alphas, malloc((parts + 1) * sizeof *out->looks),
                   from->triangles->index_count / 3 };
    for (uint32_t i = 0; i < parts && out->looks; i++)
        out->looks[i] = nook_alpha_part_hash(&from->alphas->parts[i], 0);
    return out->looks != NULL;
}

static bool same_corner(const soup *a, uint32_t vertex_a, const soup *b, uint32_t vertex_b, bool textured)
{
    float at_a[3], at_b[3];
    nook_grid_read_position(a->triangles, vertex_a, at_a);
    nook_grid_read_position(b->triangles, vertex_b, at_b);
    return memcmp(at_a, at_b, sizeof at_a) == 0 &&
           (!textured || memcmp(a->alphas->uvs + 2 * (size_t)vertex_a, b->alphas->uvs + 2 * (size_t)vertex_b,
                                2 * sizeof(float)) == 0);
}

static bool same_triangle(const soup *a, size_t t_a, const soup *b, size_t t_b)
{
    const nook_alpha_part *part_a = nook_alpha_part_of(a->alphas, t_a), *part_b = nook_alpha_part_of(b->alphas, t_b);
    if (!part_a != !part_b)
        return false;
    bool looked = part_a && a->alphas && b->alphas; /* a part is one of alphas */
    if (looked && a->looks[part_a - a->alphas->parts] != b->looks[part_b - b->alphas->parts])
        return false;
    bool same = true, textured = looked && part_a->texels;
    for (size_t k = 0; k < 3 && same; k++)
        same = same_corner(a, a->triangles->indices[3 * t_a + k], b, b->triangles->indices[3 * t_b + k], textured);
    return same;
}

static void mark(const soup *s, const nook_grid_frame *frame, size_t first, size_t end, uint8_t *const *bricks)
{
    const nook_surfel_source source = { .triangles = s->triangles, .alphas = s->alphas, .frame = frame };
    for (size_t t = first; t < end; t++)
        for (uint32_t level = 0; level < NOOK_VOXELIZE_LEVELS; level++)
            if (bricks[level])
                nook_surfel_mark(&source, t, level, bricks[level]);
}

/* What is alike at either end of the lists has not changed; between, triangles are pairs where both have as many. */
static void mark_changes(const soup *a, const soup *b, const nook_grid_frame *frame, uint8_t *const *bricks)
{
    size_t least = a->count < b->count ? a->count : b->count, first = 0, last = 0;
    while (first < least && same_triangle(a, first, b, first))
        first++;
    while (last < least - first && same_triangle(a, a->count - 1 - last, b, b->count - 1 - last))
        last++;
    if (a->count != b->count) {
        mark(a, frame, first, a->count - last, bricks);
        mark(b, frame, first, b->count - last, bricks);
        return;
    }
    for (size_t t = first; t < a->count - last; t++)
        if (!same_triangle(a, t, b, t)) {
            mark(a, frame, t, t + 1, bricks);
            mark(b, frame, t, t + 1, bricks);
        }
}

nook_result nook_edit_find(const nook_edit_soup *before, const nook_edit_soup *after, const nook_grid_frame *frame,
                           uint8_t *const bricks[NOOK_VOXELIZE_LEVELS])
{
    soup a, b;
    bool opened = open_soup(before, &a);
    opened = open_soup(after, &b) && opened;
    if (opened)
        mark_changes(&a, &b, frame, bricks);
    free(a.looks);
    free(b.looks);
    return opened ? NOOK_OK : NOOK_E_MEMORY;
}
