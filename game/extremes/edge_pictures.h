/** edge_pictures.h - what every technique makes of one scene, kept for comparisons. */
#pragma once
#include "game/extremes/edge_scene.h"

/** One picture for each estimator of the program. Release with nook_edge_pictures_free. */
typedef struct nook_edge_pictures {
    nook_edge_estimator estimators[NOOK_EDGE_ESTIMATORS_MAX];
    float *visibility; /**< `count` pictures of `pixels` each. Owned. */
    size_t count, pixels;
} nook_edge_pictures;

/** Records all estimators. @param where  of the scene, for what is found outside of [0, 1] */
nook_result nook_edge_pictures_take(nook_edge_scene *scene, nook_extreme_found *found, const char *where,
                                    nook_edge_pictures *out_pictures);
void nook_edge_pictures_free(nook_edge_pictures *pictures); /**< Zeroed is allowed. */

/** RMS of visibility by which voxels that lie otherwise, and their noise, may change a picture. */
#define NOOK_EDGE_HANGING 0.03

/** A number that says how far two pictures are apart. */
typedef double (*nook_edge_compare)(const float *a, const float *b, size_t count);

/** Keeps the worst over all estimators of compare(a, b). */
void nook_edge_pictures_compare(const nook_edge_pictures *a, const nook_edge_pictures *b, nook_edge_compare compare,
                                nook_extreme_found *found, const char *where);

/** The same, but for what hangs in the world, whose voxels are others as soon as a body is added: not a bit need stay. */
void nook_edge_pictures_compare_joined(const nook_edge_pictures *a, const nook_edge_pictures *b,
                                       nook_edge_compare compare, nook_extreme_found *found, const char *where);
/** The same of a scene that was carried, turned or scaled: no more than NOOK_EDGE_HANGING is nothing for what hangs in the world. */
void nook_edge_pictures_compare_elsewhere(const nook_edge_pictures *a, const nook_edge_pictures *b,
                                          nook_edge_compare compare, nook_extreme_found *found, const char *where);

double nook_edge_rms(const float *a, const float *b, size_t count);       /**< RMS difference. */
double nook_edge_bias(const float *a, const float *b, size_t count);      /**< Mean of a - b. */
double nook_edge_different(const float *a, const float *b, size_t count); /**< Numbers that differ in any bit. */
double nook_edge_occlusion(const float *visibility, size_t count);        /**< Mean of 1 - visibility. */
