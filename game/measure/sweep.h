/**
 * sweep.h - which settings are measured where, read from a small text file.
 *
 *   # comments to the end of the line
 *   size    = 480x270
 *   r_max   = 0.03 0.1 0.3          parts of the scene's diagonal; with an m behind it metres: 0.5m
 *   falloff = quadratic
 *   cameras = scene 2               the scene's first two; sampled ones (game/cameras/sample.h) where it has fewer
 *   noise   = 0.004                 of the truth, RMS of visibility, to begin with
 *   rays_max = 16384                of the truth, a pixel, at the most
 *   pictures = front                of which rows: all, or those that a site's reader looks at (game/measure/measure_pictures.h)
 *
 *   [volume]                        every combination of these values, and the initial setting
 *   rays = 4 8 16
 *   resolution = 64 128
 *
 *   [volume]                        several blocks may be of one technique
 *   ao.scale = full half quarter
 *
 * All lines but the blocks may be left out. Settings that mean the same are measured once. The reference is taken only as its
 * block says: its initial setting is the truth itself.
 */
#pragma once
#include "game/settings/setting.h"

enum { NOOK_SWEEP_R_MAX_COUNT = 16, NOOK_SWEEP_FALLOFF_COUNT = 8, NOOK_SWEEP_SETTINGS_MAX = 4096 };

typedef struct nook_sweep_r_max {
    double value;
    bool metres; /**< false: part of the scene's diagonal. */
} nook_sweep_r_max;

typedef struct nook_sweep {
    uint32_t width, height; /**< Pixels. */
    nook_sweep_r_max r_max[NOOK_SWEEP_R_MAX_COUNT];
    uint32_t r_max_count;                        /**< At least 1. */
    uint32_t falloffs[NOOK_SWEEP_FALLOFF_COUNT]; /**< Choices of ao.falloff. */
    uint32_t falloff_count;                      /**< At least 1. */
    uint32_t camera_count;                       /**< At least 1. */
    bool cameras_sampled;                        /**< None of the scene's own. */
    double noise;                                /**< > 0 */
    uint32_t rays_max;                           /**< At least 2. */
    bool all_pictures;                           /**< Those of every row are kept. */
    nook_setting *settings;                      /**< Without the same twice; in the order of the file. Owned. */
    size_t setting_count;                        /**< At least 1. */
} nook_sweep;

/** @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (file:line: what is wrong), NOOK_E_MEMORY; *out untouched then */
nook_result nook_sweep_read(const char *path, nook_sweep *out_sweep);
/** The same from a text. @param name  stands for the file in messages */
nook_result nook_sweep_parse(const char *name, const char *text, size_t size, nook_sweep *out_sweep);
/**
 * Adds a setting unless there is one that means the same.
 * @param where  names its source in messages
 * @return NOOK_E_FORMAT too many, NOOK_E_MEMORY; as it was then
 */
nook_result nook_sweep_add(const char *where, nook_sweep *sweep, const nook_setting *setting);
/**
 * Puts a parameter to one value in every setting that has it; those that mean the same then are one.
 * @param text  "TECHNIQUE.NAME=VALUE", or "ao.NAME=VALUE" for the settings of all techniques
 * @return NOOK_E_ARG, NOOK_E_RANGE, NOOK_E_NOT_FOUND no such technique or parameter, or the sweep has no setting of that technique,
 *         NOOK_E_MEMORY; as it was then
 */
nook_result nook_sweep_param(nook_sweep *sweep, const char *text);
void nook_sweep_free(nook_sweep *sweep); /**< Zeroed ones are allowed. */
