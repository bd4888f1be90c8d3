#pragma once
#include "game/compare/second_view.h"
#include "game/measure/site.h"
#include "game/measure/site_views.h"
#include "game/measure/truth.h"
#include "modules/measure/silhouettes.h"

struct nook_site {
    struct nook_stage *stage;
    nook_camera camera;
    char name[256];
    uint32_t what; /**< NOOK_MEASURE_*. */
    uint32_t width, height;
    uint64_t scene_hash;
    double r_max;             /**< As it was when the site was opened; the same ever after. */
    uint8_t *geometry;        /**< One byte a pixel. */
    uint8_t *sides[3];        /**< Masks: inside, outside of silhouettes, away from them. */
    nook_truth truth, screen; /**< The second one only for NOOK_MEASURE_SCREEN. */
    nook_site_views views;    /**< Only for NOOK_MEASURE_STEADINESS. */
    double ceiling;           /**< SSIM that a picture without any error would have; of a truth with ... */
    uint32_t ceiling_rays;    /**< ... so many rays a pixel; 0: not found yet. */
};

/** Errors of a picture, against truths that are traced further where they are too noisy for them. */
nook_result nook_site_measure_errors(nook_site *site, const nook_setting *setting, uint32_t what,
                                     const nook_grey *picture, nook_sample *sample);
