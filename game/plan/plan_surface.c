#include "game/plan/plan_surface.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include <math.h>
#include <stdlib.h>

/* What lies of an owner's triangles in one cell of a grid over the scene. */
typedef struct piece {
    uint32_t owner;
    int32_t cell[3];
    nook_plan_box box;
} piece;

typedef struct pieces {
    piece *items;
    size_t count, capacity;
    double cell_size; /* metres */
    double origin[3]; /* of the grid */
} pieces;

static nook_result add(pieces *p, const piece *item)
{
    if (p->count == p->capacity) {
        size_t capacity = p->capacity ? p->capacity * 2 : 1024;
        piece *grown = realloc(p->items, capacity * sizeof *grown);
        if (!grown)
            return nook_fail(NOOK_E_MEMORY, "plan: no memory for %zu pieces of surface", capacity);
        p->items = grown;
        p->capacity = capacity;
    }
    p->items[p->count++] = *item;
    return NOOK_OK;
}

static int compare_pieces(const void *a, const void *b)
{
    const piece *x = a, *y = b;
    if (x->owner != y->owner)
        return x->owner < y->owner ? -1 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (x->cell[axis] != y->cell[axis])
            return x->cell[axis] < y->cell[axis] ? -1 : 1;
    return 0;
}

static void widen(nook_plan_box *box, const nook_plan_box *by)
{
    for (int axis = 0; axis < 3; axis++) {
        box->min[axis] = fmin(box->min[axis], by->min[axis]);
        box->max[axis] = fmax(box->max[axis], by->max[axis]);
    }
}

/* Pieces of one owner in one cell become one. */
static void merge(pieces *p, size_t from)
{
    if (p->count == from)
        return;
    qsort(p->items + from, p->count - from, sizeof *p->items, compare_pieces);
    size_t kept = from;
    for (size_t i = from + 1; i < p->count; i++) {
        if (compare_pieces(&p->items[kept], &p->items[i]) == 0)
            widen(&p->items[kept].box, &p->items[i].box);
        else
            p->items[++kept] = p->items[i];
    }
    p->count = kept + 1;
}

/* ---- A triangle in the grid ------------------------------------------------------------------------------------- */

typedef struct triangle {
    double corner[3][3];
    double normal[3]; /* unit; 0 for one without area */
    nook_plan_box box;
} triangle;

static triangle make_triangle(double corner[3][3])
{
    triangle t = { .normal = { 0.0, 0.0, 0.0 } };
    double u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 3; i++)
            t.corner[i][axis] = corner[i][axis];
        t.box.min[axis] = fmin(corner[0][axis], fmin(corner[1][axis], corner[2][axis]));
        t.box.max[axis] = fmax(corner[0][axis], fmax(corner[1][axis], corner[2][axis]));
        u[axis] = corner[1][axis] - corner[0][axis];
        v[axis] = corner[2][axis] - corner[0][axis];
    }
    nook_vector_cross(u, v, t.normal);
    if (!nook_vector_normalize(t.normal, t.normal))
        t.normal[0] = t.normal[1] = t.normal[2] = 0.0;
    return t;
}

static bool plane_meets(const triangle *t, const nook_plan_box *box)
{
    double middle = 0.0, reach = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double centre = 0.5 * (box->min[axis] + box->max[axis]);
        middle += t->normal[axis] * (centre - t->corner[0][axis]);
        reach += fabs(t->normal[axis]) * 0.5 * (box->max[axis] - box->min[axis]);
    }
    return fabs(middle) <= reach * (1.0 + 1e-9) + 1e-12;
}

/* The part of a cell that the triangle's box covers. */
static nook_plan_box cut_cell(const pieces *p, const triangle *t, const int32_t cell[3])
{
    nook_plan_box box;
    for (int axis = 0; axis < 3; axis++) {
        double low = p->origin[axis] + cell[axis] * p->cell_size;
        box.min[axis] = fmin(fmax(low, t->box.min[axis]), t->box.max[axis]);
        box.max[axis] = fmax(fmin(low + p->cell_size, t->box.max[axis]), box.min[axis]);
    }
    return box;
}

static nook_result add_triangle(pieces *p, uint32_t owner, const triangle *t)
{
    int32_t first[3], last[3], cell[3];
    for (int axis = 0; axis < 3; axis++) {
        first[axis] = (int32_t)floor((t->box.min[axis] - p->origin[axis]) / p->cell_size);
        last[axis] = (int32_t)floor((t->box.max[axis] - p->origin[axis]) / p->cell_size);
    }
    nook_result result = NOOK_OK;
    for (cell[2] = first[2]; cell[2] <= last[2]; cell[2]++)
        for (cell[1] = first[1]; cell[1] <= last[1]; cell[1]++)
            for (cell[0] = first[0]; cell[0] <= last[0] && result == NOOK_OK; cell[0]++) {
                piece item = { owner, { cell[0], cell[1], cell[2] }, cut_cell(p, t, cell) };
                if (plane_meets(t, &item.box))
                    result = add(p, &item);
            }
    return result;
}

/* ---- The scene's triangles -------------------------------------------------------------------------------------- */

static bool read_corners(const nook_scene *scene, const nook_primitive *primitive, const nook_matrix *world_from_local,
                         const uint32_t *indices, double out[3][3])
{
    bool finite = true;
    for (int k = 0; k < 3; k++) {
        const float *p = scene->vertices[primitive->first_vertex + indices[k]].position;
        double point[3] = { p[0], p[1], p[2] };
        nook_matrix_apply_point(world_from_local, point, out[k]);
        finite = finite && isfinite(out[k][0]) && isfinite(out[k][1]) && isfinite(out[k][2]);
    }
    return finite;
}

static nook_result add_primitive(const nook_scene *scene, const nook_primitive *primitive,
                                 const nook_matrix *world_from_local, uint32_t owner, pieces *p)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i + 2 < primitive->index_count && result == NOOK_OK; i += 3) {
        double corner[3][3];
        if (!read_corners(scene, primitive, world_from_local, scene->indices + primitive->first_index + i, corner))
            continue;
        triangle t = make_triangle(corner);
        result = add_triangle(p, owner, &t);
    }
    return result;
}

static nook_result add_node(const nook_scene *scene, const nook_node *node, uint32_t owner, pieces *p)
{
    const nook_mesh *mesh = &scene->meshes[node->mesh];
    size_t from = p->count;
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < mesh->primitive_count && result == NOOK_OK; i++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + i];
        bool blended = scene->materials[primitive->material].alpha_mode == NOOK_ALPHA_BLEND;
        result = add_primitive(scene, primitive, &node->world_from_local, blended ? NOOK_PLAN_NONE : owner, p);
    }
    merge(p, from);
    return result;
}

static double diagonal_of(const nook_scene *scene)
{
    double sides[3];
    for (int axis = 0; axis < 3; axis++)
        sides[axis] = scene->bounds_max[axis] - scene->bounds_min[axis];
    return nook_vector_length(sides);
}

static nook_result to_receivers(pieces *p, nook_plan_receiver **out_receivers, uint32_t *out_count)
{
    merge(p, 0);
    nook_plan_receiver *receivers = malloc((p->count + 1) * sizeof *receivers);
    if (!receivers)
        return nook_fail(NOOK_E_MEMORY, "plan: no memory for %zu pieces of surface", p->count);
    for (size_t i = 0; i < p->count; i++)
        receivers[i] = (nook_plan_receiver){ p->items[i].box, p->items[i].owner };
    *out_receivers = receivers;
    *out_count = (uint32_t)p->count;
    return NOOK_OK;
}

nook_result nook_plan_surface(const nook_scene *scene, const uint32_t *occluder_of_node, double r_max,
                              nook_plan_receiver **out_receivers, uint32_t *out_count)
{
    pieces p = { .cell_size = fmax(r_max / 4.0, diagonal_of(scene) / 128.0) };
    for (int axis = 0; axis < 3; axis++)
        p.origin[axis] = scene->bounds_min[axis];
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < scene->node_count && result == NOOK_OK; i++)
        if (scene->nodes[i].mesh != NOOK_NONE)
            result = add_node(scene, &scene->nodes[i], occluder_of_node[i], &p);
    if (result == NOOK_OK)
        result = to_receivers(&p, out_receivers, out_count);
    free(p.items);
    return result;
}
