/**
 * overlay.h - panels with sliders, texts and graphs over a picture: Dear ImGui behind C, drawn by our own table of GL.
 *
 *   create -> every frame: begin (the input) -> widgets -> end -> draw into any target -> destroy
 *
 * Immediate: a widget is a call that draws it and says whether the user changed it. Nothing is kept of strings and values given.
 * Labels      of one panel must differ; what follows "##" is not shown. nook_overlay_push_id tells equal ones apart.
 * Pixels      x to the right, y downwards from the top left of the target, as the mouse of nook_input.
 * Several     overlays can live in one process, on one thread; between begin and end of one no other is used.
 * Files       none are read but the font (DejaVu Sans, else ImGui's own), none are written.
 */
#pragma once
#include "engine/gpu/gpu.h"
#include "engine/platform/context.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_overlay nook_overlay;

/** sRGB, alpha; each 0 to 255. */
typedef struct nook_overlay_colour {
    uint8_t r, g, b, a;
} nook_overlay_colour;

/** What a frame of the overlay is for. */
typedef struct nook_overlay_frame {
    uint32_t width, height; /**< Of the target, pixels, > 0. */
    double scale;   /**< Of letters and widgets: nook_input.content_scale; another one makes the font anew. [0.5, 4]. */
    double seconds; /**< Since the last begin, > 0. */
    const nook_input *input; /**< In the target's pixels. NULL: no mouse, no keys. */
} nook_overlay_frame;

/** What of the input is the overlay's own: others should not act on it. */
typedef struct nook_overlay_taken {
    bool mouse; /**< It is over a panel, or holds something of one. */
    bool keys;  /**< A text or a number is being typed. */
} nook_overlay_taken;

/** @return NOOK_E_MEMORY; NOOK_E_NOT_FOUND, NOOK_E_DEVICE its shaders; *out_overlay is NULL then */
nook_result nook_overlay_create(nook_gpu *gpu, nook_overlay **out_overlay);
void nook_overlay_destroy(nook_overlay *overlay); /**< NULL is allowed. Its context must be current. */

/** Begins a frame; one that was begun and not ended is forgotten. */
nook_overlay_taken nook_overlay_begin(nook_overlay *overlay, const nook_overlay_frame *frame);
/** Widgets are complete. */
void nook_overlay_end(nook_overlay *overlay);
/**
 * Draws what was ended last over a target, stretched when that is not of the frame's size; again into another one for a picture of
 * it. Leaves GL's state at its defaults. @return NOOK_E_MEMORY, NOOK_E_NOT_FOUND, NOOK_E_DEVICE
 */
nook_result nook_overlay_draw(nook_overlay *overlay, nook_framebuffer target);

/** A panel. It is kept within the target; what is not bare is no larger than that, and scrolls. */
typedef struct nook_overlay_panel {
    const char *title; /**< "##name" for none to be shown. */
    double x, y;   /**< Where it is put at first and in targets of another size, pixels; below 0: from right, bottom. */
    double width;  /**< Then, in letters' heights; 0: as wide as what is in it. */
    double height; /**< The same; 0: as high as what is in it. */
    bool bare;     /**< No title and no frame, and it cannot be moved: a list of lines in a corner. */
    bool passive;  /**< The mouse goes through it. */
    bool pad;      /**< A gamepad reaches its widgets too: the cross or the left stick chooses, A presses, B lets go. */
    bool *open;    /**< NULL: it cannot be closed. Else there is a button that sets it to false. */
} nook_overlay_panel;

/** @return false: it is folded, leave out its widgets. Call end all the same. */
bool nook_overlay_panel_begin(nook_overlay *overlay, const nook_overlay_panel *panel);
void nook_overlay_panel_end(nook_overlay *overlay);

void nook_overlay_text(nook_overlay *overlay, const char *text);
/** The same in lines of at most `width` letters' heights, and no wider than a panel whose width was given. */
void nook_overlay_text_wrapped(nook_overlay *overlay, double width, const char *text);
void nook_overlay_text_coloured(nook_overlay *overlay, nook_overlay_colour colour, const char *text);
void nook_overlay_separator(nook_overlay *overlay);
void nook_overlay_same_line(nook_overlay *overlay); /**< The next widget stands beside the last one. */
/** The same, so many letters' heights from the panel's left: for columns. */
void nook_overlay_same_line_at(nook_overlay *overlay, double letters);
/** A heading that folds what is below it. @return false: leave that out */
bool nook_overlay_section(nook_overlay *overlay, const char *label, bool open_at_first);
/** Text beside the mouse while it is over the last widget. */
void nook_overlay_tooltip(nook_overlay *overlay, const char *text);

bool nook_overlay_button(nook_overlay *overlay, const char *label);
bool nook_overlay_checkbox(nook_overlay *overlay, const char *label, bool *value);
/**
 * A number on a scale; a click with Ctrl types it.
 * @param unit  shown behind the number; "" for none
 * @return true in each frame in which the hand moves it; nook_overlay_settled tells when it has let go
 */
bool nook_overlay_slider(nook_overlay *overlay, const char *label, double *value, double low, double high,
                         const char *unit);
/** The same on a scale on which each decade is equally long. @param low  > 0 */
bool nook_overlay_slider_logarithmic(nook_overlay *overlay, const char *label, double *value, double low, double high,
                                     const char *unit);
bool nook_overlay_slider_int(nook_overlay *overlay, const char *label, int *value, int low, int high, const char *unit);
/** @param choices  "first|second|..."; the value is the index */
bool nook_overlay_choice(nook_overlay *overlay, const char *label, int *value, const char *choices);
/** A line of text to be written. @param text  capacity bytes, UTF-8 @return true when Enter was pressed in it */
bool nook_overlay_input(nook_overlay *overlay, const char *label, char *text, size_t capacity);
/** True in the one frame in which the last widget was let go after it had been changed. */
bool nook_overlay_settled(nook_overlay *overlay);
/** True while any widget is being held or typed in. */
bool nook_overlay_busy(nook_overlay *overlay);

/**
 * Numbers over time, oldest first.
 * @param values  count of them, as a ring: values[offset] is the oldest
 * @param text    written over it; "" for none
 */
void nook_overlay_plot(nook_overlay *overlay, const char *label, const float *values, uint32_t count, uint32_t offset,
                       float low, float high, double height, const char *text);
/** A texture, the bottom row at the bottom. @param width, height  pixels */
void nook_overlay_image(nook_overlay *overlay, nook_texture texture, double width, double height);
/** Where the last widget is: x, y, width, height in pixels. */
void nook_overlay_place(nook_overlay *overlay, double out_place[4]);

void nook_overlay_push_id(nook_overlay *overlay,
                          int id); /**< Labels until the matching pop differ from those outside. */
void nook_overlay_pop_id(nook_overlay *overlay);

/* Below all panels. */

void nook_overlay_line(nook_overlay *overlay, const double from[2], const double to[2], nook_overlay_colour colour,
                       double thickness);
void nook_overlay_rectangle(nook_overlay *overlay, const double low[2], const double high[2],
                            nook_overlay_colour colour);
/** Text on a dark ground. @param at  its top left @return its height, pixels */
double nook_overlay_label(nook_overlay *overlay, const double at[2], nook_overlay_colour colour, const char *text);
/** Size of text as a label draws it, pixels. */
void nook_overlay_label_size(nook_overlay *overlay, const char *text, double out_size[2]);
/**
 * How much of a text one line holds: its longest start that ends at a space and is no wider than a number of pixels as a label; its
 * first word where that is wider. @return bytes, without the space
 */
size_t nook_overlay_line_length(nook_overlay *overlay, const char *text, double width);
double nook_overlay_letter_height(nook_overlay *overlay); /**< Pixels. */

#ifdef __cplusplus
}
#endif
