#include "modules/ao/box_tree_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* A taking cuts once along each axis at the most, and a growth extends once along each; both make two nodes for an axis. */
enum { NODES_AT_ONCE = 6 };

void box_tree_release(box_tree *tree)
{
    free(tree->nodes);
    *tree = (box_tree){ .nodes = NULL };
}

uint64_t box_voxels(const uint32_t size[3])
{
    return (uint64_t)size[0] * size[1] * size[2];
}

/* ---- Nodes --------------------------------------------------------------------------------------------------------- */

bool box_tree_reserve(box_tree *tree, uint32_t boxes)
{
    uint32_t wanted = tree->count + (boxes + 1) * NODES_AT_ONCE;
    if (wanted <= tree->capacity)
        return true;
    if (wanted < tree->capacity * 2)
        wanted = tree->capacity * 2;
    box_node *grown = realloc(tree->nodes, wanted * sizeof *grown);
    if (!grown)
        return false;
    tree->nodes = grown;
    tree->capacity = wanted;
    return true;
}

/* There is room for it. */
static uint32_t new_node(box_tree *tree, const atlas_box *box, uint32_t parent)
{
    uint32_t number = tree->count;
    if (tree->unused) {
        number = tree->unused - 1;
        tree->unused = tree->nodes[number].parent;
    } else {
        assert(tree->count < tree->capacity);
        tree->count++;
    }
    tree->nodes[number] = (box_node){ .box = *box,
                                      .parent = parent,
                                      .prev = BOX_TREE_NONE,
                                      .next = BOX_TREE_NONE,
                                      .first = BOX_TREE_NONE,
                                      .state = BOX_FREE };
    return number;
}

static void drop_node(box_tree *tree, uint32_t number)
{
    tree->nodes[number].state = BOX_CUT; /* nobody finds it */
    tree->nodes[number].parent = tree->unused;
    tree->unused = number + 1;
}

bool box_tree_reset(box_tree *tree, const uint32_t size[3])
{
    const atlas_box whole = { { 0, 0, 0 }, { size[0], size[1], size[2] } };
    if (!box_tree_reserve(tree, 0))
        return false;
    tree->count = 0;
    tree->unused = 0;
    memcpy(tree->size, size, sizeof tree->size);
    if (box_voxels(size) > 0)
        tree->root = new_node(tree, &whole, BOX_TREE_NONE);
    return true;
}

/* ---- Taking and giving ------------------------------------------------------------------------------------------- */

static bool holds(const atlas_box *box, const uint32_t size[3])
{
    return box->size[0] >= size[0] && box->size[1] >= size[1] && box->size[2] >= size[2];
}

static uint32_t smallest_that_holds(const box_tree *tree, const uint32_t size[3])
{
    uint32_t best = BOX_TREE_NONE;
    for (uint32_t i = 0; i < tree->count; i++) {
        const box_node *node = &tree->nodes[i];
        if (node->state == BOX_FREE && holds(&node->box, size) &&
            (best == BOX_TREE_NONE || box_voxels(node->box.size) < box_voxels(tree->nodes[best].box.size)))
            best = i;
    }
    return best;
}

/* Puts a node behind another one of the same parent. */
static void link_behind(box_tree *tree, uint32_t number, uint32_t added)
{
    box_node *node = &tree->nodes[number], *behind = &tree->nodes[added];
    behind->prev = number;
    behind->next = node->next;
    if (node->next != BOX_TREE_NONE)
        tree->nodes[node->next].prev = added;
    node->next = added;
}

/* @return the part at the corner, `length` long: the node itself where its parent is cut along this axis, else a child */
static uint32_t cut(box_tree *tree, uint32_t number, int axis, uint32_t length)
{
    const uint32_t parent = tree->nodes[number].parent;
    atlas_box near = tree->nodes[number].box, far = near;
    near.size[axis] = length;
    far.origin[axis] += length;
    far.size[axis] -= length;
    if (parent != BOX_TREE_NONE && tree->nodes[parent].axis == axis) {
        tree->nodes[number].box = near;
        link_behind(tree, number, new_node(tree, &far, parent));
        return number;
    }
    uint32_t first = new_node(tree, &near, number);
    link_behind(tree, first, new_node(tree, &far, number));
    tree->nodes[number].state = BOX_CUT;
    tree->nodes[number].axis = axis;
    tree->nodes[number].first = first;
    return first;
}

/* Along the axis that leaves the largest box: what is left is to hold others. @return -1: the node has that size */
static int choose_cut(const atlas_box *box, const uint32_t size[3])
{
    uint64_t most = 0;
    int best = -1;
    for (int axis = 0; axis < 3; axis++) {
        uint64_t left = box_voxels(box->size) / box->size[axis] * (box->size[axis] - size[axis]);
        if (left > most) {
            most = left;
            best = axis;
        }
    }
    return best;
}

bool box_tree_take(box_tree *tree, const uint32_t size[3], atlas_box *out_box, uint32_t *out_place)
{
    assert(box_voxels(size) > 0);
    if (box_voxels(tree->size) == 0 || !box_tree_reserve(tree, 0))
        return false;
    uint32_t place = smallest_that_holds(tree, size);
    if (place == BOX_TREE_NONE)
        return false;
    for (int axis; (axis = choose_cut(&tree->nodes[place].box, size)) >= 0;)
        place = cut(tree, place, axis, size[axis]);
    tree->nodes[place].state = BOX_TAKEN;
    *out_box = tree->nodes[place].box;
    *out_place = place;
    return true;
}

/* A free node takes in the one behind it, if that is free, too. */
static void join(box_tree *tree, uint32_t number)
{
    box_node *node = &tree->nodes[number];
    const uint32_t behind = node->next;
    if (behind == BOX_TREE_NONE || node->state != BOX_FREE || tree->nodes[behind].state != BOX_FREE)
        return;
    const int axis = tree->nodes[node->parent].axis;
    node->box.size[axis] += tree->nodes[behind].box.size[axis];
    node->next = tree->nodes[behind].next;
    if (node->next != BOX_TREE_NONE)
        tree->nodes[node->next].prev = number;
    drop_node(tree, behind);
}

/* A free node and its free neighbours; and so on upwards, when that is all that its parent has. */
static void join_around(box_tree *tree, uint32_t number)
{
    for (;;) {
        const uint32_t before = tree->nodes[number].prev, parent = tree->nodes[number].parent;
        join(tree, number);
        if (before != BOX_TREE_NONE && tree->nodes[before].state == BOX_FREE) {
            join(tree, before);
            number = before;
        }
        if (parent == BOX_TREE_NONE || tree->nodes[number].prev != BOX_TREE_NONE ||
            tree->nodes[number].next != BOX_TREE_NONE)
            return;
        drop_node(tree, number);
        tree->nodes[parent].state = BOX_FREE;
        tree->nodes[parent].first = BOX_TREE_NONE;
        number = parent;
    }
}

void box_tree_give(box_tree *tree, uint32_t place)
{
    assert(place < tree->count && tree->nodes[place].state == BOX_TAKEN);
    tree->nodes[place].state = BOX_FREE;
    join_around(tree, place);
}

/* ---- Growing ------------------------------------------------------------------------------------------------------- */

static uint32_t last_child(const box_tree *tree, uint32_t number)
{
    uint32_t last = tree->nodes[number].first;
    while (tree->nodes[last].next != BOX_TREE_NONE)
        last = tree->nodes[last].next;
    return last;
}

/* The old whole and a slab behind it are the new one. */
static void extend(box_tree *tree, int axis, uint32_t by)
{
    atlas_box slab = { { 0, 0, 0 }, { tree->size[0], tree->size[1], tree->size[2] } }, whole = slab;
    bool was_empty = box_voxels(tree->size) == 0;
    slab.origin[axis] = tree->size[axis];
    slab.size[axis] = by;
    whole.size[axis] += by;
    memcpy(tree->size, whole.size, sizeof tree->size);
    if (box_voxels(whole.size) == 0)
        return;
    if (was_empty) {
        tree->root = new_node(tree, &whole, BOX_TREE_NONE);
        return;
    }
    if (tree->nodes[tree->root].state == BOX_FREE) {
        tree->nodes[tree->root].box = whole;
        return;
    }
    uint32_t before = tree->root;
    if (tree->nodes[before].state == BOX_CUT && tree->nodes[before].axis == axis) {
        tree->nodes[before].box = whole;
        before = last_child(tree, before);
    } else {
        tree->root = new_node(tree, &whole, BOX_TREE_NONE);
        tree->nodes[tree->root].state = BOX_CUT;
        tree->nodes[tree->root].axis = axis;
        tree->nodes[tree->root].first = before;
        tree->nodes[before].parent = tree->root;
    }
    uint32_t added = new_node(tree, &slab, tree->root);
    link_behind(tree, before, added);
    join(tree, before);
}

bool box_tree_grow(box_tree *tree, const uint32_t size[3], uint32_t longest)
{
    int best = -1;
    uint64_t best_voxels = UINT64_MAX;
    for (int axis = 0; axis < 3; axis++) {
        uint32_t grown[3];
        bool allowed = true;
        for (int k = 0; k < 3; k++) {
            grown[k] = tree->size[k] > size[k] ? tree->size[k] : size[k];
            if (k == axis)
                grown[k] = tree->size[k] + size[k];
            allowed = allowed && grown[k] <= longest;
        }
        if (allowed && box_voxels(grown) < best_voxels) {
            best = axis;
            best_voxels = box_voxels(grown);
        }
    }
    if (best < 0 || !box_tree_reserve(tree, 0))
        return false;
    for (int k = 0; k < 3; k++)
        if (k != best && tree->size[k] < size[k])
            extend(tree, k, size[k] - tree->size[k]);
    extend(tree, best, size[best]);
    return true;
}
