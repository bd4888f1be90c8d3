/** key_label_internal.h - keys by what is printed on them. Not for use outside engine/platform. */
#pragma once
#include "engine/platform/context.h"

/**
 * Keys are places; but undo and redo, Control with Z and Y, are where the layout has these letters: on a German keyboard those two have changed places.
 * All else stays a place with Control too, as that may be held to crouch.
 * @param place    the key
 * @param control  Control is held
 * @param label    what the layout has printed on the key, UTF-8; NULL: nothing
 * @return NOOK_KEY_COUNT when it is none of ours then
 */
static inline nook_key nook_key_by_label(nook_key place, bool control, const char *label)
{
    bool is_letter =
        label && ((label[0] >= 'a' && label[0] <= 'z') || (label[0] >= 'A' && label[0] <= 'Z')) && !label[1];
    if (!control || !is_letter)
        return place; /* layouts without Latin letters have the places of those with them */
    char letter = (char)(label[0] | 0x20);
    if (letter == 'z' || letter == 'y')
        return letter == 'z' ? NOOK_KEY_Z : NOOK_KEY_Y;
    return place == NOOK_KEY_Z || place == NOOK_KEY_Y ? NOOK_KEY_COUNT : place;
}
