/**
 * context.h - an OpenGL 4.5 core context and, for a window, its input. One small interface over three backends.
 *
 * window  GLFW: a real window (needs a display)
 * osmesa  OSMesa: software GL into memory; works everywhere
 * egl     EGL surfaceless or device platform: headless on a GPU server
 *
 * A context belongs to the thread that made it. A new one takes the place of the current one; of those of the same kind
 * any may then be destroyed, of several kinds the newest first. All windows of a process are on the same display.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum nook_backend {
    NOOK_BACKEND_AUTO, /**< Window when asked for one and a display answers; else EGL when it is a real GPU; else OSMesa. */
    NOOK_BACKEND_WINDOW,
    NOOK_BACKEND_OSMESA,
    NOOK_BACKEND_EGL,
} nook_backend;

typedef struct nook_context_desc {
    nook_backend backend;
    bool want_window;       /**< AUTO only: try a window first. */
    uint32_t width, height; /**< Of the window, pixels; 0 means 1280 x 720. Headless contexts ignore it. */
    const char *title;      /**< NULL: "Nook". */
    bool hidden;            /**< A window that is not shown until nook_context_show. */
    bool debug;             /**< Ask for a debug context; driver errors reach the log either way. */
} nook_context_desc;

typedef struct nook_context nook_context;
typedef void (*nook_gl_proc)(void);
typedef nook_gl_proc (*nook_gl_get_proc)(const char *name);

/** Keys the engine knows, by GLFW's names; the window backend maps them. */
typedef enum nook_key {
    NOOK_KEY_ESCAPE,
    NOOK_KEY_TAB,
    NOOK_KEY_SPACE,
    NOOK_KEY_LEFT,
    NOOK_KEY_RIGHT,
    NOOK_KEY_UP,
    NOOK_KEY_DOWN,
    NOOK_KEY_0,
    NOOK_KEY_1,
    NOOK_KEY_2,
    NOOK_KEY_3,
    NOOK_KEY_4,
    NOOK_KEY_5,
    NOOK_KEY_6,
    NOOK_KEY_7,
    NOOK_KEY_8,
    NOOK_KEY_9,
    NOOK_KEY_A,
    NOOK_KEY_B,
    NOOK_KEY_C,
    NOOK_KEY_D,
    NOOK_KEY_E,
    NOOK_KEY_F,
    NOOK_KEY_G,
    NOOK_KEY_H,
    NOOK_KEY_I,
    NOOK_KEY_J,
    NOOK_KEY_K,
    NOOK_KEY_L,
    NOOK_KEY_M,
    NOOK_KEY_N,
    NOOK_KEY_O,
    NOOK_KEY_P,
    NOOK_KEY_Q,
    NOOK_KEY_R,
    NOOK_KEY_S,
    NOOK_KEY_T,
    NOOK_KEY_U,
    NOOK_KEY_V,
    NOOK_KEY_W,
    NOOK_KEY_X,
    NOOK_KEY_Y,
    NOOK_KEY_Z,
    NOOK_KEY_SHIFT,
    NOOK_KEY_CONTROL,
    NOOK_KEY_ALT,
    NOOK_KEY_ENTER,
    NOOK_KEY_BACKSPACE,
    NOOK_KEY_DELETE,
    NOOK_KEY_HOME,
    NOOK_KEY_END,
    NOOK_KEY_PLUS, /**< Also "=" on the same key. */
    NOOK_KEY_MINUS,
    NOOK_KEY_F1,
    NOOK_KEY_F2,
    NOOK_KEY_F3,
    NOOK_KEY_F4,
    NOOK_KEY_F5,
    NOOK_KEY_F6,
    NOOK_KEY_F7,
    NOOK_KEY_F8,
    NOOK_KEY_F9,
    NOOK_KEY_F10,
    NOOK_KEY_F11,
    NOOK_KEY_F12,
    NOOK_KEY_COUNT
} nook_key;

enum { NOOK_INPUT_TYPED_MAX = 16 };

/** Buttons of a gamepad, by their place on the usual one. */
typedef enum nook_pad_button {
    NOOK_PAD_SOUTH, /**< A, cross. */
    NOOK_PAD_EAST,
    NOOK_PAD_WEST,
    NOOK_PAD_NORTH,
    NOOK_PAD_LEFT_BUMPER,
    NOOK_PAD_RIGHT_BUMPER,
    NOOK_PAD_BACK,
    NOOK_PAD_START,
    NOOK_PAD_LEFT_THUMB,
    NOOK_PAD_RIGHT_THUMB,
    NOOK_PAD_UP, /**< Of the cross. */
    NOOK_PAD_DOWN,
    NOOK_PAD_LEFT,
    NOOK_PAD_RIGHT,
    NOOK_PAD_COUNT
} nook_pad_button;

/** The first gamepad that GLFW knows a mapping for. */
typedef struct nook_gamepad {
    bool present;
    bool down[NOOK_PAD_COUNT];
    bool pressed[NOOK_PAD_COUNT];       /**< Down now and not at the last poll. */
    double left[2], right[2];           /**< Sticks, [-1, 1], + right and up; 0 within their dead zone of 0.15. */
    double left_trigger, right_trigger; /**< [0, 1]. */
} nook_gamepad;

/** This frame's input; all zero without a window. */
typedef struct nook_input {
    bool down[NOOK_KEY_COUNT]; /**< Held now. */
    bool pressed
        [NOOK_KEY_COUNT]; /**< Went down since the last poll, also when it was released again. Places, but for Control
                                               with Z and Y, which are where the layout has them. */
    double mouse_x, mouse_y;              /**< Pixels from the top left. */
    double mouse_dx, mouse_dy;            /**< Pixels since the last poll. */
    double scroll;                        /**< Steps since the last poll, + away from the user. */
    bool mouse_down[3];                   /**< Left, right, middle. */
    bool mouse_pressed[3];                /**< Went down since the last poll. */
    uint32_t typed[NOOK_INPUT_TYPED_MAX]; /**< Characters typed since the last poll, Unicode; 0 ends them. */
    nook_gamepad pad;
    bool focused;         /**< The window has the keyboard. */
    double content_scale; /**< Of the display: 2 where letters should have twice as many pixels; 1 without a window. */
    uint32_t width, height; /**< Framebuffer, pixels; 0 while minimised. */
    bool close_requested;
} nook_input;

/** Held now, or for a moment since the last poll: as Shift is when Shift and another key were tapped in a slow frame. */
static inline bool nook_input_held(const nook_input *input, nook_key key)
{
    return input->down[key] || input->pressed[key];
}

/**
 * Makes a context current on this thread.
 * @return NOOK_E_DEVICE no such backend here or no OpenGL 4.5 (the line says what to install or set); *out_context NULL then
 */
nook_result nook_context_create(const nook_context_desc *desc, nook_context **out_context);
void nook_context_destroy(nook_context *context); /**< NULL is allowed. */

nook_backend nook_context_backend(const nook_context *context);
nook_gl_get_proc nook_context_get_proc(const nook_context *context);

/** Reads waiting events. Headless: returns an input of zeros with a content_scale of 1. */
void nook_context_poll(nook_context *context, nook_input *out_input);
/** Shows the default framebuffer. Headless: nothing. */
void nook_context_present(nook_context *context);
/** Shows a window made hidden. Headless: nothing. */
void nook_context_show(nook_context *context);
/** Hides the pointer and keeps it inside, so that mouse_dx and mouse_dy never end: for looking around. Headless: nothing. */
void nook_context_capture_mouse(nook_context *context, bool captured);
/** Covers the monitor that the window is on, or gives it back its place. Headless: nothing. */
void nook_context_set_fullscreen(nook_context *context, bool fullscreen);
/** What stands above the window. Headless: nothing. */
void nook_context_set_title(nook_context *context, const char *title);

/** "window", "osmesa", "egl", "auto". */
const char *nook_backend_name(nook_backend backend);
/** @return false for an unknown name; *out_backend is untouched */
bool nook_backend_parse(const char *name, nook_backend *out_backend);

#ifdef __cplusplus
}
#endif
