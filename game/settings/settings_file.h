/**
 * settings_file.h - a setting kept in a file: what `tune` writes and `--settings FILE` reads.
 *
 *   # Nook settings: comments to the end of the line
 *   technique = volume
 *   resolution = 128
 *   rays = 4
 *   ao.scale = half
 *
 * One "name = value" a line, technique first. r_max (metres) and falloff may stand there too: they are then what the commands
 * use unless their own option says otherwise. So may plan (off, on, measured) and plan.error, plan.memory, ... (docs/plan.md), and
 * volumes: baked, or live, one for all that is rigid, voxelised as it moves (game/live_scene.h).
 * volumes.budget, volumes.upload, ... for `play` (docs/streaming.md).
 */
#pragma once
#include "game/settings/setting.h"
#include "modules/plan/plan_params.h"
#include "modules/stream/stream_params.h"

typedef struct nook_settings_file {
    nook_setting setting;
    double r_max;     /**< Metres; 0: not given. */
    char falloff[32]; /**< A choice of ao.falloff; "": not given. */
    nook_plan_params
        plan;  /**< Initial values where nothing is given; all zero, which is off, in one that was not read. */
    bool live; /**< volumes = live. */
    nook_stream_params stream; /**< As plan. */
} nook_settings_file;

/** @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (file:line: what is wrong); *out untouched then */
nook_result nook_settings_file_read(const char *path, nook_settings_file *out);

/**
 * Writes it whole or not at all.
 * @param comment  lines for the top of the file, each ended by a newline, without '#'; NULL for none
 */
nook_result nook_settings_file_write(const char *path, const nook_settings_file *file, const char *comment);

/**
 * Brings a file up to date: values that have changed are written where they stand, those that are as they come now are taken out, those that are new
 * are added at the end; all else, comments too, stays byte for byte. Without a file there, as nook_settings_file_write.
 * @return as that; as nook_settings_file_read where a file is there that cannot be read: it is not written over
 */
nook_result nook_settings_file_update(const char *path, const nook_settings_file *file);
