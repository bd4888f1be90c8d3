/** live_internal.h - the state of nook_live, shared by the files of game/live. */
#pragma once
#include "game/live/history.h"
#include "game/live/live.h"
#include "game/settings/settings_file.h"
#include "modules/trace/refine.h"

enum {
    LIVE_PATH_SIZE = 1024,
    LIVE_NOTE_SIZE = 256,
    LIVE_TICKS = 240,
    LIVE_COLOURS = 256,
    LIVE_TECHNIQUES = 16,
    LIVE_LATENCY = 4,
    LIVE_PANEL_WIDTH = 26 /**< Of the views' panel, letters' heights. */
};

typedef struct live_message {
    char from[32];
    char text[NOOK_LIVE_MESSAGE_SIZE]; /**< "": nothing. */
} live_message;

/** What is timed: parts of a frame in the order they are done in. */
typedef enum live_pass {
    LIVE_PASS_WORLD, /**< Systems, occluders. */
    LIVE_PASS_SHADOW,
    LIVE_PASS_GBUFFER,
    LIVE_PASS_AO, /**< Of view 0; the others follow. */
    LIVE_PASS_LIGHT = LIVE_PASS_AO + NOOK_LIVE_VIEWS_MAX,
    LIVE_PASS_OVERLAY,
    LIVE_PASS_COUNT
} live_pass;

/** Times of the last frames. */
typedef struct live_times {
    bool measuring;  /**< This frame's passes are timed. */
    double began_ms; /**< Software GL: when the pass in work began. */
    uint32_t slot;   /**< GPU: whose timers this frame takes. */
    nook_gpu_timer timers[LIVE_LATENCY][LIVE_PASS_COUNT];
    bool pending[LIVE_LATENCY][LIVE_PASS_COUNT]; /**< Taken, and not read yet. */
    double ms[LIVE_PASS_COUNT];                  /**< Smoothed; 0: not done. */
    bool done[LIVE_PASS_COUNT];                  /**< In this frame. */
    float frames[LIVE_TICKS];                    /**< Milliseconds from frame to frame: a ring. */
    uint32_t frame_count, frame_next;
    double frame_ms; /**< When the last frame began; 0: there was none. */
} live_times;

/** Textures and targets of our own. */
typedef struct live_targets {
    nook_texture error_colours, amount_colours; /**< LIVE_COLOURS x 1, RGBA8. */
    nook_texture open;                          /**< 1 x 1, R32F: 1. */
    nook_texture counts;                        /**< R32UI of the frame's size; id 0 until a mode needs it. */
    nook_framebuffer image;                     /**< Over the renderer's image. */
    uint32_t image_id;                          /**< Of that image: it changes with the size. */
    nook_texture shot;                          /**< RGBA8, of the last picture's size; id 0 before the first. */
    nook_framebuffer shot_target;               /**< Over it. */
    uint32_t vertex_array;                      /**< Empty: for full-screen triangles. */
} live_targets;

/** What decides how the overlay looks, beside panels: it is drawn again when it differs. Compared as bytes. */
typedef struct live_seen {
    double mouse[2], note_ms;
    uint32_t hovered, active, messages;
    uint32_t help_page;
} live_seen;

/** What a view's visibility differs from the truth by, over its pixels with geometry. */
typedef struct live_error {
    uint32_t pixels; /**< 0: not measured. */
    double rmse, bias;
} live_error;

/** The reference of a frozen frame. */
typedef struct live_truth {
    nook_refine *refine;      /**< NULL before the first freeze. */
    bool started;             /**< Since the freeze. */
    bool failed;              /**< It cannot be: it is not tried again before the next frame. */
    double reach[3];          /**< r_max, falloff, tau that it is traced with. */
    nook_texture texture;     /**< R32F of the frame's size. */
    float *mean, *visibility; /**< Of that size: the truth, and what the views show. Owned. */
    uint32_t rays;            /**< In `mean`; 0: none yet. */
    double noise;             /**< Of it, root mean square. */
    live_error errors[NOOK_LIVE_VIEWS_MAX];
    bool probed;
    uint32_t pixel[2]; /**< That was probed. */
    nook_refine_probe_result probe;
} live_truth;

struct nook_live {
    nook_stage *stage;
    nook_overlay *overlay;
    nook_live_views views;
    nook_live_history history;
    nook_live_views drawn; /**< As they were when the picture was made. */
    nook_live_views first; /**< As they were at the beginning: what "reset all" goes back to. */
    nook_rectangle places[NOOK_LIVE_VIEWS_MAX];
    char settings_path[LIVE_PATH_SIZE], pictures[LIVE_PATH_SIZE], notes[LIVE_PATH_SIZE];
    char techniques[LIVE_TECHNIQUES][32];                    /**< That can be chosen, by name. */
    uint32_t technique_count;                                /**< At least 1. */
    char remembered[LIVE_TECHNIQUES][NOOK_SETTING_TEXT_MAX]; /**< Of each of them: its last setting. */
    live_message messages[NOOK_LIVE_MESSAGES_MAX];
    char note[LIVE_NOTE_SIZE];        /**< What was done last ("saved ..."), for some seconds. */
    double note_ms;                   /**< When it was. */
    bool panels;                      /**< Shown. */
    uint32_t help_page;               /**< Of the lists of keys; 0: none is shown. */
    double letter;                    /**< Height of the overlay's letters, pixels; 0 before its first frame. */
    live_seen seen;                   /**< In the last frame. */
    uint32_t message_count;           /**< Changes of messages so far. */
    bool timing;                      /**< Passes are timed, whatever is shown. */
    bool times_shown;                 /**< In the last frame: passes are timed. */
    bool pointer;                     /**< The mouse is ours too in this frame. */
    bool overlay_begun, overlay_used; /**< In this frame. */
    bool borders_shown;               /**< In this frame of the overlay. */
    uint32_t hovered, held;           /**< Borders; NOOK_LIVE_SPLITS_MAX: none. */
    double mouse[2];                  /**< Parts of the window from its top left. */
    uint32_t width, height;           /**< Of the window, pixels; 0 before the first input. */
    double scale;                     /**< Of letters. */
    nook_input input;                 /**< Of this frame. */
    double input_ms;                  /**< When it came; 0: none has. */
    double seconds;                   /**< Since the one before. */
    nook_overlay_taken taken;         /**< Of this frame's input. */
    bool view_recorded;               /**< The AO has read this G-buffer. */
    bool shaders_reload;              /**< As in the description. */
    bool freeze;                      /**< Asked for: from the next draw on; with its truth. */
    bool hold;                        /**< The same, by the host. */
    bool coarse;                      /**< Quarter resolution. */
    bool frozen;                      /**< The G-buffer and the world stay. */
    bool stale;                       /**< Something other than `views` has changed since the picture was made. */
    nook_texture visibility[NOOK_LIVE_VIEWS_MAX]; /**< That the views show; id 0: all open. */
    double scales[NOOK_LIVE_VIEWS_MAX];           /**< ao.scale that it was recorded with. */
    bool multiplies;                              /**< Some view does, of those that march volumes. */
    uint32_t frame_width, frame_height;           /**< Of the stage when the G-buffer was drawn; 0: never. */
    nook_camera camera;                           /**< Of the G-buffer. */
    bool picture_asked;                           /**< F12 was pressed. */
    bool capture_failed;                          /**< The last one ended before it was asked to. */
    uint32_t picture_number;                      /**< Of the last picture. */
    nook_capture *capture;                        /**< NULL: none. */
    uint8_t *captured;                            /**< A picture of capture_size, RGB. Owned. */
    uint32_t capture_size[2];
    live_targets targets;
    live_truth truth;
    live_times times;
};

/* live.c */
/** Of the window, else of the picture: pixels. */
uint32_t live_shown_width(const nook_live *live);
uint32_t live_shown_height(const nook_live *live);

/* live_modes.c */
nook_result live_targets_create(nook_live *live);
void live_targets_destroy(nook_live *live);
/** Makes the texture of counts fit the frame. @return NOOK_E_MEMORY */
nook_result live_fit_counts(nook_live *live);
/** Makes the target over the renderer's image fit. @return NOOK_E_DEVICE */
nook_result live_fit_image(nook_live *live);
/**
 * Puts a view's part of the image.
 * @param visibility  of its technique; id 0: all open
 * @param truth       visibility as traced; id 0: there is none
 */
nook_result live_show_view(nook_live *live, uint32_t view, nook_texture visibility, nook_texture truth);
/** The body whose volume is looked at, or NULL. */
const nook_ao_occluder *live_chosen_body(nook_live *live);

/* live_settings.c */
/** The setting of a view. What cannot be read (a parameter that a reload took away) becomes the technique, or the first, as it comes. */
nook_setting live_setting_of(nook_live *live, uint32_t view);
void live_set_setting(nook_live *live, uint32_t view, const nook_setting *setting);
/** Puts the shared numbers and a view's setting into the AO. */
nook_result live_apply(nook_live *live, const nook_setting *setting);
/** The shared numbers alone. */
nook_result live_apply_shared(nook_live *live);
/** Takes the shared numbers and every technique's parameters from the AO. */
void live_take_over(nook_live *live);
/** @param names  NULL: all of the AO's */
void live_list_techniques(nook_live *live, const char *const *names, uint32_t count);
/** NULL past the end. */
const struct nook_ao_technique *live_technique(const nook_live *live, uint32_t number);
/** Of a setting's text. @return LIVE_TECHNIQUES: it is none of the list */
uint32_t live_technique_number(const nook_live *live, const char *setting);
/** Chooses a technique for the active view by its number; its parameters are those it had last. Nothing past the end. */
void live_choose_technique(nook_live *live, uint32_t number);
nook_result live_save(nook_live *live);
/** The active view's setting, r_max and falloff, as a file of settings holds them. */
nook_settings_file live_settings_of_active(nook_live *live);

/* live_truth.c */
/** Traces the G-buffer that there is from now on. A failure is a note: the picture is frozen all the same. */
void live_truth_start(nook_live *live);
void live_truth_stop(nook_live *live);
void live_truth_release(nook_live *live);
/** Starts or stops, as what is frozen and shown asks for. */
void live_truth_follow(nook_live *live);
/** Takes what has been traced since the last call. @return true: there is a new picture of it, or none any more */
bool live_truth_update(nook_live *live);
/** What each view that has visibility is off by. */
void live_truth_measure(nook_live *live);
/** id 0: there is none yet */
nook_texture live_truth_texture(const nook_live *live);

/* live_picture.c */
void live_picture_by_key(nook_live *live);
void live_capture_frame(nook_live *live);

/* live_probe.c */
/** The pixel under the mouse, while there is a truth. */
void live_probe(nook_live *live);

/* live_overlay.c */
/** Begins the overlay's frame, unless it is. */
void live_overlay_begin(nook_live *live);
/** The next page of the lists of keys; after the last none. */
void live_help_turn(nook_live *live);
/** All widgets of the frame; decides by itself whether there are any. */
void live_overlay_build(nook_live *live);
/** Something over the picture changes by itself. */
bool live_overlay_moves(const nook_live *live);
/** A line at the bottom for some seconds. */
void live_note(nook_live *live, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/** Once a frame. */
void live_borders_show(nook_live *live);

/* live_names.c */
/** Whether views have names over them. */
bool live_names_shown(const nook_live *live);
void live_names_show(nook_live *live);

/* live_panels.c */
/** @param times  with a section of them: there is no room for a panel of its own */
void live_panel_views(nook_live *live, bool times);
/** Name of the mesh that a body's volume, or its triangles when it has none, were made of. */
const char *live_body_name(const nook_live *live, nook_ao_volume volume, nook_ao_mesh mesh);
/* live_times_panel.c */
void live_panel_times(nook_live *live);
void live_times_section(nook_live *live); /**< The same within another panel. */

/* live_times.c */
void live_times_frame(nook_live *live); /**< A frame begins. */
void live_times_release(nook_live *live);

/** How evenly frames come, over the last LIVE_TICKS of them. */
typedef struct live_pacing {
    float median_ms, p99_ms, worst_ms;
    uint32_t slow; /**< Frames of more than twice the median. */
} live_pacing;
live_pacing live_times_pacing(const live_times *times);

void live_times_begin(nook_live *live, live_pass pass);
void live_times_end(nook_live *live, live_pass pass);
