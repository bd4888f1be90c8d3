/* Pictures of what is seen: one by a key, with a text of what made it; or one of every frame. */
#include "engine/core/angle.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/live/live_internal.h"
#include "modules/measure/picture.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COMMENT_SIZE = 8192, PICTURES_MAX = 100000 };

/* ---- Of what is seen ---------------------------------------------------------------------------------------------- */

static nook_result show_on(nook_live *live, nook_framebuffer target)
{
    nook_result result = live_fit_image(live);
    if (result != NOOK_OK)
        return result;
    live->stage->gpu->gl->BlitNamedFramebuffer(live->targets.image.id, target.id, 0, 0, (GLint)live->stage->width,
                                               (GLint)live->stage->height, 0, 0, (GLint)target.width,
                                               (GLint)target.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    return live->overlay_used ? nook_overlay_draw(live->overlay, target) : NOOK_OK;
}

nook_result nook_live_present(nook_live *live, uint32_t width, uint32_t height)
{
    live_times_begin(live, LIVE_PASS_OVERLAY);
    nook_result result = show_on(live, (nook_framebuffer){ 0, width, height });
    live_times_end(live, LIVE_PASS_OVERLAY);
    return result;
}

static void flip(uint8_t *rgb, uint32_t width, uint32_t height)
{
    size_t row = (size_t)width * 3;
    for (uint32_t low = 0, high = height - 1; low < high; low++, high--) {
        for (size_t i = 0; i < row; i++) {
            uint8_t byte = rgb[low * row + i];
            rgb[low * row + i] = rgb[high * row + i];
            rgb[high * row + i] = byte;
        }
    }
}

/* The target of pictures is kept as long as their size is. */
static nook_result fit_shot(nook_live *live, uint32_t width, uint32_t height)
{
    live_targets *t = &live->targets;
    nook_gpu *gpu = live->stage->gpu;
    if (t->shot.id && t->shot.width == width && t->shot.height == height)
        return NOOK_OK;
    nook_framebuffer_destroy(gpu, &t->shot_target);
    nook_texture_destroy(gpu, &t->shot);
    nook_result result = nook_texture_create_2d(gpu, GL_RGBA8, width, height, GL_NEAREST, &t->shot);
    return result == NOOK_OK ? nook_framebuffer_create(gpu, &t->shot, 1, (nook_texture){ 0 }, &t->shot_target) : result;
}

nook_result nook_live_present_unseen(nook_live *live, uint32_t width, uint32_t height)
{
    nook_result result = fit_shot(live, width, height);
    return result == NOOK_OK ? show_on(live, live->targets.shot_target) : result;
}

nook_result nook_live_picture(nook_live *live, uint32_t width, uint32_t height, uint8_t *out_rgb)
{
    nook_result result = nook_live_present_unseen(live, width, height);
    if (result != NOOK_OK)
        return result;
    nook_texture_read(live->stage->gpu, live->targets.shot, GL_RGB, GL_UNSIGNED_BYTE, out_rgb,
                      (size_t)width * height * 3);
    flip(out_rgb, width, height);
    return NOOK_OK;
}

/* ---- What made it ------------------------------------------------------------------------------------------------- */

/* A text that grows, and stops growing when it is full. */
typedef struct comment {
    char text[COMMENT_SIZE];
    size_t used;
} comment;

static void add(comment *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(comment *c, const char *format, ...)
{
    va_list arguments;
    if (c->used >= sizeof c->text)
        return;
    va_start(arguments, format);
    int length = vsnprintf(c->text + c->used, sizeof c->text - c->used, format, arguments);
    va_end(arguments);
    c->used += length > 0 ? (size_t)length : 0;
}

/* As --camera takes it: eye, a point ahead, degrees. */
static void add_camera(comment *c, const nook_camera *camera)
{
    const double origin[3] = { 0.0, 0.0, 0.0 }, ahead[3] = { 0.0, 0.0, -1.0 };
    double eye[3], target[3];
    nook_matrix world_from_view;
    nook_matrix_inverse_affine(&camera->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    nook_matrix_apply_point(&world_from_view, ahead, target);
    add(c, "--camera %.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.4f\n", eye[0], eye[1], eye[2], target[0], target[1], target[2],
        camera->fov_y_radians / NOOK_DEGREE);
}

static void add_view(comment *c, const nook_live *live, uint32_t i)
{
    const nook_live_view *v = &live->views.views[i];
    const nook_rectangle *place = &live->places[i];
    const live_error *error = &live->truth.errors[i];
    add(c, "view %u%s: %s; shows %s; pixels %u,%u to %u,%u from the bottom left", i + 1,
        i == live->views.active ? " (below)" : "", v->open ? "none" : v->setting, nook_live_mode_name(v->mode),
        place->x, place->y, place->x + place->width, place->y + place->height);
    if (error->pixels > 0)
        add(c, "; RMSE %.5f, bias %+.5f", error->rmse, error->bias);
    add(c, "\n");
}

static nook_result write_text(nook_live *live, const char *path)
{
    comment c = { .used = 0 };
    nook_settings_file file = live_settings_of_active(live);
    add(&c, "%s\n%s", nook_path_name(path), live->notes);
    if (live->notes[0] && live->notes[strlen(live->notes) - 1] != '\n')
        add(&c, "\n");
    add(&c, "%u x %u pixels\n", live->stage->width, live->stage->height);
    add_camera(&c, &live->camera);
    for (uint32_t i = 0; i < live->views.count; i++)
        add_view(&c, live, i);
    if (live->truth.rays > 0)
        add(&c, "truth by %u rays, noise %.5f\n", live->truth.rays, live->truth.noise);
    return nook_settings_file_write(path, &file, c.text);
}

/* ---- By a key ----------------------------------------------------------------------------------------------------- */

/* The first number that no picture has yet. */
static void choose_paths(nook_live *live, char png[LIVE_PATH_SIZE], char text[LIVE_PATH_SIZE])
{
    do {
        char name[32];
        snprintf(name, sizeof name, "nook_%04u.png", ++live->picture_number);
        nook_path_join(png, LIVE_PATH_SIZE, live->pictures, name);
        snprintf(name, sizeof name, "nook_%04u.settings", live->picture_number);
        nook_path_join(text, LIVE_PATH_SIZE, live->pictures, name);
    } while (live->picture_number < PICTURES_MAX && (nook_file_exists(png) || nook_file_exists(text)));
}

static nook_result take_picture(nook_live *live, const char *path)
{
    uint32_t width = live_shown_width(live), height = live_shown_height(live);
    nook_picture picture;
    nook_result result = nook_picture_create(width, height, &picture);
    if (result != NOOK_OK)
        return result;
    result = nook_live_picture(live, width, height, (uint8_t *)picture.pixels);
    if (result == NOOK_OK)
        result = nook_picture_write_png(&picture, path);
    nook_picture_free(&picture);
    return result;
}

void live_picture_by_key(nook_live *live)
{
    char png[LIVE_PATH_SIZE], text[LIVE_PATH_SIZE];
    if (!live->picture_asked)
        return;
    live->picture_asked = false;
    choose_paths(live, png, text);
    nook_result result = nook_directory_make(live->pictures);
    if (result == NOOK_OK)
        result = take_picture(live, png);
    if (result == NOOK_OK)
        result = write_text(live, text);
    if (result == NOOK_OK)
        nook_log_info("picture: %s", png);
    live_note(live, result == NOOK_OK ? "%s, with its .settings" : "%s could not be written", png);
}

/* ---- Of every frame ----------------------------------------------------------------------------------------------- */

static nook_result close_capture(nook_live *live)
{
    nook_result result = nook_capture_close(live->capture);
    free(live->captured);
    live->capture = NULL;
    live->captured = NULL;
    return result;
}

nook_result nook_live_capture(nook_live *live, const nook_capture_desc *desc)
{
    nook_live_capture_end(live);
    nook_capture_desc sized = *desc;
    if (sized.width == 0 || sized.height == 0)
        sized.width = live_shown_width(live), sized.height = live_shown_height(live);
    nook_result result = nook_capture_open(&sized, &live->capture);
    if (result != NOOK_OK)
        return result;
    live->capture_size[0] = sized.width, live->capture_size[1] = sized.height;
    live->captured = malloc((size_t)sized.width * sized.height * 3);
    if (live->captured)
        return NOOK_OK;
    nook_live_capture_end(live);
    return nook_fail(NOOK_E_MEMORY, "%s: no memory for pictures of %u x %u", desc->path, sized.width, sized.height);
}

nook_result nook_live_capture_end(nook_live *live)
{
    nook_result result = live->capture_failed ? NOOK_E_IO : NOOK_OK;
    live->capture_failed = false;
    nook_result closed = close_capture(live);
    return result == NOOK_OK ? closed : result;
}

bool nook_live_capture_failed(const nook_live *live)
{
    return live->capture_failed;
}

void live_capture_frame(nook_live *live)
{
    if (!live->capture)
        return;
    nook_result result = nook_live_picture(live, live->capture_size[0], live->capture_size[1], live->captured);
    if (result == NOOK_OK)
        result = nook_capture_add(live->capture, live->captured);
    if (result == NOOK_OK)
        return;
    close_capture(live);
    live->capture_failed = true;
    live_note(live, "capturing has ended; the log says why");
}
