/** probe.h - a technique that keeps what techniques are given, and paints 1: what goes into them is examined alone. */
#pragma once
#include "modules/ao/technique.h"

/** Row of the occluder list: struct Occluder of shaders/ao/occluders.glsl. */
typedef struct nook_probe_occluder {
    float voxel_from_view[3][4];
    float normal_from_view[3][4];
    float size[4], place[4], centre[4];
} nook_probe_occluder;

/** What the last record gave it. Starts as zero; release with nook_probe_free. The user of the view's progress. */
typedef struct nook_probe {
    float *depth;           /**< width * height, distance along -Z, 0 where nothing is seen. */
    uint16_t (*normals)[2]; /**< width * height, octahedral codes, view space. */
    uint32_t width, height;
    nook_probe_occluder *occluders;
    uint32_t occluder_count;
} nook_probe;

/** Named "probe"; finds its nook_probe as pass->progress_user. */
extern const nook_ao_technique nook_probe_technique;

void nook_probe_free(nook_probe *probe);
/** A kept normal, a unit vector whatever the code. */
void nook_probe_normal(const nook_probe *probe, size_t pixel, double out_normal[3]);
