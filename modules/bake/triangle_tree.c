#include "modules/bake/triangle_tree.h"
#include "engine/core/vector.h"
#include <stdlib.h>
#include <string.h>

/* Triangles in the order of the Morton codes of their middles; LEAF of them in turn are a leaf, and leaves are those of a complete
   binary tree, a heap: children of node i are 2 i and 2 i + 1, leaf k is node leaf_count + k. */
enum { LEAF = 4, STACK = 64 };

typedef struct tree_box {
    int32_t low[3], high[3]; /* steps; low > high: empty */
} tree_box;

struct nook_triangle_tree {
    nook_snapped_triangle *triangles;
    uint32_t count, leaf_count; /* leaf_count: a power of two */
    tree_box *boxes;            /* 2 leaf_count */
};

/* ---- Making ------------------------------------------------------------------------------------------------------ */

typedef struct coded {
    uint64_t code;
    uint32_t triangle;
} coded;

static int compare_codes(const void *a, const void *b)
{
    const coded *x = a, *y = b;
    if (x->code != y->code)
        return x->code < y->code ? -1 : 1;
    return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

/* 21 bits, two zeros after each. */
static uint64_t spread(uint64_t bits)
{
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffffu;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

static uint64_t code_of(const nook_snapped_triangle *triangle)
{
    uint64_t code = 0;
    for (int axis = 0; axis < 3; axis++) {
        int64_t sum = (int64_t)triangle->corner[0][axis] + triangle->corner[1][axis] + triangle->corner[2][axis];
        code |= spread((uint64_t)sum >> 6) << axis; /* three times 514 voxels of 2^16 steps: 27 bits */
    }
    return code;
}

static tree_box empty_box(void)
{
    return (tree_box){ { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
}

static void include(tree_box *box, const int32_t low[3], const int32_t high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = low[axis] < box->low[axis] ? low[axis] : box->low[axis];
        box->high[axis] = high[axis] > box->high[axis] ? high[axis] : box->high[axis];
    }
}

static void make_boxes(nook_triangle_tree *tree)
{
    for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) {
        tree_box *box = &tree->boxes[tree->leaf_count + leaf];
        *box = empty_box();
        for (uint64_t i = (uint64_t)leaf * LEAF; i < ((uint64_t)leaf + 1) * LEAF && i < tree->count; i++)
            for (int corner = 0; corner < 3; corner++)
                include(box, tree->triangles[i].corner[corner], tree->triangles[i].corner[corner]);
    }
    for (uint32_t node = tree->leaf_count - 1; node >= 1; node--) {
        tree->boxes[node] = tree->boxes[2 * node];
        include(&tree->boxes[node], tree->boxes[2 * node + 1].low, tree->boxes[2 * node + 1].high);
    }
}

nook_triangle_tree *nook_triangle_tree_create(const nook_snapped_triangle *triangles, size_t count)
{
    nook_triangle_tree *tree = calloc(1, sizeof *tree);
    coded *codes = malloc((count + 1) * sizeof *codes);
    if (tree) {
        tree->leaf_count = 1;
        while ((size_t)tree->leaf_count * LEAF < count)
            tree->leaf_count *= 2;
        tree->triangles = malloc((count + 1) * sizeof *tree->triangles);
        tree->boxes = malloc(2 * (size_t)tree->leaf_count * sizeof *tree->boxes);
    }
    bool made = tree && codes && tree->triangles && tree->boxes;
    if (made) {
        tree->count = (uint32_t)count;
        for (uint32_t i = 0; i < tree->count; i++)
            codes[i] = (coded){ code_of(&triangles[i]), i };
        qsort(codes, tree->count, sizeof *codes, compare_codes);
        for (uint32_t i = 0; i < tree->count; i++)
            tree->triangles[i] = triangles[codes[i].triangle];
        make_boxes(tree);
    }
    free(codes);
    if (made)
        return tree;
    nook_triangle_tree_destroy(tree);
    return NULL;
}

void nook_triangle_tree_destroy(nook_triangle_tree *tree)
{
    if (!tree)
        return;
    free(tree->triangles);
    free(tree->boxes);
    free(tree);
}

/* ---- Distances --------------------------------------------------------------------------------------------------- */

static double box_distance(const tree_box *box, const double point[3])
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double below = box->low[axis] - point[axis], above = point[axis] - box->high[axis];
        double out = below > above ? below : above;
        sum += out > 0.0 ? out * out : 0.0;
    }
    return sum;
}

static void difference(const double to[3], const double from[3], double out[3])
{
    nook_vector_add_scaled(to, -1.0, from, out);
}

/* @param along  from a to b @param offset  from a to the point */
static double segment_distance(const double along[3], const double offset[3])
{
    double length = nook_vector_dot(along, along), at = nook_vector_dot(along, offset), rest[3];
    at = length > 0.0 ? at / length : 0.0; /* two corners in one place: a point */
    at = at < 0.0 ? 0.0 : at > 1.0 ? 1.0 : at;
    nook_vector_add_scaled(offset, -at, along, rest);
    return nook_vector_dot(rest, rest);
}

static double triangle_distance(const nook_snapped_triangle *triangle, const double point[3])
{
    double corner[3][3], edge[3][3], offset[3][3], normal[3], nearest = 0.0;
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++)
            corner[i][axis] = triangle->corner[i][axis];
    for (int i = 0; i < 3; i++) {
        difference(corner[(i + 1) % 3], corner[i], edge[i]);
        difference(point, corner[i], offset[i]);
    }
    nook_vector_cross(edge[0], edge[1], normal); /* exact: steps are below 2^26 */
    double size = nook_vector_dot(normal, normal);
    bool over = size > 0.0; /* the point is over the triangle's inside */
    for (int i = 0; i < 3 && over; i++) {
        double side[3];
        nook_vector_cross(edge[i], offset[i], side);
        over = nook_vector_dot(side, normal) >= 0.0;
    }
    if (over) {
        double height = nook_vector_dot(offset[0], normal);
        return height * height / size;
    }
    for (int i = 0; i < 3; i++) {
        double distance = segment_distance(edge[i], offset[i]);
        nearest = i == 0 || distance < nearest ? distance : nearest;
    }
    return nearest;
}

/* Whether the box around a triangle is farther than what was found; not by a rounding error of the triangle's own distance. */
static bool is_farther(const nook_snapped_triangle *triangle, const double point[3], double best)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const int32_t a = triangle->corner[0][axis], b = triangle->corner[1][axis], c = triangle->corner[2][axis];
        const int32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c), high = a > b ? (a > c ? a : c) : (b > c ? b : c);
        const double below = low - point[axis], above = point[axis] - high, out = below > above ? below : above;
        sum += out > 0.0 ? out * out : 0.0;
    }
    return sum > best * (1.0 + 1e-9);
}

/* Nearer of the leaf's triangles. */
static void visit_leaf(const nook_triangle_tree *tree, uint32_t leaf, const double point[3], double *best,
                       uint32_t *nearest)
{
    for (uint64_t i = (uint64_t)leaf * LEAF; i < ((uint64_t)leaf + 1) * LEAF && i < tree->count; i++) {
        if (i == *nearest || is_farther(&tree->triangles[i], point, *best))
            continue;
        double distance = triangle_distance(&tree->triangles[i], point);
        if (distance < *best) {
            *best = distance;
            *nearest = (uint32_t)i;
        }
    }
}

double nook_triangle_tree_distance(const nook_triangle_tree *tree, const double point[3], double limit, uint32_t *hint)
{
    struct {
        uint32_t node;
        double distance;
    } stack[STACK]; /* one node a level waits */
    double best = limit;
    if (*hint < tree->count)
        best = fmin(best, triangle_distance(&tree->triangles[*hint], point));
    int depth = 0;
    stack[depth].node = 1;
    stack[depth++].distance = box_distance(&tree->boxes[1], point);
    while (depth > 0) {
        uint32_t node = stack[--depth].node;
        if (!(stack[depth].distance < best))
            continue;
        if (node >= tree->leaf_count) {
            visit_leaf(tree, node - tree->leaf_count, point, &best, hint);
            continue;
        }
        double left = box_distance(&tree->boxes[2 * node], point);
        double right = box_distance(&tree->boxes[2 * node + 1], point);
        uint32_t left_first = left < right; /* the nearer one is taken next */
        stack[depth].node = 2 * node + left_first;
        stack[depth++].distance = left_first ? right : left;
        stack[depth].node = 2 * node + 1 - left_first;
        stack[depth++].distance = left_first ? left : right;
    }
    return best;
}
