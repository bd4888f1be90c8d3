/**
 * live.h - techniques side by side on a running picture: views, their modes, panels over them, messages, pictures of it.
 *
 *   create -> every frame: input -> (the host moves its world) -> draw -> present -> destroy
 *
 * All that it keeps is plain memory without pointers into code or tables of code, so that both may be reloaded between two frames.
 * Keys: nook_live_keys lists them. What they, the mouse and the panels do not use is left for the host.
 */
#pragma once
#include "engine/overlay/overlay.h"
#include "game/live/capture.h"
#include "game/live/live_views.h"
#include "game/stage.h"

typedef struct nook_live nook_live;

typedef struct nook_live_desc {
    nook_stage *stage;             /**< Filled; outlives it. Its AO's r_max and falloff are taken over. */
    const char *const *techniques; /**< Names, in the order of the number keys; NULL: all of the AO's. Copied. */
    uint32_t technique_count;
    const nook_setting *setting; /**< Of the first view; NULL: the first technique as the AO is set. */
    const char *settings_path;   /**< Where "save" writes; NULL: "nook.settings". Copied. */
    const char *pictures;        /**< Folder of the pictures that F12 takes; NULL: the working directory. Copied. */
    bool
        shaders_reload; /**< What does not build may be mended: such a view goes without, and the frame does not fail. */
    const char *notes;  /**< Lines for the text beside them (level, seed); NULL: none. Copied. */
} nook_live_desc;

/** @return NOOK_E_MEMORY, NOOK_E_DEVICE, NOOK_E_NOT_FOUND (a shader); *out_live is NULL then */
nook_result nook_live_create(const nook_live_desc *desc, nook_live **out_live);
void nook_live_destroy(nook_live *live); /**< NULL is allowed. Before the stage is closed. */

/** Views and all that undo takes back. May be written between frames. */
nook_live_views *nook_live_state(nook_live *live);

/**
 * Takes the keys and the mouse of a frame.
 * @param input    of the window that nook_live_present draws to
 * @param pointer  the mouse is seen; false: it is captured, and only the host's
 * @param out_rest what is left for the host: without what was used. May be `input` itself.
 */
void nook_live_input(nook_live *live, const nook_input *input, bool pointer, nook_input *out_rest);
/** Something on the screen wants to be clicked: show the mouse. */
bool nook_live_wants_pointer(const nook_live *live);
/** For the host's own widgets of this frame; between input and draw. */
nook_overlay *nook_live_overlay(nook_live *live);
/**
 * How far down the names of the views reach among the window's leftmost pixels, where hosts write: 0 when none is there. After
 * nook_live_overlay. @param width  pixels
 */
double nook_live_names_bottom(nook_live *live, double width);

/**
 * Draws the views of a frame into the stage's image: G-buffer once, each view's AO and light. While the camera is frozen it draws
 * what was frozen, and only when something about it has changed.
 * @return why not; NOOK_E_DEVICE: GL raised an error
 */
nook_result nook_live_draw(nook_live *live, const nook_camera *camera);
/** Copies the picture to the window's framebuffer, stretched, with the overlay over it; the context's present shows it. */
nook_result nook_live_present(nook_live *live, uint32_t width, uint32_t height);
/** The same for nobody to see: what a frame costs without a window. @return NOOK_E_MEMORY, NOOK_E_RANGE, NOOK_E_DEVICE */
nook_result nook_live_present_unseen(nook_live *live, uint32_t width, uint32_t height);
/** The same into memory: RGB, top row first. @param out_rgb width * height * 3 bytes @return NOOK_E_MEMORY, NOOK_E_RANGE, NOOK_E_DEVICE */
nook_result nook_live_picture(nook_live *live, uint32_t width, uint32_t height, uint8_t *out_rgb);

/**
 * From now on every frame that is drawn goes into a folder of PNG files, or into a video, with the overlay over it. When it fails
 * later it ends, with a line in the log; frames go on.
 * @param desc  game/live/capture.h; a size of 0: the window's as it is now @return as nook_capture_open
 */
nook_result nook_live_capture(nook_live *live, const nook_capture_desc *desc);
/** Whether it has ended so. */
bool nook_live_capture_failed(const nook_live *live);
/** Ends it; waits until a video is whole. @return NOOK_E_IO, also when it had failed before */
nook_result nook_live_capture_end(nook_live *live);

/**
 * Keeps the frame that the next draw makes, whatever the host's camera and world do, and traces its truth in the background; or
 * goes on. The host pauses its world meanwhile. The key T does the same.
 */
void nook_live_freeze(nook_live *live, bool frozen);
bool nook_live_frozen(const nook_live *live);
/**
 * Keeps the frame that the next draw makes, as freezing does, but traces its truth only while a view shows some: for hosts whose
 * world stands still. While it holds, a draw costs next to nothing unless something has changed.
 */
void nook_live_hold(nook_live *live, bool held);
/** While something moves: traces at quarter resolution, whatever the views' settings say. */
void nook_live_set_coarse(nook_live *live, bool coarse);
/** Times the passes of every frame, also while no panel shows them: on software GL each is waited for. */
void nook_live_set_timing(nook_live *live, bool timing);
/** Of the active view's AO in the last frame that was timed and recorded it, smoothed; 0: it has none. */
double nook_live_ao_ms(const nook_live *live);
/** "volume rays=4", or "none"; valid until the next input or draw. */
const char *nook_live_active_setting(const nook_live *live);
/** Its place among the techniques of the number keys, from 1; 0: none. */
uint32_t nook_live_active_technique(const nook_live *live);
/** Whether a view multiplies the visibilities of several volumes (nook_setting_multiplies); as it was while none marches any. */
bool nook_live_multiplies(nook_live *live);
/** Something that a held or frozen picture is made with has changed: shaders, lights. */
void nook_live_redraw(nook_live *live);
/** Whether the next draw and present would show anything else than the last ones. */
bool nook_live_is_stale(const nook_live *live);
/**
 * Ends the threads of the truth; the next draw freezes anew if that is still asked for. Before code is exchanged, and before meshes
 * or volumes are removed from the AO.
 */
void nook_live_suspend(nook_live *live);

void nook_live_save_to(nook_live *live, const char *path); /**< Where "save" writes from now on. Copied. */

enum { NOOK_LIVE_MESSAGES_MAX = 6, NOOK_LIVE_MESSAGE_SIZE = 1024 };

/**
 * A line or more in red at the top, until it is "". One for each sender; with NOOK_LIVE_MESSAGES_MAX senders further ones are left out.
 * @param from  "shaders", "game", ...; it stands before the text
 */
void nook_live_message(nook_live *live, const char *from, const char *text);

/** Lists of keys: what the views listen to, and beside or above it what the host does. */
typedef enum nook_live_help {
    NOOK_LIVE_HELP_NONE,
    NOOK_LIVE_HELP_HOST,  /**< Yours alone: there is no room for both, and F1 turns the page. */
    NOOK_LIVE_HELP_VIEWS, /**< That of the views alone, which is drawn here. */
    NOOK_LIVE_HELP_BOTH
} nook_live_help;

/** Width in letters' heights from which on the two lists lie beside each other, and not above. */
enum { NOOK_LIVE_HELP_BESIDE = 49 };

/** Which lists are to be seen. */
nook_live_help nook_live_help_shown(const nook_live *live);
/** How far above the window's bottom the host's list ends, at its left side: pixels. */
double nook_live_help_bottom(const nook_live *live);

/** What a key does. */
typedef struct nook_live_key {
    const char *key, *what;
} nook_live_key;
const nook_live_key *nook_live_keys(size_t *out_count);
