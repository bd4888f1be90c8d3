#pragma once
#include "engine/render/renderer.h"
#include "modules/measure/picture.h"

struct nook_stage;

/** Which views of a frame are wanted, each once. */
typedef struct nook_view_list {
    nook_view items[NOOK_VIEW_COUNT];
    uint32_t count;
} nook_view_list;

/** @param text  "depth,normal" @return false: a name is unknown or empty; *out_list is untouched */
bool nook_view_list_read(const char *text, nook_view_list *out_list);

/** All names with commas between them. @param per_line  so many, then a new line under the options' help; 0: one line */
const char *nook_view_list_names(uint32_t per_line, char *out, size_t capacity);

/** Views of one frame as pictures. */
typedef struct nook_view_pictures {
    nook_view_list list;
    nook_picture items[NOOK_VIEW_COUNT]; /**< As the list; owned. */
} nook_view_pictures;

/**
 * Draws views of the stage's frame, lit by what the last record made of its ambient occlusion.
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE; *out_pictures can be freed in any case
 */
nook_result nook_view_pictures_draw(struct nook_stage *stage, const nook_view_list *list,
                                    nook_view_pictures *out_pictures);
void nook_view_pictures_free(nook_view_pictures *pictures); /**< Zeroed ones are allowed; becomes zero. */
