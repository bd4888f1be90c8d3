/* A window by GLFW, with its input. GLFW is never terminated: that would end every window of the process, and unload the GL
   driver with what it still holds. The end of the process does it. */
#include "engine/platform/context_internal.h"
#include "engine/platform/gamepad_internal.h"
#include "engine/platform/key_label_internal.h"
#include <stdlib.h>
#include <string.h>

typedef struct window_context {
    nook_context base;
    GLFWwindow *window;
    bool
        pressed[NOOK_KEY_COUNT]; /**< Since the last poll; kept apart from `down`, so that a short press is not lost. */
    double scroll;               /**< Since the last poll. */
    double mouse_x, mouse_y;     /**< At the last poll. */
    bool mouse_known;            /**< False until the first poll: no jump in the first delta. */
    bool mouse_pressed[3];       /**< Since the last poll. */
    uint32_t typed[NOOK_INPUT_TYPED_MAX]; /**< Since the last poll. */
    uint32_t typed_count;
    bool pad_down[NOOK_PAD_COUNT]; /**< At the last poll. */
    int place[4];                  /**< Of the window before it covered a monitor: x, y, width, height. */
} window_context;

/* The keys of nook_key in order; the second is 0 or another key that counts as the same. */
static const int glfw_keys[NOOK_KEY_COUNT][2] = {
    [NOOK_KEY_ESCAPE] = { GLFW_KEY_ESCAPE, 0 },
    [NOOK_KEY_TAB] = { GLFW_KEY_TAB, 0 },
    [NOOK_KEY_SPACE] = { GLFW_KEY_SPACE, 0 },
    [NOOK_KEY_LEFT] = { GLFW_KEY_LEFT, 0 },
    [NOOK_KEY_RIGHT] = { GLFW_KEY_RIGHT, 0 },
    [NOOK_KEY_UP] = { GLFW_KEY_UP, 0 },
    [NOOK_KEY_DOWN] = { GLFW_KEY_DOWN, 0 },
    [NOOK_KEY_0] = { GLFW_KEY_0, GLFW_KEY_KP_0 },
    [NOOK_KEY_1] = { GLFW_KEY_1, GLFW_KEY_KP_1 },
    [NOOK_KEY_2] = { GLFW_KEY_2, GLFW_KEY_KP_2 },
    [NOOK_KEY_3] = { GLFW_KEY_3, GLFW_KEY_KP_3 },
    [NOOK_KEY_4] = { GLFW_KEY_4, GLFW_KEY_KP_4 },
    [NOOK_KEY_5] = { GLFW_KEY_5, GLFW_KEY_KP_5 },
    [NOOK_KEY_6] = { GLFW_KEY_6, GLFW_KEY_KP_6 },
    [NOOK_KEY_7] = { GLFW_KEY_7, GLFW_KEY_KP_7 },
    [NOOK_KEY_8] = { GLFW_KEY_8, GLFW_KEY_KP_8 },
    [NOOK_KEY_9] = { GLFW_KEY_9, GLFW_KEY_KP_9 },
    [NOOK_KEY_A] = { GLFW_KEY_A, 0 },
    [NOOK_KEY_B] = { GLFW_KEY_B, 0 },
    [NOOK_KEY_C] = { GLFW_KEY_C, 0 },
    [NOOK_KEY_D] = { GLFW_KEY_D, 0 },
    [NOOK_KEY_E] = { GLFW_KEY_E, 0 },
    [NOOK_KEY_F] = { GLFW_KEY_F, 0 },
    [NOOK_KEY_G] = { GLFW_KEY_G, 0 },
    [NOOK_KEY_H] = { GLFW_KEY_H, 0 },
    [NOOK_KEY_I] = { GLFW_KEY_I, 0 },
    [NOOK_KEY_J] = { GLFW_KEY_J, 0 },
    [NOOK_KEY_K] = { GLFW_KEY_K, 0 },
    [NOOK_KEY_L] = { GLFW_KEY_L, 0 },
    [NOOK_KEY_M] = { GLFW_KEY_M, 0 },
    [NOOK_KEY_N] = { GLFW_KEY_N, 0 },
    [NOOK_KEY_O] = { GLFW_KEY_O, 0 },
    [NOOK_KEY_P] = { GLFW_KEY_P, 0 },
    [NOOK_KEY_Q] = { GLFW_KEY_Q, 0 },
    [NOOK_KEY_R] = { GLFW_KEY_R, 0 },
    [NOOK_KEY_S] = { GLFW_KEY_S, 0 },
    [NOOK_KEY_T] = { GLFW_KEY_T, 0 },
    [NOOK_KEY_U] = { GLFW_KEY_U, 0 },
    [NOOK_KEY_V] = { GLFW_KEY_V, 0 },
    [NOOK_KEY_W] = { GLFW_KEY_W, 0 },
    [NOOK_KEY_X] = { GLFW_KEY_X, 0 },
    [NOOK_KEY_Y] = { GLFW_KEY_Y, 0 },
    [NOOK_KEY_Z] = { GLFW_KEY_Z, 0 },
    [NOOK_KEY_SHIFT] = { GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT },
    [NOOK_KEY_CONTROL] = { GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL },
    [NOOK_KEY_ALT] = { GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT },
    [NOOK_KEY_ENTER] = { GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER },
    [NOOK_KEY_BACKSPACE] = { GLFW_KEY_BACKSPACE, 0 },
    [NOOK_KEY_DELETE] = { GLFW_KEY_DELETE, 0 },
    [NOOK_KEY_HOME] = { GLFW_KEY_HOME, 0 },
    [NOOK_KEY_END] = { GLFW_KEY_END, 0 },
    [NOOK_KEY_PLUS] = { GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD },
    [NOOK_KEY_MINUS] = { GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT },
    [NOOK_KEY_F1] = { GLFW_KEY_F1, 0 },
    [NOOK_KEY_F2] = { GLFW_KEY_F2, 0 },
    [NOOK_KEY_F3] = { GLFW_KEY_F3, 0 },
    [NOOK_KEY_F4] = { GLFW_KEY_F4, 0 },
    [NOOK_KEY_F5] = { GLFW_KEY_F5, 0 },
    [NOOK_KEY_F6] = { GLFW_KEY_F6, 0 },
    [NOOK_KEY_F7] = { GLFW_KEY_F7, 0 },
    [NOOK_KEY_F8] = { GLFW_KEY_F8, 0 },
    [NOOK_KEY_F9] = { GLFW_KEY_F9, 0 },
    [NOOK_KEY_F10] = { GLFW_KEY_F10, 0 },
    [NOOK_KEY_F11] = { GLFW_KEY_F11, 0 },
    [NOOK_KEY_F12] = { GLFW_KEY_F12, 0 },
};

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    window_context *self = glfwGetWindowUserPointer(window);
    const char *label = action == GLFW_PRESS ? glfwGetKeyName(key, scancode) : NULL;
    for (int i = 0; action == GLFW_PRESS && i < NOOK_KEY_COUNT; i++) {
        if (key <= 0 || (glfw_keys[i][0] != key && glfw_keys[i][1] != key))
            continue;
        nook_key meant = nook_key_by_label((nook_key)i, modifiers & GLFW_MOD_CONTROL, label);
        if (meant < NOOK_KEY_COUNT)
            self->pressed[meant] = true;
    }
    /* Held as this key went down, whatever they are by the time of the poll: they may have been pressed before the last one, and let go. */
    if (action == GLFW_PRESS && modifiers & GLFW_MOD_CONTROL)
        self->pressed[NOOK_KEY_CONTROL] = true;
    if (action == GLFW_PRESS && modifiers & GLFW_MOD_SHIFT)
        self->pressed[NOOK_KEY_SHIFT] = true;
}

static void on_character(GLFWwindow *window, unsigned character)
{
    window_context *self = glfwGetWindowUserPointer(window);
    if (self->typed_count < NOOK_INPUT_TYPED_MAX)
        self->typed[self->typed_count++] = character;
}

static const int mouse_buttons[3] = { GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE };

static void on_mouse_button(GLFWwindow *window, int button, int action, int modifiers)
{
    (void)modifiers;
    window_context *self = glfwGetWindowUserPointer(window);
    for (int i = 0; action == GLFW_PRESS && i < 3; i++)
        if (mouse_buttons[i] == button)
            self->mouse_pressed[i] = true;
}

static void on_scroll(GLFWwindow *window, double x, double y)
{
    (void)x;
    window_context *self = glfwGetWindowUserPointer(window);
    self->scroll += y;
}

static bool key_is_down(GLFWwindow *window, const int keys[2])
{
    return glfwGetKey(window, keys[0]) == GLFW_PRESS || (keys[1] != 0 && glfwGetKey(window, keys[1]) == GLFW_PRESS);
}

/* GLFW speaks of screen coordinates; on dense displays one of them is several pixels. */
static void read_mouse(window_context *self, nook_input *input)
{
    int width = 0, height = 0;
    glfwGetWindowSize(self->window, &width, &height);
    glfwGetCursorPos(self->window, &input->mouse_x, &input->mouse_y);
    if (width > 0 && height > 0) {
        input->mouse_x *= (double)input->width / width;
        input->mouse_y *= (double)input->height / height;
    }
    if (self->mouse_known) {
        input->mouse_dx = input->mouse_x - self->mouse_x;
        input->mouse_dy = input->mouse_y - self->mouse_y;
    }
    self->mouse_known = true;
    self->mouse_x = input->mouse_x;
    self->mouse_y = input->mouse_y;
    for (int i = 0; i < 3; i++)
        input->mouse_down[i] = glfwGetMouseButton(self->window, mouse_buttons[i]) == GLFW_PRESS;
}

/* The first one that GLFW knows a mapping for. One that is pulled out lets go of everything. */
static void read_gamepad(window_context *self, nook_gamepad *out)
{
    GLFWgamepadstate state;
    bool present = false;
    for (int i = GLFW_JOYSTICK_1; i <= GLFW_JOYSTICK_LAST && !present; i++)
        present = glfwJoystickIsGamepad(i) && glfwGetGamepadState(i, &state);
    nook_gamepad_take(present ? &state : NULL, self->pad_down, out);
}

static void poll(nook_context *context, nook_input *out_input)
{
    window_context *self = (window_context *)context;
    nook_input input = { 0 };
    int width = 0, height = 0;
    glfwPollEvents();
    glfwGetFramebufferSize(self->window, &width, &height);
    input.width = (uint32_t)width;
    input.height = (uint32_t)height;
    for (int i = 0; i < NOOK_KEY_COUNT; i++)
        input.down[i] = key_is_down(self->window, glfw_keys[i]);
    memcpy(input.pressed, self->pressed, sizeof input.pressed);
    input.scroll = self->scroll;
    input.close_requested = glfwWindowShouldClose(self->window) != 0;
    read_mouse(self, &input);
    read_gamepad(self, &input.pad);
    memcpy(input.mouse_pressed, self->mouse_pressed, sizeof input.mouse_pressed);
    memcpy(input.typed, self->typed, self->typed_count * sizeof *self->typed);
    input.focused = glfwGetWindowAttrib(self->window, GLFW_FOCUSED) != 0;
    float scale_x = 1.0f, scale_y = 1.0f;
    glfwGetWindowContentScale(self->window, &scale_x, &scale_y);
    input.content_scale = scale_y > 0.0f ? (double)scale_y : 1.0;
    memset(self->pressed, 0, sizeof self->pressed);
    memset(self->mouse_pressed, 0, sizeof self->mouse_pressed);
    self->typed_count = 0;
    self->scroll = 0;
    *out_input = input;
}

static void present(nook_context *context)
{
    glfwSwapBuffers(((window_context *)context)->window);
}

static void show(nook_context *context)
{
    glfwShowWindow(((window_context *)context)->window);
}

static void set_title(nook_context *context, const char *title)
{
    glfwSetWindowTitle(((window_context *)context)->window, title);
}

static void capture_mouse(nook_context *context, bool captured)
{
    window_context *self = (window_context *)context;
    glfwSetInputMode(self->window, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported())
        glfwSetInputMode(self->window, GLFW_RAW_MOUSE_MOTION, captured ? GLFW_TRUE : GLFW_FALSE);
    self->mouse_known = false; /* the pointer jumps */
}

/* The monitor whose area holds the window's middle, else the first. */
static GLFWmonitor *monitor_of(GLFWwindow *window)
{
    int count = 0, x = 0, y = 0, width = 0, height = 0;
    GLFWmonitor **monitors = glfwGetMonitors(&count);
    glfwGetWindowPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    for (int i = 0; i < count; i++) {
        int left = 0, top = 0;
        const GLFWvidmode *mode = glfwGetVideoMode(monitors[i]);
        glfwGetMonitorPos(monitors[i], &left, &top);
        int u = x + width / 2 - left, v = y + height / 2 - top;
        if (mode && u >= 0 && u < mode->width && v >= 0 && v < mode->height)
            return monitors[i];
    }
    return glfwGetPrimaryMonitor();
}

static void set_fullscreen(nook_context *context, bool fullscreen)
{
    window_context *self = (window_context *)context;
    if (fullscreen == (glfwGetWindowMonitor(self->window) != NULL))
        return;
    if (!fullscreen) {
        glfwSetWindowMonitor(self->window, NULL, self->place[0], self->place[1], self->place[2], self->place[3], 0);
        return;
    }
    GLFWmonitor *monitor = monitor_of(self->window);
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (!mode)
        return;
    glfwGetWindowPos(self->window, &self->place[0], &self->place[1]);
    glfwGetWindowSize(self->window, &self->place[2], &self->place[3]);
    glfwSetWindowMonitor(self->window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

static void destroy(nook_context *context)
{
    window_context *self = (window_context *)context;
    glfwDestroyWindow(self->window);
    free(self);
}

static nook_result init_glfw(nook_context_reason *out_reason)
{
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY"), *message = NULL;
    if (!(x11 && *x11) && !(wayland && *wayland))
        return nook_context_refuse(
            out_reason, NOOK_E_DEVICE,
            "window: no display (DISPLAY and WAYLAND_DISPLAY are not set); use --backend osmesa");
    if (glfwInit())
        return NOOK_OK;
    glfwGetError(&message);
    return nook_context_refuse(out_reason, NOOK_E_DEVICE,
                               "window: the display does not answer (%s); use --backend osmesa",
                               message ? message : "GLFW gives no reason");
}

static GLFWwindow *open_window(const nook_context_desc *desc)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, desc->debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, desc->hidden ? GLFW_FALSE : GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); /* the frame has its own depth; the window only shows the result */
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    uint32_t width = desc->width ? desc->width : 1280, height = desc->height ? desc->height : 720;
    return glfwCreateWindow((int)width, (int)height, desc->title ? desc->title : "Nook", NULL, NULL);
}

nook_result nook_window_create(const nook_context_desc *desc, nook_context_reason *out_reason,
                               nook_context **out_context)
{
    const char *message = NULL;
    window_context *self = calloc(1, sizeof *self);
    if (!self)
        return nook_context_refuse(out_reason, NOOK_E_MEMORY, "window: out of memory");
    nook_result result = init_glfw(out_reason);
    if (result != NOOK_OK) {
        free(self);
        return result;
    }
    self->base = (nook_context){ .backend = NOOK_BACKEND_WINDOW,
                                 .get_proc = glfwGetProcAddress,
                                 .destroy = destroy,
                                 .poll = poll,
                                 .present = present,
                                 .show = show,
                                 .set_title = set_title,
                                 .capture_mouse = capture_mouse,
                                 .set_fullscreen = set_fullscreen };
    self->window = open_window(desc);
    if (!self->window) {
        glfwGetError(&message);
        result = nook_context_refuse(out_reason, NOOK_E_DEVICE,
                                     "window: the display gives no OpenGL 4.5 core (%s); use --backend osmesa",
                                     message ? message : "GLFW gives no reason");
        free(self);
        return result;
    }
    glfwSetWindowUserPointer(self->window, self);
    glfwSetKeyCallback(self->window, on_key);
    glfwSetScrollCallback(self->window, on_scroll);
    glfwSetCharCallback(self->window, on_character);
    glfwSetMouseButtonCallback(self->window, on_mouse_button);
    glfwMakeContextCurrent(self->window);
    glfwSwapInterval(1);
    *out_context = &self->base;
    return NOOK_OK;
}
