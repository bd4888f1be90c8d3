/**
 * live_views.h - which views share the picture, where they lie, and what each shows: plain numbers and text, no GL.
 *
 * Settings are kept as text (game/settings/setting.h): text survives a reload of the code whose tables it speaks of.
 */
#pragma once
#include "engine/core/rectangle.h"
#include "game/settings/setting.h"
#include <stdbool.h>
#include <stdint.h>

enum { NOOK_LIVE_VIEWS_MAX = 4, NOOK_LIVE_SPLITS_MAX = 2 };

/** What a view shows. Modes from NOOK_LIVE_BUFFERS on are the buffers of nook_view, but for those that stand here. */
enum {
    NOOK_LIVE_LIT,        /**< The picture. */
    NOOK_LIVE_VISIBILITY, /**< Ambient visibility alone. */
    NOOK_LIVE_ERROR,      /**< Visibility less the truth, as colour; needs a frozen camera. */
    NOOK_LIVE_OCCLUDERS,  /**< How many volumes may darken each pixel. */
    NOOK_LIVE_FETCHES,    /**< Texture fetches of each pixel. */
    NOOK_LIVE_STEPS,      /**< Turns of the loops in which its rays are followed: nook_ao_frame.counts. */
    NOOK_LIVE_DIVERGENCE, /**< Part of these that the lanes of a group of pixels wait for the longest of them. */
    NOOK_LIVE_SLICES,     /**< Three cuts through the volume of a chosen body. */
    NOOK_LIVE_VOXELS,     /**< The voxels of a chosen body, where it stands. */
    NOOK_LIVE_BUFFERS
};

typedef struct nook_live_view {
    char setting[NOOK_SETTING_TEXT_MAX]; /**< Technique and parameters. */
    bool open;                           /**< True: nothing occludes, whatever the setting. */
    uint32_t mode;                       /**< [0, nook_live_mode_count()). */
} nook_live_view;

/** Everything that undo takes back. Compared and copied as bytes: zero it before filling it in. */
typedef struct nook_live_views {
    nook_live_view views[NOOK_LIVE_VIEWS_MAX];
    uint32_t count;                      /**< [1, NOOK_LIVE_VIEWS_MAX]. */
    uint32_t active;                     /**< Whose keys and panel it is; below count. */
    bool columns;                        /**< Three views: side by side; else one beside two. */
    double splits[NOOK_LIVE_SPLITS_MAX]; /**< Where borders lie, in parts of the picture from its top left. */
    double r_max;                        /**< Metres; of all views, and of the truth. */
    double falloff, falloff_tau;         /**< As ao.falloff, ao.falloff_tau. */
    double error_range;                  /**< Errors of this size have the strongest colour; > 0. */
    double counts_range;                 /**< The same for occluders. */
    double fetches_range;                /**< The same for fetches, */
    double steps_range;                  /**< and for steps. */
    uint32_t body;                       /**< Whose volume is shown: index into the frame's occluders. */
    double slice[3];                     /**< Where it is cut, in parts of its box. */
} nook_live_views;

uint32_t nook_live_mode_count(void);
/** "lit", "visibility", "error", ... "base_colour", ... */
const char *nook_live_mode_name(uint32_t mode);
/** @return false for an unknown name; *out_mode is untouched */
bool nook_live_mode_parse(const char *name, uint32_t *out_mode);
/** Of modes from NOOK_LIVE_BUFFERS on, and of lit and visibility: the buffer as a number of nook_view. */
int nook_live_mode_buffer(uint32_t mode);
/** Of what its record counts: fetches, steps, divergence. */
bool nook_live_mode_counts(uint32_t mode);
/** Is the AO's visibility part of what this mode shows? */
bool nook_live_mode_occludes(uint32_t mode);

/** One view of a setting, over the whole picture; ranges as they come. */
void nook_live_views_reset(nook_live_views *views, const char *setting);
/** Another number of views: those that are new show what the active one does; borders lie evenly again. */
void nook_live_views_set_count(nook_live_views *views, uint32_t count);
/** The other arrangement of three. */
void nook_live_views_turn(nook_live_views *views);

/** Where each view lies in a picture; they cover it without a gap. Each is at least a pixel; in less than 4 x 4 each is all of it. */
void nook_live_views_place(const nook_live_views *views, uint32_t width, uint32_t height,
                           nook_rectangle out_places[NOOK_LIVE_VIEWS_MAX]);
/** The view at a place, in parts of the picture from its top left. */
uint32_t nook_live_views_at(const nook_live_views *views, double x, double y);

/** A border between views, in parts of the picture from its top left. */
typedef struct nook_live_border {
    bool upright;    /**< It runs from top to bottom. */
    double at;       /**< x of an upright one, y of one that lies. */
    double from, to; /**< Along it. */
} nook_live_border;

/** @return how many there are; border i is moved by splits[i] */
uint32_t nook_live_views_borders(const nook_live_views *views, nook_live_border out[NOOK_LIVE_SPLITS_MAX]);
/** The border within `reach` parts (across it: of the width or of the height) of a place, or NOOK_LIVE_SPLITS_MAX. */
uint32_t nook_live_views_border_at(const nook_live_views *views, double x, double y, const double reach[2]);
/** Moves a border; it stays a twentieth of the picture away from its neighbours. */
void nook_live_views_drag(nook_live_views *views, uint32_t border, double x, double y);
