/**
 * edge_receiver.h - one point of a floor under occluders, for cases that have a closed form: what a setting computes there.
 */
#pragma once
#include "game/extremes/extremes.h"
#include "modules/bake/volume_file.h"
#include "modules/fixture/receiver.h"

enum { NOOK_EDGE_PIXELS = 16 }; /**< A side of the picture, all of which sees the one point: 16 blocks of rays. */

typedef struct nook_edge_receiver {
    nook_fixture_view *view;  /**< Knows every technique; occluders are added here. */
    nook_fixture_receiver at; /**< At the start: the origin, normal +z, seen from 0.2 m above. */
    const char *technique;    /**< Of the setting. */
    nook_extreme_found *found;
} nook_edge_receiver;

/** @param found  where its visibilities are checked. @return as nook_fixture_view_create; *out_receiver is zero on failure */
nook_result nook_edge_receiver_make(const nook_extremes *extremes, nook_extreme_found *found,
                                    nook_edge_receiver *out_receiver);
void nook_edge_receiver_free(nook_edge_receiver *receiver); /**< Zeroed is allowed. */

/** Runs what looks from one receiver, which is made before and freed after. @return as nook_edge_receiver_make and `look` */
nook_result nook_edge_receiver_look(const nook_extremes *extremes, nook_extreme_found *found,
                                    nook_result (*look)(const nook_extremes *extremes, nook_edge_receiver *receiver));

/** Chooses r_max, hard falloff, no filter, and a setting by its text: "volume rays=64". @param format printf-style */
nook_result nook_edge_receiver_set(nook_edge_receiver *receiver, double r_max, const char *format, ...)
    NOOK_PRINTF(3, 4);

/** Adds an occluder whose volume is given and not baked; it has no triangles, so that the reference does not see it. */
nook_result nook_edge_receiver_add_volume(nook_edge_receiver *receiver, const nook_volume *volume);

/** Occlusion at the point, by the setting. Visibilities are checked. @param format where, printf-style, for what is outside */
nook_result nook_edge_receiver_measure(nook_edge_receiver *receiver, nook_fixture_occlusion *out_occlusion,
                                       const char *format, ...) NOOK_PRINTF(3, 4);
