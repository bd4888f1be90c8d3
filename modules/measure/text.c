#include "modules/measure/text.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <math.h>
#include <stb/stb_truetype.h>
#include <stdlib.h>
#include <string.h>

static const char *const font_folder = "/usr/share/fonts/truetype/dejavu";

struct nook_font {
    nook_file file; /* stbtt reads from it */
    stbtt_fontinfo info;
    int ascent, descent; /* font units */
};

nook_result nook_font_load_file(const char *path, nook_font **out_font)
{
    *out_font = NULL;
    nook_font *font = calloc(1, sizeof *font);
    if (!font)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory", path);
    nook_result result = nook_file_read(path, &font->file);
    if (result != NOOK_OK) {
        free(font);
        return result;
    }
    /* Below the size of a table directory stbtt would read past the end. */
    int offset = font->file.size >= 12 ? stbtt_GetFontOffsetForIndex(font->file.bytes, 0) : -1;
    if (offset < 0 || !stbtt_InitFont(&font->info, font->file.bytes, offset)) {
        nook_font_destroy(font);
        return nook_fail(NOOK_E_FORMAT, "%s: not a TrueType font", path);
    }
    int line_gap;
    stbtt_GetFontVMetrics(&font->info, &font->ascent, &font->descent, &line_gap);
    *out_font = font;
    return NOOK_OK;
}

nook_result nook_font_load(nook_font_weight weight, nook_font **out_font)
{
    char path[256];
    *out_font = NULL;
    nook_path_join(path, sizeof path, font_folder, weight == NOOK_FONT_BOLD ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf");
    if (!nook_file_exists(path))
        return nook_fail(NOOK_E_NOT_FOUND, "%s: no such font; install the package fonts-dejavu-core", path);
    return nook_font_load_file(path, out_font);
}

void nook_font_destroy(nook_font *font)
{
    if (!font)
        return;
    nook_file_free(&font->file);
    free(font);
}

/* Decodes one UTF-8 character; a broken one counts as one byte and reads as U+FFFD. @return bytes used */
static int decode_utf8(const char *text, int *out_code)
{
    unsigned char first = (unsigned char)text[0];
    int extra = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : -1;
    if (extra == 0)
        *out_code = first;
    if (extra > 0)
        *out_code = first & (0x3f >> extra);
    for (int i = 1; i <= extra; i++) {
        unsigned char next = (unsigned char)text[i];
        if (next >> 6 != 2) {
            extra = -1;
            break;
        }
        *out_code = *out_code << 6 | (next & 0x3f);
    }
    if (extra >= 0)
        return extra + 1;
    *out_code = 0xfffd;
    return 1;
}

static float font_scale(const nook_font *font, float size)
{
    return size / (float)(font->ascent - font->descent);
}

/* How far the pen moves for a character that stands before `next` (0 at the end of the line). */
static float pen_advance(const nook_font *font, float scale, int code, int next)
{
    int advance, bearing;
    stbtt_GetCodepointHMetrics(&font->info, code, &advance, &bearing);
    int kern = next ? stbtt_GetCodepointKernAdvance(&font->info, code, next) : 0;
    return scale * (float)(advance + kern);
}

typedef void (*glyph_visitor)(void *user, int code, float pen, int byte_end);

/* Walks a line; returns where the pen ends. */
static float walk(const nook_font *font, float size, const char *text, glyph_visitor visit, void *user)
{
    float scale = font_scale(font, size), pen = 0.0f;
    int code = 0, next = 0;
    const char *at = text;
    if (*at)
        at += decode_utf8(at, &code);
    while (code) {
        next = 0;
        const char *end = at;
        if (*at)
            at += decode_utf8(at, &next);
        float advance = pen_advance(font, scale, code, next);
        if (visit)
            visit(user, code, pen, (int)(end - text));
        pen += advance;
        code = next;
    }
    return pen;
}

int nook_text_width(const nook_font *font, float size, const char *text)
{
    return (int)ceilf(walk(font, size, text, NULL, NULL));
}

typedef struct drawing {
    nook_picture *picture;
    const nook_font *font;
    float scale;
    int x, baseline;
    nook_rgb colour;
} drawing;

static void draw_glyph(void *user, int code, float pen, int byte_end)
{
    const drawing *d = user;
    (void)byte_end;
    float left = floorf(pen);
    int width, height, offset_x, offset_y;
    unsigned char *coverage = stbtt_GetCodepointBitmapSubpixel(&d->font->info, d->scale, d->scale, pen - left, 0.0f,
                                                               code, &width, &height, &offset_x, &offset_y);
    if (!coverage)
        return;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++)
            nook_picture_blend(d->picture, d->x + (int)left + offset_x + x, d->baseline + offset_y + y, d->colour,
                               coverage[y * width + x]);
    }
    stbtt_FreeBitmap(coverage, NULL);
}

int nook_text_draw(nook_picture *picture, const nook_font *font, float size, int x, int y, nook_rgb colour,
                   const char *text)
{
    float scale = font_scale(font, size);
    drawing d = { picture, font, scale, x, y + (int)lrintf(scale * (float)font->ascent), colour };
    return x + (int)ceilf(walk(font, size, text, draw_glyph, &d));
}

typedef struct fitting {
    float width;
    int fits, breaks, total; /* bytes: that fit, up to the last space that fits, seen */
} fitting;

static void fit_glyph(void *user, int code, float pen, int byte_end)
{
    fitting *f = user;
    if (pen <= f->width && f->total > 0)
        f->fits = f->total; /* everything before this character ended at `pen` */
    if (code == ' ' && pen <= f->width)
        f->breaks = f->total;
    f->total = byte_end;
    if (f->fits == 0)
        f->fits = byte_end;
}

int nook_text_fit(const nook_font *font, float size, const char *text, int width)
{
    fitting f = { .width = (float)width };
    float end = walk(font, size, text, fit_glyph, &f);
    if (end <= (float)width)
        return f.total;
    return f.breaks > 0 ? f.breaks : f.fits;
}
