/* A window by GLFW, with its input. GLFW is never terminated: that would end every window of the process, and unload the GL
   driver with what it still holds. The end of the process does it. */
#include "engine/platform/context_internal.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
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
};

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    (void)scancode, (void)modifiers;
    window_context *self = glfwGetWindowUserPointer(window);
    for (int i = 0; action == GLFW_PRESS && i < NOOK_KEY_COUNT; i++)
        if (key > 0 && (glfw_keys[i][0] == key || glfw_keys[i][1] == key))
            self->pressed[i] = true;
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
    static const int buttons[3] = { GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE };
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
        input->mouse_down[i] = glfwGetMouseButton(self->window, buttons[i]) == GLFW_PRESS;
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
    memset(self->pressed, 0, sizeof self->pressed);
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
    self->base = (nook_context){ NOOK_BACKEND_WINDOW, glfwGetProcAddress, destroy, poll, present, show, set_title };
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
    glfwMakeContextCurrent(self->window);
    glfwSwapInterval(1);
    *out_context = &self->base;
    return NOOK_OK;
}
