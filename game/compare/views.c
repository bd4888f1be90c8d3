#include "game/compare/views.h"
#include "game/stage.h"
#include <stdio.h>
#include <string.h>

enum { NAME_MAX_BYTES = 64 };

static bool add(nook_view_list *list, const char *name, size_t length)
{
    char text[NAME_MAX_BYTES];
    nook_view view;
    if (length >= sizeof text)
        return false;
    memcpy(text, name, length);
    text[length] = '\0';
    if (!nook_view_parse(text, &view))
        return false;
    for (uint32_t i = 0; i < list->count; i++) {
        if (list->items[i] == view)
            return true;
    }
    list->items[list->count++] = view;
    return true;
}

bool nook_view_list_read(const char *text, nook_view_list *out_list)
{
    nook_view_list list = { .count = 0 };
    for (;;) {
        size_t length = strcspn(text, ",");
        if (!add(&list, text, length))
            return false;
        if (text[length] == '\0')
            break;
        text += length + 1;
    }
    *out_list = list;
    return true;
}

const char *nook_view_list_names(uint32_t per_line, char *out, size_t capacity)
{
    size_t used = 0;
    out[0] = '\0';
    for (uint32_t i = 0; i < NOOK_VIEW_COUNT && used < capacity; i++) {
        const char *between = i == 0 ? "" : per_line != 0 && i % per_line == 0 ? ",\n" : ", ";
        int indent = between[0] == ',' && between[1] == '\n' ? 29 : 0;
        used +=
            (size_t)snprintf(out + used, capacity - used, "%s%*s%s", between, indent, "", nook_view_name((nook_view)i));
    }
    return out;
}

nook_result nook_view_pictures_draw(nook_stage *stage, const nook_view_list *list, nook_view_pictures *out_pictures)
{
    *out_pictures = (nook_view_pictures){ .list = *list };
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < list->count && result == NOOK_OK; i++) {
        nook_picture *picture = &out_pictures->items[i];
        result = nook_picture_create(stage->width, stage->height, picture);
        if (result == NOOK_OK)
            result = nook_stage_finish(stage, true, list->items[i]);
        if (result == NOOK_OK)
            nook_renderer_read(stage->renderer, &picture->pixels->r);
    }
    return result;
}

void nook_view_pictures_free(nook_view_pictures *pictures)
{
    for (uint32_t i = 0; i < pictures->list.count; i++)
        nook_picture_free(&pictures->items[i]);
    *pictures = (nook_view_pictures){ .list.count = 0 };
}
