/**
 * box_tree_internal.h - which boxes of a growing box are taken: a tree of cuts. What is given back is joined with free
 * neighbours that were cut along the same axis, so that an emptied tree is whole again, whatever was taken of it.
 */
#pragma once
#include "modules/ao/technique.h"
#include <stdbool.h>
#include <stdint.h>

typedef nook_ao_box atlas_box;

#define BOX_TREE_NONE UINT32_MAX

typedef enum box_state { BOX_FREE, BOX_TAKEN, BOX_CUT } box_state;

/** A box that is free, taken, or cut along an axis into two or more that lie next to each other. */
typedef struct box_node {
    atlas_box box;
    uint32_t parent;     /**< BOX_TREE_NONE: it is the root. Of a node that is not in use: the next such. */
    uint32_t prev, next; /**< Its neighbours along the parent's axis; BOX_TREE_NONE: the parent ends there. */
    uint32_t first;      /**< BOX_CUT: the child at the corner. */
    int axis;            /**< BOX_CUT. */
    box_state state;
} box_node;

/** Starts as zero: nothing. */
typedef struct box_tree {
    uint32_t size[3]; /**< Of the whole. */
    box_node *nodes;  /**< Owned. A node keeps its number for as long as it is in use. */
    uint32_t count, capacity;
    uint32_t unused; /**< First of a list, 1 more than its number; 0: none. */
    uint32_t root;   /**< Means nothing while the whole is empty. */
} box_tree;

void box_tree_release(box_tree *tree);
/** Makes it one free box. @return false: no memory, and it is as it was */
bool box_tree_reset(box_tree *tree, const uint32_t size[3]);
/** Makes room for the nodes of `boxes` takings more, so that those allocate nothing. @return false: no memory */
bool box_tree_reserve(box_tree *tree, uint32_t boxes);
/**
 * Takes a box from the corner of the smallest free one that holds it.
 * @param size  each at least 1 @param out_place  for box_tree_give
 * @return false: nothing holds it, or there is no memory
 */
bool box_tree_take(box_tree *tree, const uint32_t size[3], atlas_box *out_box, uint32_t *out_place);
void box_tree_give(box_tree *tree, uint32_t place);
/**
 * Extends the whole along the axis that costs least, so that a free box of `size` fits.
 * @param longest  that a side may be @return false: it would be longer, or there is no memory; it is as it was
 */
bool box_tree_grow(box_tree *tree, const uint32_t size[3], uint32_t longest);
uint64_t box_voxels(const uint32_t size[3]);
