/**
 * site.h - one camera of one scene at one size, r_max and falloff, with its truths: what settings are measured at.
 *
 *   stage open, r_max and falloff set, filled -> site open (slow: traces the truths, or reads them from the cache)
 *   -> nook_site_measure as often as wanted, also after the stage was filled with other volumes -> site close
 */
#pragma once
#include "engine/render/renderer.h"
#include "game/settings/setting.h"
#include "modules/measure/errors.h"
#include "modules/measure/instability.h"
#include "modules/measure/pfm.h"
#include "modules/measure/picture.h"

struct nook_stage;
typedef struct nook_site nook_site;

typedef struct nook_site_desc {
    nook_camera camera;
    const char *camera_name; /**< For reports. Copied. */
    double noise;            /**< The truth is traced until its own noise (RMS) is at most this. > 0. */
    uint32_t rays_max;       /**< ... or until it has taken this many rays a pixel. */
    const char *cache;       /**< Folder for the truths, by content; NULL: none. */
    uint32_t what;           /**< NOOK_MEASURE_*: what the site must be prepared for. */
    uint64_t scene_hash;     /**< nook_scene_hash of the stage's scene; 0: it is found here. */
} nook_site_desc;

/** What of a sample is wanted; the rest is NaN. Errors against the truth and fetches are always there. */
enum {
    NOOK_MEASURE_TIME = 1,   /**< ms, all rounds at once: to compare settings, take turns (site_time.h). */
    NOOK_MEASURE_SCREEN = 2, /**< Errors against what the depth buffer holds. */
    NOOK_MEASURE_STEADINESS =
        4,                    /**< Instability, noise, flicker; not of exact techniques, whose frames take seconds. */
    NOOK_MEASURE_PICTURE = 8, /**< The visibility is handed out. */
    NOOK_MEASURE_ALL = 15
};

/** What one setting measured at one site. Errors are of visibility; NaN where not asked for or not to be had. */
typedef struct nook_sample {
    double ms_median, ms_min, ms_max; /**< Of the medians of rounds (site_time.h); exact techniques: of one frame. */
    double gpu_ms_median;             /**< NaN where timer queries lie. */
    uint32_t frames;                  /**< Timed, in all rounds. */
    double fetches;                   /**< Texture fetches per full-size pixel with geometry. */
    double volume_bytes;              /**< Of the volumes on the GPU; 0 for techniques that read none. */
    double texture_bytes;             /**< Of the AO's own textures at this size and scale. */
    double bake_ms; /**< Baking all volumes; 0 for techniques that read none, NaN: some came from a cache. */
    uint64_t
        outside; /**< Visibilities of all frames but the timed ones that were NaN, negative or above 1 before they were
                           clamped: 0, or a mistake. Nothing is counted of exact techniques. */
    nook_errors truth;         /**< Against rays through the scene. */
    nook_errors screen;        /**< Against rays through the surfaces that the depth buffer shows; NaN for such rays. */
    double ssim;               /**< Mean structural similarity with the truth, 1 = equal. */
    double ssim_ceiling;       /**< About what a picture without any error would have: the truth's noise lowers it. */
    double rmse_inside;        /**< RMSE on the near side of silhouettes, within a few pixels of them. */
    double rmse_outside;       /**< ... on the far side, where halos are. */
    double rmse_away;          /**< ... everywhere else. */
    double noise;              /**< Standard deviation between seeds, RMS over pixels. */
    uint64_t noise_non_finite; /**< Pixels that hold a NaN or an infinity in any of its pictures; noise is NaN then. */
    nook_instability instability; /**< Against a second camera (game/compare/second_view.h). */
    double flicker; /**< RMS change at the same points between consecutive frames of a short camera path. */
    uint64_t flicker_non_finite;                    /**< As noise_non_finite, over the points of all pairs of frames. */
    double reference_noise;                         /**< Of the truth, RMS: it stands in quadrature in truth.rmse. */
    uint32_t reference_rays;                        /**< Per pixel. */
    double noise_inside, noise_outside, noise_away; /**< As reference_noise, over the pixels of rmse_inside, ... */
    double screen_noise;  /**< As reference_noise, of the truth that `screen` was measured against. */
    nook_grey visibility; /**< NOOK_MEASURE_PICTURE: owned by the caller. */
} nook_sample;

/** @param stage  outlives the site @return why not; *out_site is NULL then */
nook_result nook_site_open(struct nook_stage *stage, const nook_site_desc *desc, nook_site **out_site);
void nook_site_close(nook_site *site); /**< NULL is allowed. */

/**
 * Draws the site's G-buffer again, applies the setting and measures it. Where the truth's noise is over a
 * quarter of an error found (game/measure/measure_verdict.h), it is traced further first, as far as rays_max allows.
 * @param what  NOOK_MEASURE_*, no more than the site was opened for
 */
nook_result nook_site_measure(nook_site *site, const nook_setting *setting, uint32_t what, nook_sample *out_sample);

/** The truths, bottom row first, borrowed until the next measure or close. */
const float *nook_site_truth(const nook_site *site);
const float *nook_site_screen_truth(const nook_site *site);
/** One byte a pixel: not 0 where there is geometry. Borrowed. */
const uint8_t *nook_site_geometry(const nook_site *site);
/** Root mean square of the truth's own noise. */
double nook_site_noise(const nook_site *site);
uint32_t nook_site_rays(const nook_site *site); /**< Of the truth, per pixel. */
