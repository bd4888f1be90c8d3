/**
 * play_window.h - a game in a window: what happens between two pictures.
 *
 *   open -> frame, frame, ... until it does not go on -> close
 *
 * Time       a frame makes as many ticks as wall time asks for, at most five: a slow machine plays slower, never coarser. With
 *            frame_seconds it is that long whatever the clock says, and the same inputs give the same pictures.
 * Pause      Esc, or another program gets the keyboard: no ticks. The mouse is free then, and while panels are open.
 * Ownership  everything that lives is in one struct, so that it outlives the code that works on it.
 */
#pragma once
#include "game/live/live.h"
#include "game/live/scene_reload.h"
#include "game/live/settings_reload.h"
#include "game/live/shader_reload.h"
#include "game/play/controls.h"
#include "game/play/picture_fit.h"
#include "game/play/picture_time.h"
#include "game/play/play.h"
#include "game/settings/settings_file.h"
#include "game/stage.h"

enum { NOOK_PLAY_HISTORY = 128, NOOK_PLAY_TICKS_PER_FRAME = 5 };

typedef struct nook_play_window_desc {
    nook_play_desc play;
    nook_backend backend;
    bool no_window;         /**< Not even where there is a display. */
    uint32_t width, height; /**< Of the window, pixels. */
    const char *settings;   /**< Technique and parameters; NULL: the level's. */
    const char *cache;      /**< Baked volumes, and the player's preferences. */
    const char *pictures;   /**< Folder of the pictures that the player takes. */
    const char *capture;  /**< Where every frame goes, see nook_live_capture; each lasts 1/30 s then. NULL: nowhere. */
    double from_seconds;  /**< Of the replay or pilot, that pass before the first picture. */
    uint32_t frames;      /**< Pictures until it ends; 0: no such end. */
    bool driven;          /**< Who calls drives it: neither window, replay nor pilot is needed. */
    double frame_seconds; /**< > 0: every frame takes this long. 0: what the clock says. */
    double
        frame_rate; /**< > 0: the picture gets smaller for so many frames a second; 0: in a window, as preferences say. */
} nook_play_window_desc;

/** How long frames took, newest at (next - 1). */
typedef struct nook_frame_pacing {
    float ms[NOOK_PLAY_HISTORY];
    uint32_t count, next;
} nook_frame_pacing;

/** Why there are no ticks. */
typedef enum nook_play_standing { NOOK_PLAY_GOES_ON, NOOK_PLAY_PAUSED, NOOK_PLAY_FROZEN } nook_play_standing;

/** What of a game has been told: only what is new is. */
typedef struct nook_play_told {
    char carried[NOOK_LEVEL_NAME_SIZE];
    nook_session_status status;
    uint32_t open;
    nook_play_standing standing;
    uint64_t ticks; /**< At the end of the last frame. */
} nook_play_told;

/** Members are for reading; zeroed is closed. */
typedef struct nook_play_window {
    nook_play play;
    nook_stage stage;
    nook_live *live;                      /**< Views, panels and messages over the picture. */
    nook_shader_reload *shaders;          /**< NULL: they cannot be watched, or nobody looks. */
    nook_scene_reload *scenes;            /**< The same of level, models and textures. */
    nook_settings_reload *settings_watch; /**< The same of the settings file. */
    nook_settings_file settings;
    nook_controls controls;
    nook_preferences preferences, kept, drawn; /**< Now, as they are on disk, and as the last picture was drawn with. */
    char preferences_path[1024];
    char settings_path[1024]; /**< "": as it comes. */
    bool settings_given;      /**< By who opened it: the level's own do not count. */
    double frame_seconds, frame_rate;
    double clock_ms, left; /**< At the last frame; seconds that no tick has used yet. */
    nook_picture_fit picture_fit;
    uint32_t whole[2]; /**< Pixels of the picture's sides if there is time for all of them. */
    nook_picture_time picture_time;
    bool went_on; /**< The last frame had ticks and was drawn. */
    nook_frame_pacing pacing;
    /** Yours to set: what is wrong with code that was to be loaded; stands on the screen. "": nothing. */
    char trouble[1024];
    nook_play_told told;  /**< What the log and the title have said last. */
    uint32_t frames_left; /**< 0: no end. */
    bool captures;        /**< Every frame goes into a file. */
    bool driven, has_window, paused, captured;
    bool quit;              /**< Asked for in the menu or by the window. */
    bool restart;           /**< Asked for in the menu: goes into the next tick. */
    bool restart_asked;     /**< The menu asks whether it is meant. */
    uint32_t width, height; /**< Of the window, or of the picture where there is none. */
} nook_play_window;

/** @return why not, logged in one line; *out_window is closed then. It must stay where it was opened. */
nook_result nook_play_window_open(const char *root, const nook_play_window_desc *desc, nook_play_window *out_window);
/** One picture. @param out_goes_on false: the player wants out, or nothing drives a game without a window any more */
nook_result nook_play_window_frame(nook_play_window *window, bool *out_goes_on);
/** After code was loaded anew, while the old one is still there: points to the new. @return as nook_stage_renew */
nook_result nook_play_window_renew(nook_play_window *window);
/** Writes recording and preferences, frees everything. @return NOOK_E_IO, NOOK_E_MEMORY: not written; closed it is */
nook_result nook_play_window_close(nook_play_window *window);

/** NOOK_PLAY_FROZEN when it is both. */
nook_play_standing nook_play_standing_of(const nook_play_window *window);
/** Logs what has happened since the last call, and puts the state of the game into the title. */
void nook_play_tell(nook_play_window *window);

/** Adds a frame. */
void nook_frame_pacing_add(nook_frame_pacing *pacing, double ms);
/** Of the frames it knows: a part of them was at most as long. @param part [0, 1] @return 0 when there are none */
double nook_frame_pacing_quantile(const nook_frame_pacing *pacing, double part);
