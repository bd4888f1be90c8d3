/**
 * text.h - anti-aliased text in pictures, from a TrueType font of the system (Debian: fonts-dejavu-core).
 */
#pragma once
#include "modules/measure/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_font nook_font;

typedef enum nook_font_weight { NOOK_FONT_REGULAR, NOOK_FONT_BOLD } nook_font_weight;

/** DejaVu Sans. @return NOOK_E_NOT_FOUND (the line says what to install), NOOK_E_FORMAT, NOOK_E_IO, NOOK_E_MEMORY; NULL then */
nook_result nook_font_load(nook_font_weight weight, nook_font **out_font);
/** Any other file. The file is trusted: TrueType readers are not made for hostile ones. */
nook_result nook_font_load_file(const char *path, nook_font **out_font);
void nook_font_destroy(nook_font *font); /**< NULL is allowed. */

/** Pixels that a line of UTF-8 text takes. @param size  pixels from the top of the tallest letter to the lowest descender */
int nook_text_width(const nook_font *font, float size, const char *text);
/** Draws one line. @param x, y  left edge and top of the line, pixels; a line is `size` high @return the x where it ends */
int nook_text_draw(nook_picture *picture, const nook_font *font, float size, int x, int y, nook_rgb colour,
                   const char *text);
/** How many bytes of `text` fit into `width` pixels; breaks at spaces where it can, always at least one character. */
int nook_text_fit(const nook_font *font, float size, const char *text, int width);

#ifdef __cplusplus
}
#endif
