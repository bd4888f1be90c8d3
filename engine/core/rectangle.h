#pragma once
#include <stdint.h>

/** A part of a picture, pixels; row 0 is at the bottom. Where it says so, all zero is the whole picture. */
typedef struct nook_rectangle {
    uint32_t x, y, width, height;
} nook_rectangle;
