/** candidates.h - triangles that may show, as engine/render/candidates.c finds them for cull.c. */
#pragma once
#include "engine/render/internal.h"

/** A triangle of an instance that has pixels. */
typedef struct cull_candidate {
    uint32_t chunk, triangle; /* of those of the scene */
    uint32_t range, seen;     /* its places in triangle_cull */
    pixel_rect rect;          /* those whose centres it can cover */
    float depth;              /* more than that of any of its points; INFINITY: not known, drawn in any case */
} cull_candidate;
