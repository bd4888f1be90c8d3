/**
 * instability.h - how much visibility changes at the same points of a scene when the camera moves.
 *
 * Ambient occlusion belongs to the surface: of two cameras that look at one point both should see one value. What a
 * technique shows otherwise crawls and flickers in motion. Pictures of two cameras are brought together point by point:
 * pixels of the first whose point the second sees too, with the second's visibility read between its pixels.
 */
#pragma once
#include "engine/core/matrix.h"
#include "engine/core/result.h"
#include "engine/core/surface.h"
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Two pixels show one surface when each lies in the other's plane to within this many of the second camera's pixels. */
#define NOOK_MATCH_PLANE_FOOTPRINTS 1.0
/** ... and when the cosine of the angle between their geometric normals is at least this: 25.8 degrees. */
#define NOOK_MATCH_NORMAL_COSINE 0.9

/** What one camera sees of the scene. Arrays are width * height, bottom row first, and borrowed. */
typedef struct nook_seen {
    nook_matrix view_from_world; /**< Rigid; looks along -Z. */
    double fov_y_radians;        /**< Vertical, (0, pi); pixels are square. */
    uint32_t width, height;      /**< > 0. */
    const float *distances; /**< Metres along the view axis to what the pixel's centre shows; 0 where nothing is. */
    const float *normals;   /**< Three a pixel: unit, world, of the geometry, towards the camera. */
} nook_seen;

/** Metres from one pixel's centre to the next at unit distance. */
double nook_seen_footprint(const nook_seen *seen);

/** What a pixel shows, in view space. @param footprint  nook_seen_footprint, found once for all pixels */
nook_surface_point nook_seen_point(const nook_seen *seen, double footprint, uint32_t x, uint32_t y);

/** Where a second camera sees the points of a first. Release with nook_match_free. */
typedef struct nook_match {
    float *places; /**< Two a pixel of the first: column and row in the second, fractions between pixel centres;
                        a negative column: not shared. Owned. */
    uint32_t width, height;               /**< Of the first. */
    uint32_t second_width, second_height; /**< Of the second. */
    uint64_t geometry;                    /**< Pixels of the first that show something. */
    uint64_t shared;                      /**< Of them, those that the second sees too. */
} nook_match;

/**
 * Finds the points that both see. A pixel is shared when every pixel of the second that bilinear reading there needs shows
 * the same surface: so neither what hides the point nor an edge gets mixed in. Places are rounded to 1/256 of a pixel, so
 * that a camera matched with itself gives each pixel its own centre exactly.
 * @return NOOK_E_MEMORY; *out_match is zero then. Nothing shared is no failure
 */
nook_result nook_match_create(const nook_seen *first, const nook_seen *second, nook_match *out_match);
void nook_match_free(nook_match *match); /**< NULL and zeroed ones are allowed. */

/** How unsteady a technique is between two cameras. */
typedef struct nook_instability {
    uint64_t pixels;     /**< Shared ones: those that were compared. */
    uint64_t non_finite; /**< Of them, how many need a NaN or an infinity of either picture. */
    bool valid;          /**< pixels > 0 and non_finite == 0; if false all numbers below are NaN. */
    double rms;          /**< Root of the mean squared difference of visibility at the shared points. */
    double contrast;     /**< Standard deviation of visibility over the shared points, both cameras together. */
    /**
     * rms / (sqrt(2) contrast), whatever the strength: 0 tied to the surfaces, 1 two pictures that have nothing to do with
     * each other, sqrt(2) opposite ones. NaN when visibility is the same everywhere.
     */
    double relative;
} nook_instability;

/** @param first, second  visibility that each camera saw, laid out as in nook_seen */
nook_instability nook_instability_measure(const nook_match *match, const float *first, const float *second);

#ifdef __cplusplus
}
#endif
