#include "modules/measure/sheet.h"
#include "modules/measure/colour_map.h"
#include "modules/measure/text.h"
#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    MARGIN = 32,
    GAP = 14,
    CAPTION_WIDTH = 264,
    LABEL_WIDTH = 112,
    PANEL_WIDTH_MIN = 240,
    PANEL_WIDTH_MAX = 480,
    PANEL_HEIGHT_MAX = 420,
    SCALE_BAR_HEIGHT = 22,
    WRAP_CAPACITY = 512
};
static const float size_title = 30.0f, size_name = 24.0f, size_text = 16.0f, size_small = 14.0f;
static const int line_title = 40, line_name = 32, line_text = 21, line_small = 18;

static const nook_rgb paper = { 255, 255, 255 }, ink = { 24, 26, 30 }, soft_ink = { 96, 100, 108 },
                      hairline = { 214, 217, 222 }, frame = { 150, 154, 162 };

/* What stays the same while one sheet is drawn. */
typedef struct page {
    const nook_sheet *sheet;
    nook_font *regular, *bold;
    nook_picture picture;
    int cell_width;                /* of a column, which is at least PANEL_WIDTH_MIN wide */
    int panel_width, panel_height; /* of a picture on the sheet */
} page;

/* Draws text in lines of at most `width` pixels; with draw == false it only measures. @return the y below the last line */
static int wrap_text(page *p, float size, int line_height, int x, int y, int width, nook_rgb colour, const char *text,
                     bool draw)
{
    while (*text) {
        char line[WRAP_CAPACITY];
        int bytes = nook_text_fit(p->regular, size, text, width);
        if (draw) {
            snprintf(line, sizeof line, "%.*s", bytes, text);
            nook_text_draw(&p->picture, p->regular, size, x, y, colour, line);
        }
        text += bytes;
        while (*text == ' ')
            text++;
        y += line_height;
    }
    return y;
}

static int caption(page *p, const nook_sheet_row *row, int x, int y, bool draw)
{
    if (draw)
        nook_text_draw(&p->picture, p->bold, size_name, x, y - 3, ink, row->name);
    y += line_name;
    y = wrap_text(p, size_small, line_small, x, y, CAPTION_WIDTH, soft_ink, row->summary, draw) + 8;
    for (uint32_t i = 0; i < row->fact_count; i++) {
        if (draw) {
            nook_text_draw(&p->picture, p->regular, size_text, x, y, soft_ink, row->facts[i].label);
            nook_text_draw(&p->picture, p->bold, size_text, x + LABEL_WIDTH, y, ink, row->facts[i].value);
        }
        y += line_text;
    }
    return wrap_text(p, size_small, line_small, x, y + 8, CAPTION_WIDTH, soft_ink, row->parameters, draw);
}

static int column_x(const page *p, int column)
{
    return MARGIN + CAPTION_WIDTH + GAP * 2 + column * (p->cell_width + GAP);
}

static int header_height(const page *p)
{
    return MARGIN + line_title + (int)p->sheet->line_count * line_small + GAP + line_text + GAP / 2;
}

static void choose_panel_size(page *p)
{
    const nook_picture *picture = p->sheet->rows[0].lit;
    double shrink =
        fmin(1.0, fmin(PANEL_WIDTH_MAX / (double)picture->width, PANEL_HEIGHT_MAX / (double)picture->height));
    p->panel_width = (int)fmax(1.0, round(picture->width * shrink));
    p->panel_height = (int)fmax(1.0, round(picture->height * shrink));
    p->cell_width = p->panel_width > PANEL_WIDTH_MIN ? p->panel_width : PANEL_WIDTH_MIN;
}

static nook_result draw_panel(page *p, const nook_picture *picture, int column, int y)
{
    assert(picture->width == p->sheet->rows[0].lit->width && picture->height == p->sheet->rows[0].lit->height);
    int x = column_x(p, column);
    nook_picture_fill(&p->picture, x - 1, y - 1, p->panel_width + 2, p->panel_height + 2, frame);
    if (picture->width == (uint32_t)p->panel_width && picture->height == (uint32_t)p->panel_height) {
        nook_picture_blit(&p->picture, picture, x, y);
        return NOOK_OK;
    }
    nook_picture small;
    nook_result result = nook_picture_resize(picture, (uint32_t)p->panel_width, (uint32_t)p->panel_height, &small);
    if (result != NOOK_OK)
        return result;
    nook_picture_blit(&p->picture, &small, x, y);
    nook_picture_free(&small);
    return NOOK_OK;
}

static void draw_centred(page *p, int centre, int y, const char *text)
{
    int width = nook_text_width(p->regular, size_small, text);
    nook_text_draw(&p->picture, p->regular, size_small, centre - width / 2, y, ink, text);
}

static void draw_numbers(page *p, int x, int y, int width)
{
    for (int i = -2; i <= 2; i++) {
        char number[32];
        int centre = x + width * (i + 2) / 4;
        nook_picture_fill(&p->picture, centre, y - 3, 1, 5, frame);
        snprintf(number, sizeof number, i ? "%+.3g" : "0", (double)p->sheet->error_range * i / 2.0);
        draw_centred(p, centre, y + 4, number);
    }
}

/* The colour scale with its numbers, where the reference's own error would stand; with draw == false it only measures.
   @return the y below it */
static int colour_scale(page *p, int y, bool draw)
{
    int x = column_x(p, 2), inset = 24, width = p->cell_width - 2 * inset;
    y = wrap_text(p, size_small, line_small, x + inset, y, width, soft_ink,
                  "Error of visibility: technique minus reference, on pixels with geometry.", draw);
    y += GAP;
    if (draw) {
        nook_error_scale_draw(&p->picture, x + inset, y, width, SCALE_BAR_HEIGHT, frame);
        draw_numbers(p, x + inset, y + SCALE_BAR_HEIGHT + 3, width);
    }
    y += SCALE_BAR_HEIGHT + 3 + line_small + 8;
    const char *bright = "too bright";
    if (draw) {
        nook_text_draw(&p->picture, p->regular, size_small, x + inset, y, soft_ink, "too dark");
        nook_text_draw(&p->picture, p->regular, size_small,
                       x + inset + width - nook_text_width(p->regular, size_small, bright), y, soft_ink, bright);
    }
    y += line_small + GAP;
    if (draw) {
        nook_picture_fill(&p->picture, x + inset, y + 2, 14, 14, nook_error_no_geometry());
        nook_text_draw(&p->picture, p->regular, size_small, x + inset + 22, y, soft_ink, "no geometry");
    }
    return y + line_small;
}

static int row_height(page *p, const nook_sheet_row *row)
{
    int text = caption(p, row, 0, 0, false), scale = row->error ? 0 : colour_scale(p, 0, false);
    int height = text > scale ? text : scale;
    return height > p->panel_height ? height : p->panel_height;
}

static void draw_header(page *p)
{
    static const char *const headings[] = { "Lit picture", "Visibility (white = open)", "Error" };
    int y = MARGIN;
    nook_text_draw(&p->picture, p->bold, size_title, MARGIN, y, ink, p->sheet->title);
    y += line_title;
    for (uint32_t i = 0; i < p->sheet->line_count; i++) {
        nook_text_draw(&p->picture, p->regular, size_small, MARGIN, y, soft_ink, p->sheet->lines[i]);
        y += line_small;
    }
    y += GAP;
    for (int i = 0; i < 3; i++)
        nook_text_draw(&p->picture, p->bold, size_text, column_x(p, i), y, ink, headings[i]);
}

static nook_result draw_row(page *p, const nook_sheet_row *row, int y)
{
    caption(p, row, MARGIN, y, true);
    nook_result result = draw_panel(p, row->lit, 0, y);
    if (result == NOOK_OK)
        result = draw_panel(p, row->visibility, 1, y);
    if (result == NOOK_OK && row->error)
        result = draw_panel(p, row->error, 2, y);
    if (!row->error)
        colour_scale(p, y, true);
    return result;
}

static int page_height(page *p)
{
    int64_t height = header_height(p) + MARGIN - GAP;
    for (uint32_t i = 0; i < p->sheet->row_count && height < INT32_MAX / 2; i++)
        height += row_height(p, &p->sheet->rows[i]) + GAP * 2;
    return (int)height;
}

static nook_result draw_page(page *p)
{
    int width = column_x(p, 2) + p->cell_width + MARGIN;
    nook_result result = nook_picture_create((uint32_t)width, (uint32_t)page_height(p), &p->picture);
    if (result != NOOK_OK)
        return result;
    nook_picture_fill(&p->picture, 0, 0, width, (int)p->picture.height, paper);
    draw_header(p);
    int y = header_height(p);
    for (uint32_t i = 0; i < p->sheet->row_count && result == NOOK_OK; i++) {
        if (i > 0)
            nook_picture_fill(&p->picture, MARGIN, y - GAP, width - 2 * MARGIN, 1, hairline);
        result = draw_row(p, &p->sheet->rows[i], y);
        y += row_height(p, &p->sheet->rows[i]) + GAP * 2;
    }
    return result;
}

nook_result nook_sheet_draw(const nook_sheet *sheet, nook_picture *out_picture)
{
    assert(sheet->row_count > 0);
    page p = { .sheet = sheet };
    choose_panel_size(&p);
    nook_result result = nook_font_load(NOOK_FONT_REGULAR, &p.regular);
    if (result == NOOK_OK)
        result = nook_font_load(NOOK_FONT_BOLD, &p.bold);
    if (result == NOOK_OK)
        result = draw_page(&p);
    nook_font_destroy(p.regular);
    nook_font_destroy(p.bold);
    if (result != NOOK_OK) {
        nook_picture_free(&p.picture);
        return result;
    }
    *out_picture = p.picture;
    return NOOK_OK;
}
